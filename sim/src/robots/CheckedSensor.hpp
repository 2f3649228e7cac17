#pragma once

#include <memory>
#include <string>

#include "ortung/core/PluginGuard.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {

/// The simulation half of a device as robots and the learner call it: what it throws, and numbers
/// that make no sense, are a PluginFailure that names plugin, robot and features.
class CheckedSensor final : public Sensor {
 public:
  /// @param robot its name; "": none, while tables are learned
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

/// The simulation half of a device; null for one that only makes features of others.
/// @throws ConfigError, PluginError
std::unique_ptr<Sensor> makeSensor(const Device& device, PluginFactory& factory,
                                   const std::string& robot = "");

}  // namespace ortung
