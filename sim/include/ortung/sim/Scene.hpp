#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/sim/PlayerWish.hpp"
#include "ortung/sim_api/Twist.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

/// A robot of a scene.
struct SceneRobot {
  std::filesystem::path file;
  std::string name;
  std::optional<Pose2> start;  ///< start pose in the field frame; none: a random one
  bool wanders = false;        ///< whether it drives to random places until its first command
  std::vector<FloorPoint> waypoints;  ///< points through which it drives; it stops at the last
  std::optional<double> speed;        ///< its speed while it wanders or follows waypoints [m/s]
  /// Times at which it is kidnapped, i.e. moved to a random pose, unnoticed by its odometry, in
  /// ascending order; at most one per cycle.
  std::vector<Timestamp> kidnaps;
};

/// A command to a robot at a time. Values that are not given stay as they are.
struct SceneCommand {
  Timestamp at = 0;
  std::string robot;
  std::optional<double> translational;  ///< forward velocity [m/s]
  std::optional<double> rotational;     ///< turn rate [rad/s]
  std::vector<double> vector;           ///< the drive's own command vector; empty: none
  std::string manipulator;              ///< name of the manipulator to be set; empty: none
  std::string state;                    ///< the state that the manipulator is to enter
};

/// A placement of a movable thing at a time.
struct ScenePlacement {
  Timestamp at = 0;
  std::string thing;  ///< its name in the world file
  Pose2 pose;
  Twist velocity;
};

/// A scripted simulation: a world, robots in it, and their commands with their times.
struct Scene {
  static constexpr std::size_t kMostRobots = 256;

  std::filesystem::path world;
  std::optional<double> duration;  ///< length of the run [s]
  std::vector<SceneRobot> robots;
  std::vector<PlayerWish> players;  ///< players, each on a robot of its own
  std::optional<RefereeWish> referee;
  std::vector<SceneCommand> commands;      ///< commands in the order of time
  std::vector<ScenePlacement> placements;  ///< placements in the order of time

  /// Returns whether a TOML file is a scene, i.e. has a table [scene]. @throws ConfigError
  ORTUNG_API static bool isScene(const std::filesystem::path& file);
  /// Reads a scene file. @throws ConfigError
  ORTUNG_API static Scene read(const std::filesystem::path& file);
  /// Reads a scene file that was parsed before. @param folder folder of the files that it names
  /// @throws ConfigError
  ORTUNG_API static Scene read(const Parameters& toml, const std::filesystem::path& folder);
  /// Reads a scene file, or a world file as a scene without robots. @throws ConfigError
  ORTUNG_API static Scene open(const std::filesystem::path& file);
};

}  // namespace ortung
