#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/FloorPlans.hpp"
#include "ortung/sim/PlayerControl.hpp"
#include "ortung/sim/Scene.hpp"
#include "ortung/sim/Simulation.hpp"
#include "ortung/sim_api/Referee.hpp"

namespace ortung {

/// A scene under way: a simulation of its own with the scene's robots and players in it, and the
/// script.
/// Not thread-safe.
class ORTUNG_API SceneRun {
 public:
  /// @throws ConfigError, PluginError, std::invalid_argument for commands to what is not there and
  ///   for waypoints that can't be reached
  SceneRun(const Scene& scene, const Simulation::Config& config, PluginFactory& factory,
           const PlayerControl::Config& players = {});
  ~SceneRun();
  SceneRun(const SceneRun&) = delete;
  SceneRun& operator=(const SceneRun&) = delete;

  /// One cycle: what the script says is due, then all robots sense, players act, and everything
  /// moves. Robots whose players have ended leave the field.
  /// @throws std::invalid_argument for a command that its robot refuses, and for a robot to be
  ///   carried elsewhere that finds no room
  void step();
  /// The two halves of step(): until all have acted, and from there. Whoever commands a robot
  /// between them does so by what it senses in this cycle, as players do.
  void act();
  void move();

  Simulation& simulation() { return *simulation_; }
  const Simulation& simulation() const { return *simulation_; }
  /// Place of a robot among those of the simulation, or nothing.
  std::optional<std::size_t> find(const std::string& robot) const;

  /// Adds a robot that the scene does not have.
  /// @param start in the field frame; none: anywhere
  /// @param number of its streams of chance; the scene's own robots have those from 0
  /// @throws std::invalid_argument if there is no room; ConfigError, PluginError
  SimRobot& addRobot(const RobotConfig& config, PluginFactory& factory,
                     const std::optional<Pose2>& start, std::uint64_t number);
  /// Starts a player on a robot of its own. @param number as for addRobot()
  /// @throws as addRobot(), and for a player that can't be made
  SimRobot& addPlayer(const PlayerWish& wish, std::uint64_t number);
  /// Robots that the scene itself has; those of others have later numbers.
  std::size_t entrants() const { return scene_.robots.size() + scene_.players.size(); }
  PlayerControl& players() { return *players_; }
  const PlayerControl& players() const { return *players_; }
  /// Who sees to the rules, or null.
  Referee* referee() { return referee_.get(); }
  /// How the game stands; free if nobody referees.
  const Game& game() const { return game_; }
  /// Lets a robot drive about by itself. @param number as for addRobot() @param speed at most [m/s]
  void letWander(SimRobot& robot, std::uint64_t number, std::optional<double> speed = std::nullopt);
  /// Plans of the floor, of the scene's robots and those of others.
  FloorPlans& plans() { return *plans_; }

 private:
  /// A robot that is carried elsewhere now and then.
  struct Kidnapped {
    SimRobot& robot;
    std::vector<Timestamp> moments;
    Random placing;  ///< goes on where that of its start ended
    std::size_t next = 0;
  };
  void addRobot(const SceneRobot& robot, std::size_t place, PluginFactory& factory);
  SimRobot& enter(const RobotConfig& config, PluginFactory& factory,
                  const std::optional<Pose2>& start, Random& placing);
  void watch();
  void kidnap(Kidnapped& kidnapped);
  void obey(const SceneCommand& command);
  void put(const ScenePlacement& placement);
  std::size_t need(const std::string& robot) const;
  void check(const SceneCommand& command) const;
  std::size_t needThing(const std::string& thing) const;

  Scene scene_;
  std::unique_ptr<Simulation> simulation_;
  PluginFactory& factory_;
  std::unique_ptr<FloorPlans> plans_;
  PlayerControl::Config playerConfig_;
  std::unique_ptr<PlayerControl> players_;
  std::unique_ptr<Referee> referee_;
  Game game_;
  std::vector<Kidnapped> kidnapped_;
  std::size_t nextCommand_ = 0;
  std::size_t nextPlacement_ = 0;
};

}  // namespace ortung
