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
  /// Its `device`: what fills its features on a real robot; empty if nothing is said. Whoever opens
  /// devices checks it; nobody else looks into it.
  Parameters device;
};

/// A robot file (the paper's Parameters module): geometry, sensors, motion.
/// The same file configures client, server, learner and real robot.
struct RobotConfig {
  std::string name;
  double radius = 0.25;  ///< of the body's circle around the robot's origin [m]
  double mass = 10.0;    ///< [kg]
  Parameters about;      ///< the whole [robot]
  std::vector<SensorConfig> sensors;
  Parameters motion;                     ///< [motion], may be empty
  Parameters mcl;                        ///< [mcl], may be empty
  Parameters drive;                      ///< [drive]: limits of the simulated robot, may be empty
  std::vector<Parameters> body;          ///< [[body]]: shapes of the simulated robot, may be none
  std::vector<Parameters> manipulators;  ///< [[manipulator]] of the simulated robot, may be none
  double deviceWait = 0.05;  ///< how long readings of one device wait for those of others [s]
};

/// @throws ConfigError
ORTUNG_API RobotConfig readRobot(const std::filesystem::path& file);
ORTUNG_API RobotConfig readRobot(const Parameters& parameters);

/// Features of one device in the container, borrowed.
struct Device {
  const SensorConfig* config;
  std::vector<SensorData*> data;
  bool hasExtractor = false;             ///< some of its features are made of others
  SensorContainer* container = nullptr;  ///< where its features are
};

/// Makes the data of all sensors and adds them to @p container, with the extractors of those that
/// have one, and connects them; adds a groundTruth/pose feature
/// ("reference/groundTruth/pose") if no sensor gives one. @throws ConfigError, PluginError
ORTUNG_API std::vector<Device> fillContainer(SensorContainer& container, const RobotConfig& robot,
                                             PluginFactory& factory);

/// Reads the keys model, type and feature of a [[sensor]], which all have, with defaults.
/// Data halves call these; both halves of a plugin may.
ORTUNG_API SensorId sensorIdOf(const Parameters& sensor, const SensorId& defaults);

}  // namespace ortung
