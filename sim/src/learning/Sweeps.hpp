#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {

/// Devices of one robot with their simulation halves, which may be null.
struct Rig {
  Rig(const std::vector<Device>& devices, PluginFactory& factory);
  const std::vector<Device>* devices;
  std::vector<std::unique_ptr<Sensor>> sensors;
};

/// Features of one device at one place on the robot. Devices and features are called by their
/// places, which are the same in all rigs of a robot.
struct SweepGroup {
  std::size_t device = 0;
  std::vector<std::size_t> inputs;  ///< devices that must generate before: for made features
  Pose2 robotInSensor;              ///< inverse of the mount
  std::vector<std::size_t> features;
};

/// Everything that is learned in the same headings and places.
struct Sweep {
  double spacing = 0.0;          ///< between headings [rad]
  double positionSpacing = 0.0;  ///< [m]
  std::size_t headings = 0;
  std::vector<std::size_t> cells;
  std::vector<SweepGroup> groups;
};

/// Adds a feature that has begun to learn to the sweep of the region that it belongs to.
/// @returns the number of its headings @throws std::invalid_argument if nothing gives it
std::size_t addTo(std::vector<Sweep>& sweeps, const FieldRegion& region, const Rig& rig,
                  std::size_t device, std::size_t feature);

/// Fills a group's features with what they read, without noise, where the robot stands.
/// @param isNew by feature: whether there is a reading; what is not made there has none
void generate(const World& world, const RobotState& state, const SweepGroup& group, const Rig& rig,
              Timestamp now, std::vector<SensorData*>& features, std::vector<char>& isNew);

}  // namespace ortung
