#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/Driver.hpp"
#include "ortung/sim/RoutePlanner.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung {

/// A robot of a scene.
struct SceneRobot {
  std::filesystem::path file;
  std::string name;
  std::optional<Pose2> start;         ///< in the field frame; none: anywhere
  bool wanders = false;               ///< drives about until its first command
  std::vector<FloorPoint> waypoints;  ///< or goes from one to the next, and stands at the last
  std::optional<double> speed;        ///< with which it wanders or follows [m/s]
};

/// What a robot is told at some time. What is not there stays as it is.
struct SceneCommand {
  Timestamp at = 0;
  std::string robot;
  std::optional<double> translational;  ///< [m/s]
  std::optional<double> rotational;     ///< [rad/s]
  std::vector<double> vector;           ///< the drive's own command; empty: none
  std::string manipulator;              ///< empty: none
  std::string state;                    ///< of the manipulator
};

/// Something movable of the world, put somewhere at some time.
struct ScenePlacement {
  Timestamp at = 0;
  std::string thing;  ///< its name in the world file
  Pose2 pose;
  Twist velocity;
};

/// A scripted play: a world, robots in it, and what they are told when.
struct Scene {
  std::filesystem::path world;
  std::optional<double> duration;  ///< [s]
  std::vector<SceneRobot> robots;
  std::vector<SceneCommand> commands;      ///< in the order of time
  std::vector<ScenePlacement> placements;  ///< in the order of time

  /// Whether a TOML file is a scene: it has [scene]. @throws ConfigError
  ORTUNG_API static bool isScene(const std::filesystem::path& file);
  /// @throws ConfigError
  ORTUNG_API static Scene read(const std::filesystem::path& file);
  /// The scene of a file, or the world of a file with nobody in it. @throws ConfigError
  ORTUNG_API static Scene open(const std::filesystem::path& file);
};

/// Plays a scene in a simulation of its own. Not thread-safe.
class ORTUNG_API ScenePlayer {
 public:
  /// @param factory must outlive this
  /// @throws ConfigError, PluginError, std::invalid_argument for commands to what is not there
  ScenePlayer(const Scene& scene, const Simulation::Config& config, PluginFactory& factory);
  ~ScenePlayer();
  ScenePlayer(const ScenePlayer&) = delete;
  ScenePlayer& operator=(const ScenePlayer&) = delete;

  /// One cycle: commands that are due, then everything moves.
  /// @throws std::invalid_argument for a command that its robot refuses
  void step();

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
  /// Lets a robot drive about by itself. @param number as for addRobot() @param speed at most [m/s]
  void letWander(SimRobot& robot, std::uint64_t number, std::optional<double> speed = std::nullopt);
  /// The plan of the floor for robots of a size, made when it is first asked for.
  /// @throws std::invalid_argument if such a robot fits nowhere
  const RoutePlanner& planner(const RobotSize& size);
  bool hasPlanner(const RobotSize& size) const { return planners_.contains(size); }
  std::size_t planners() const { return planners_.size(); }

 private:
  void addRobot(const SceneRobot& robot, std::size_t place, PluginFactory& factory);
  void obey(const SceneCommand& command);
  void put(const ScenePlacement& placement);
  std::size_t need(const std::string& robot) const;
  std::size_t needThing(const std::string& thing) const;

  Scene scene_;
  std::map<RobotSize, RoutePlanner> planners_;  ///< outlive the drivers
  std::unique_ptr<Simulation> simulation_;
  std::size_t nextCommand_ = 0;
  std::size_t nextPlacement_ = 0;
};

}  // namespace ortung
