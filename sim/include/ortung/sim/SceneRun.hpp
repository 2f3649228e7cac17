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

/// A run of a scene: a simulation with the scene's robots and players, which executes the script.
/// Not thread-safe.
class ORTUNG_API SceneRun {
 public:
  /// @throws ConfigError, PluginError, std::invalid_argument for commands to missing robots or
  ///   parts and for waypoints that can't be reached
  SceneRun(const Scene& scene, const Simulation::Config& config, PluginFactory& factory,
           const PlayerControl::Config& players = {});
  ~SceneRun();
  SceneRun(const SceneRun&) = delete;
  SceneRun& operator=(const SceneRun&) = delete;

  /// Simulates one cycle: commands of the script that are due are executed, then all robots sense,
  /// players act, and everything moves. Robots whose players have ended leave the field.
  /// @throws std::invalid_argument for a command that its robot refuses, and for a kidnapped robot
  ///   for which there is no room
  void step();
  /// The two halves of step(): up to the players' actions, and the motion. A caller that commands a
  /// robot between them can use this cycle's readings, as players do.
  void act();
  void move();

  Simulation& simulation() { return *simulation_; }
  const Simulation& simulation() const { return *simulation_; }
  /// Returns the index of a robot in the simulation; nothing if it is not there.
  std::optional<std::size_t> find(const std::string& robot) const;

  /// Adds a robot that the scene does not have.
  /// @param start start pose in the field frame; none: a random one
  /// @param number number of its random streams; the scene's own robots have those from 0
  /// @throws std::invalid_argument if there is no room; ConfigError, PluginError
  SimRobot& addRobot(const RobotConfig& config, PluginFactory& factory,
                     const std::optional<Pose2>& start, std::uint64_t number);
  /// Starts a player on a robot of its own. @param number as for addRobot()
  /// @throws as addRobot(), and for a player that can't be made
  SimRobot& addPlayer(const PlayerWish& wish, std::uint64_t number);
  /// Returns the number of robots of the scene itself; robots added later have higher numbers.
  std::size_t entrants() const { return scene_.robots.size() + scene_.players.size(); }
  PlayerControl& players() { return *players_; }
  const PlayerControl& players() const { return *players_; }
  /// Returns the referee; null if there is none.
  Referee* referee() { return referee_.get(); }
  /// Returns the state of the game; its phase is free without a referee.
  const Game& game() const { return game_; }
  /// Lets a robot drive to random places. @param number as for addRobot() @param speed greatest
  /// speed [m/s]
  void letWander(SimRobot& robot, std::uint64_t number, std::optional<double> speed = std::nullopt);
  /// Returns the plans of the floor for all robots.
  FloorPlans& plans() { return *plans_; }

 private:
  /// A robot that is kidnapped at given times.
  struct Kidnapped {
    SimRobot& robot;
    std::vector<Timestamp> moments;
    Random placing;  ///< generator of its poses, which continues the one that drew its start
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
