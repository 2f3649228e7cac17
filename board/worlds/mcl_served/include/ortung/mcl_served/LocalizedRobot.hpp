#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/mcl_served/LocalizedRobots.hpp"
#include "ortung/run/Localization.hpp"

namespace ortung {

/// A robot that is really there and localizes itself, number 1 of a ServedContainer: its program
/// calls Localization::update() as before, and obey() before it. Thread-safe.
class ORTUNG_API LocalizedRobot final : public LocalizedRobots {
 public:
  /// @param localization which publishes
  explicit LocalizedRobot(std::shared_ptr<Localization> localization);
  ~LocalizedRobot() override;

  std::optional<RobotId> usual() const override;
  bool isForAll() const override { return true; }
  /// State of the newest estimate: searching or running.
  LocalizationState state(RobotId robot) override;
  /// It can't be switched off: others than clients rely on it.
  void order(RobotId robot, const LocalizationOrder& order) override;
  /// The robot of the localization, while that runs.
  std::shared_ptr<const Robot> perceiver(RobotId robot) const override;

  /// Which features clients ask for (ServedContainer::Config::onWant).
  void want(std::span<const SensorId> features);
  /// Does what clients have ordered. For the thread that updates the localization.
  void obey();

 private:
  const std::shared_ptr<Localization> localization_;
  std::mutex mutex_;  ///< guards orders_
  std::vector<LocalizationOrder> orders_;
};

}  // namespace ortung
