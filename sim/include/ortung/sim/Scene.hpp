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
  std::optional<Pose2> start;         ///< in the field frame; none: anywhere
  bool wanders = false;               ///< drives about until its first command
  std::vector<FloorPoint> waypoints;  ///< it goes from one to the next, and stands at the last
  std::optional<double> speed;        ///< with which it wanders or follows [m/s]
  /// When it is carried elsewhere, unnoticed by its odometry; rising. At most once a cycle.
  std::vector<Timestamp> kidnaps;
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
  static constexpr std::size_t kMostRobots = 256;

  std::filesystem::path world;
  std::optional<double> duration;  ///< [s]
  std::vector<SceneRobot> robots;
  std::vector<PlayerWish> players;  ///< on robots of their own
  std::optional<RefereeWish> referee;
  std::vector<SceneCommand> commands;      ///< in the order of time
  std::vector<ScenePlacement> placements;  ///< in the order of time

  /// Whether a TOML file is a scene: it has [scene]. @throws ConfigError
  ORTUNG_API static bool isScene(const std::filesystem::path& file);
  /// @throws ConfigError
  ORTUNG_API static Scene read(const std::filesystem::path& file);
  /// The scene of a file, or the world of a file with nobody in it. @throws ConfigError
  ORTUNG_API static Scene open(const std::filesystem::path& file);
};

}  // namespace ortung
