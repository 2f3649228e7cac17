#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ortung/base/Parameters.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/SensorContainer.hpp"

namespace ortung {

/// One [[sensor]] of a robot file: the plugin that makes its data half (and, in the simulator, its
/// sensor half) and the settings for both.
struct SensorConfig {
  std::string plugin;     ///< "lrf", "landmarks", ...
  Parameters parameters;  ///< the whole [[sensor]] table
  /// Its table `device`: what fills its features on a real robot; may be empty. Only code that
  /// opens devices reads and checks it.
  Parameters device;
};

/// A robot file (the paper's Parameters module): geometry, sensors, motion.
/// The same file configures client, server, learner and real robot.
struct RobotConfig {
  std::string name;
  double radius = 0.25;  ///< radius of the body's circle around the robot's origin [m]
  double mass = 10.0;    ///< the robot's mass [kg]
  Parameters about;      ///< the whole table [robot]
  std::vector<SensorConfig> sensors;
  Parameters motion;                     ///< table [motion], may be empty
  Parameters mcl;                        ///< table [mcl], may be empty
  Parameters drive;                      ///< [drive]: limits of the simulated robot, may be empty
  std::vector<Parameters> body;          ///< [[body]]: shapes of the simulated robot, may be none
  std::vector<Parameters> manipulators;  ///< [[manipulator]] of the simulated robot, may be none
  /// Longest time that readings of a device wait for those of others [s].
  double deviceWait = 0.05;
};

/// Reads a robot file. @throws ConfigError naming file, line and key
ORTUNG_API RobotConfig readRobot(const std::filesystem::path& file);
/// Reads a robot file that was parsed before. @throws ConfigError
ORTUNG_API RobotConfig readRobot(const Parameters& parameters);

/// The features of one device in the container, borrowed.
struct Device {
  const SensorConfig* config;
  std::vector<SensorData*> data;
  bool hasExtractor = false;             ///< some of its features are made of others
  SensorContainer* container = nullptr;  ///< container that holds its features
};

/// Makes the data of all sensors and adds them to @p container, with the extractors of those that
/// have one, and connects them; adds a groundTruth/pose feature
/// ("reference/groundTruth/pose") if no sensor gives one. @throws ConfigError, PluginError
ORTUNG_API std::vector<Device> fillContainer(SensorContainer& container, const RobotConfig& robot,
                                             PluginFactory& factory);

/// Reads the keys model, type and feature, which every [[sensor]] may have, with defaults. The data
/// half of a plugin calls it; the other half may.
ORTUNG_API SensorId sensorIdOf(const Parameters& sensor, const SensorId& defaults);

}  // namespace ortung
