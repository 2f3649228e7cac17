#pragma once

#include <chrono>
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
/// Players act one after the other, in the order in which they were added, after all robots have
/// sensed; so the same seed gives the same bits. A player that fails is ended; the others go on.
/// Not thread-safe.
class ORTUNG_API PlayerControl {
 public:
  /// The settings of the supervision.
  struct Config {
    /// Processor time that one call may take [s]; a player that takes more is stopped. 0: no limit.
    double budget = 1.0;
    /// Called with the reason whenever a player is stopped; may be empty.
    std::function<void(const std::string&)> onProblem = {};
    /// Tables of this world for robots whose players need tables and name none; null: such players
    /// are refused.
    std::shared_ptr<TableStore> tables = nullptr;
  };
  /// A player that is playing.
  struct Seated {
    std::string robot;
    std::string plugin;
    std::string team;
    Timestamp since = 0;   ///< time at which it began [us]
    bool isGuest = false;  ///< whether the robot stays when the player ends
  };

  /// @param simulation, plans, factory borrowed
  PlayerControl(Simulation& simulation, FloorPlans& plans, PluginFactory& factory,
                const Config& config);
  ~PlayerControl();  ///< ends all players, see endAll()
  PlayerControl(const PlayerControl&) = delete;
  PlayerControl& operator=(const PlayerControl&) = delete;

  /// Makes a player for a robot that is already there and stays when the player ends. The player
  /// ends as soon as the robot is commanded from elsewhere.
  void lead(SimRobot& robot, const PlayerWish& wish, const Random& random);
  /// Returns the plugin of the player that a robot had until it was commanded from elsewhere; "":
  /// there was none, or it has one again.
  std::string takenFrom(const SimRobot& robot) const;
  /// Gives such a robot a player of the same settings again. @returns whether there was one
  bool giveBack(SimRobot& robot, const Random& random);
  /// Seats a player on a robot of its own, which leaves the field when the player ends.
  /// @throws std::invalid_argument for something that it needs and does not get; TableError for its
  ///   tables
  void own(SimRobot& robot, std::unique_ptr<Player> player, const PlayerWish& wish,
           const Random& random);
  /// Makes a player without seating it. @throws PluginError, ConfigError
  std::unique_ptr<Player> make(const PlayerWish& wish);

  /// Ends the player on a robot. @returns whether there was one
  bool stop(std::string_view robot);
  /// Ends all players; their robots stay on the field. For the end of a run.
  void endAll();
  /// For a program that has to end because a plugin of this simulation does not come back from a
  /// call: ends all players but the one that is being called, on a thread of its own. Afterwards no
  /// call of the simulation's thread comes back; what remains is to end the program. Thread-safe.
  /// @returns whether all have ended within @p patience
  bool abandon(std::chrono::duration<double> patience);
  /// Delivers the messages of the last cycle to all others of the team, and to the robots' features
  /// of the format TalkData. To be called before Simulation::sense().
  void deliver();
  /// Lets all players act whose period is over. @pre Simulation::sense() was called
  void act(const Game& game);
  /// Removes robots whose players have ended; references to these robots are no longer valid.
  void clear();

  /// Returns the world's true state, for referees and for code that prepares situations.
  Stage& stage();
  /// Set and return the team of a robot, with or without a player; "": none.
  void setTeam(std::string_view robot, std::string_view team);
  std::string teamOf(std::string_view robot) const;

  // --- robots without a player in this process, e.g. those of clients: they hear their team, too
  /// Registers such a robot as a listener of its team, or removes it.
  void join(std::string_view robot, std::string_view team);
  void leave(std::string_view robot);
  /// Sends a message to all others of the robot's team, as PlayerSeat::say() does. @throws
  /// std::invalid_argument
  void say(std::string_view robot, std::string_view text);
  /// Returns the messages that a joined robot has received since the last call, in the order of
  /// time.
  std::vector<Heard> takeHeard(std::string_view robot);

  /// Returns all players in the order in which they were added.
  std::vector<Seated> players() const;
  /// Returns the pose that the player of a robot believed it to have when it acted last.
  std::optional<BelievedPose> believedPose(const SimRobot& robot);
  /// Returns whether there are no players.
  bool isEmpty() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Returns the simulation behind a player's or referee's stage; null if there is none.
ORTUNG_API Simulation* simulationOf(Stage& stage);

}  // namespace ortung
