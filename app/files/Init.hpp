#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ortung::app {

/// Arguments of `ortung init robot`.
struct InitRobotArguments {
  std::filesystem::path out = "robot.toml";
  std::vector<std::string> sensors;  ///< plugins besides odometry; none: a laser scanner
  bool force = false;
};
int runInitRobot(const InitRobotArguments& arguments);

/// Arguments of `ortung init world`.
struct InitWorldArguments {
  std::filesystem::path out = "world.toml";
  std::filesystem::path map;  ///< grid map that the world is; "": a room with walls
  bool force = false;
};
int runInitWorld(const InitWorldArguments& arguments);

/// Arguments of `ortung init sensor`.
struct InitSensorArguments {
  std::string name;           ///< name of the plugin
  std::filesystem::path out;  ///< folder for its source; "": the name
  bool force = false;
};
int runInitSensor(const InitSensorArguments& arguments);

}  // namespace ortung::app
