#pragma once

#include <memory>
#include <string>

#include "ortung/core/PluginGuard.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {

/// Wraps the simulation half of a device for robots and the learner: exceptions and invalid numbers
/// become a PluginFailure that names plugin, robot and features.
class CheckedSensor final : public Sensor {
 public:
  /// @param robot the robot's name; "" while tables are learned
  CheckedSensor(std::unique_ptr<Sensor> sensor, const Device& device, const std::string& robot);
  ~CheckedSensor() override;

  void generateData(const World& world, const RobotState& robot, Random* noise, Timestamp now,
                    std::span<SensorData* const> data) override {
    guard_("generateData", [&] { sensor_->generateData(world, robot, noise, now, data); });
  }
  double period() const override;
  double rays() const override;
  bool isOnDemand() const override {
    return guard_("isOnDemand", [&] { return sensor_->isOnDemand(); });
  }

 private:
  std::unique_ptr<Sensor> sensor_;
  PluginGuard guard_;
};

/// Makes the simulation half of a device; null for a device that only derives features from others.
/// @throws ConfigError, PluginError
std::unique_ptr<Sensor> makeSensor(const Device& device, PluginFactory& factory,
                                   const std::string& robot = "");

}  // namespace ortung
