#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {

/// The devices of one robot with their simulation halves, which may be null.
struct Rig {
  Rig(const std::vector<Device>& devices, PluginFactory& factory);
  const std::vector<Device>* devices;
  std::vector<std::unique_ptr<Sensor>> sensors;
};

/// The features of one device at one place on the robot. Devices and features are identified by
/// indices, which are the same in all rigs of a robot.
struct SweepGroup {
  std::size_t device = 0;
  std::vector<std::size_t> inputs;  ///< devices that must generate first, for derived features
  Pose2 robotInSensor;              ///< the robot's pose in the sensor frame (inverse of the mount)
  std::vector<std::size_t> features;
};

/// All groups that are learned in the same headings and places.
struct Sweep {
  double spacing = 0.0;          ///< angle between headings [rad]
  double positionSpacing = 0.0;  ///< distance between positions [m]
  std::size_t headings = 0;
  std::vector<std::size_t> cells;
  std::vector<SweepGroup> groups;
  /// Returns the number of readings at each cell, of a group in a heading each.
  std::size_t readingsACell() const { return headings * groups.size(); }
};

/// Adds a feature that has begun to learn to the sweep with its spacings. @returns the number of
/// its headings @throws std::invalid_argument if no sensor or extractor provides it
std::size_t addTo(std::vector<Sweep>& sweeps, const FieldRegion& region, const Rig& rig,
                  std::size_t device, std::size_t feature);

/// Fills a group's features with noise-free readings at the robot's pose.
/// @param isNew out: whether each feature has a reading; derived features may have none at a pose
void generate(const World& world, const RobotState& state, const SweepGroup& group, const Rig& rig,
              Timestamp now, std::vector<SensorData*>& features, std::vector<char>& isNew);

}  // namespace ortung
