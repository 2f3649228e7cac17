#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/sim/FloorPlans.hpp"
#include "ortung/sim/PlayerWish.hpp"
#include "ortung/sim/Simulation.hpp"
#include "ortung/sim/TableStore.hpp"
#include "ortung/sim_api/Game.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung {

/// Supervises players and their robots in a simulation (paper, section 4): if one of the two ends,
/// the other is removed. It also carries what players say to their teams.
///
/// Players act one after the other, in the order of their coming, after all robots have sensed; so
/// the same seed gives the same bits. What goes wrong with one of them ends that one alone.
/// Not thread-safe.
class ORTUNG_API PlayerControl {
 public:
  struct Config {
    /// Of a processor's time for one call [s]; who takes more is stopped. 0: as long as it likes.
    double budget = 1.0;
    /// Told of each player that was stopped, and why; may be empty.
    std::function<void(const std::string&)> onProblem = {};
    /// Of this world, for robots whose players need tables and name none; null: they are refused.
    std::shared_ptr<TableStore> tables = nullptr;
  };
  /// A player that is there.
  struct Seated {
    std::string robot;
    std::string plugin;
    std::string team;
    Timestamp since = 0;
    bool isGuest = false;  ///< on a robot that stays when the player ends
  };

  /// @param simulation, plans, factory borrowed
  PlayerControl(Simulation& simulation, FloorPlans& plans, PluginFactory& factory,
                const Config& config);
  ~PlayerControl();
  PlayerControl(const PlayerControl&) = delete;
  PlayerControl& operator=(const PlayerControl&) = delete;

  /// A player that the factory makes, on a robot that is there already and stays when it ends. It
  /// ends as soon as somebody else tells the robot to move.
  void lead(SimRobot& robot, const PlayerWish& wish, const Random& random);
  /// The same on a robot that is the player's own: it leaves the field when the player ends.
  /// @throws std::invalid_argument for what it needs and does not get; TableError for its tables
  void own(SimRobot& robot, std::unique_ptr<Player> player, const PlayerWish& wish,
           const Random& random);
  /// Makes a player, as it is before it takes its seat. @throws PluginError, ConfigError
  std::unique_ptr<Player> make(const PlayerWish& wish);

  /// Ends the player on a robot. @returns whether there was one
  bool stop(std::string_view robot);
  /// What was said in the last cycle comes to all others of the team, and to the robots' features
  /// of the format TalkData. To be called before Simulation::sense().
  void deliver();
  /// Lets all players act whose time has come. @pre Simulation::sense()
  void act(const Game& game);
  /// Takes robots off the field whose players have ended; those must not be used any more.
  void clear();

  /// The world's state, for referees and whoever else sets situations up.
  Stage& stage();
  /// Of a robot's team, "" if it has none. @param robot that a player does not sit on, too
  void setTeam(std::string_view robot, std::string_view team);
  std::string teamOf(std::string_view robot) const;

  // --- robots without player here, as those of clients: their team's talk reaches them, too
  void join(std::string_view robot, std::string_view team);
  void leave(std::string_view robot);
  /// To all others of its team, as PlayerSeat::say(). @throws std::invalid_argument
  void say(std::string_view robot, std::string_view text);
  /// What a robot that has joined was told since it was last asked, in the order of time.
  std::vector<Heard> takeHeard(std::string_view robot);

  std::vector<Seated> players() const;
  /// Where the player of a robot believed it to be when it acted last.
  std::optional<BelievedPose> believedPose(const SimRobot& robot);
  bool isEmpty() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// The simulation that a player's or referee's stage shows; null if that is no simulation.
ORTUNG_API Simulation* simulationOf(Stage& stage);

}  // namespace ortung
