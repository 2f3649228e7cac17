#pragma once

#include <memory>

#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {

/// The simulation half of a device; null for one that only makes features of others.
/// @throws ConfigError, PluginError
inline std::unique_ptr<Sensor> makeSensor(const Device& device, PluginFactory& factory) {
  const SensorConfig& config = *device.config;
  return device.hasExtractor ? factory.makeIfThere<Sensor>(config.plugin, config.parameters)
                             : factory.make<Sensor>(config.plugin, config.parameters);
}

}  // namespace ortung
