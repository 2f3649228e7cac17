#include "ortung/mcl_served/LocalizedRobot.hpp"

#include <algorithm>
#include <utility>

#include "Orders.hpp"

namespace ortung {
namespace {

constexpr RobotId kRobot = 1;

void check(RobotId robot) {
  if (robot != kRobot) throw ServeError("no-robot", "there is no robot " + std::to_string(robot));
}

}  // namespace

LocalizedRobot::LocalizedRobot(std::shared_ptr<Localization> localization)
    : localization_(std::move(localization)) {}
LocalizedRobot::~LocalizedRobot() = default;

std::optional<RobotId> LocalizedRobot::usual() const { return kRobot; }

LocalizationState LocalizedRobot::state(RobotId robot) {
  check(robot);
  return stateOf(*localization_);
}

void LocalizedRobot::order(RobotId robot, const LocalizationOrder& order) {
  using Kind = LocalizationOrder::Kind;
  check(robot);
  if (order.kind == Kind::kOff)
    throw ServeError("live", "this is a running robot: its localization can't be switched off");
  if (order.kind == Kind::kOn) return;
  if (order.kind == Kind::kPlace) localization_->checkPose(order.pose, order.sigmaPosition);
  const std::lock_guard lock(mutex_);
  if (orders_.size() == kMostOrders) orders_.erase(orders_.begin());  // its readings have stopped
  orders_.push_back(order);
}

std::shared_ptr<const Robot> LocalizedRobot::perceiver(RobotId robot) const {
  check(robot);
  return {localization_, &localization_->robot()};
}

void LocalizedRobot::want(std::span<const SensorId> features) {
  localization_->wantSamples(std::find(features.begin(), features.end(), samplesId()) !=
                             features.end());
}

void LocalizedRobot::obey() {
  std::vector<LocalizationOrder> orders;
  {
    const std::lock_guard lock(mutex_);
    orders = std::exchange(orders_, {});
  }
  for (const LocalizationOrder& order : orders) ortung::obey(order, *localization_);
}

}  // namespace ortung
