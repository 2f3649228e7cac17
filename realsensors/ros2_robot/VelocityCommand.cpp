#include "VelocityCommand.hpp"

#include <algorithm>
#include <cmath>

namespace ortung::ros2 {
namespace {

constexpr std::size_t kMostReasons = 64;  ///< a hostile sender could make any number

}  // namespace

void VelocityCommand::refuse(const std::string& what) {
  if (leftOut_.size() < kMostReasons || leftOut_.contains(what)) ++leftOut_[what];
}

double VelocityCommand::within(double value, double most) {
  if (std::abs(value) > most) refuse("more than the robot can do, which is cut");
  return std::clamp(value, -most, most);
}

void VelocityCommand::put(const Twist& twist, std::optional<Timestamp> stamp) {
  for (const double number : {twist.linear.x, twist.linear.y, twist.angular.z})
    if (!std::isfinite(number)) return refuse("a velocity that is no number");
  if (twist.linear.y != 0.0) refuse("a velocity sideways, which no robot is told");
  const Velocity velocity{within(twist.linear.x, options_.mostForward),
                          within(twist.angular.z, options_.mostTurn)};
  arrived_ = Arrived{velocity, stamp};
}

void VelocityCommand::take(std::string_view twist) {
  std::string why;
  const auto command = fromCdr<Twist>(twist, why);
  const std::lock_guard lock(mutex_);
  if (!command) return refuse("no message: " + why);
  put(*command, std::nullopt);
}

void VelocityCommand::takeStamped(std::string_view twistStamped) {
  std::string why;
  const auto command = fromCdr<TwistStamped>(twistStamped, why);
  const std::lock_guard lock(mutex_);
  if (!command) return refuse("no message: " + why);
  const std::int64_t stamp = command->header.stamp;  // 0: unset
  put(command->twist, stamp == 0 ? std::nullopt : std::optional<Timestamp>(stamp / 1000));
}

std::optional<VelocityCommand::Velocity> VelocityCommand::due(Timestamp now) {
  const std::lock_guard lock(mutex_);
  if (now_ && now < *now_) {
    arrived_.reset();
    wanted_ = {};
    told_.reset();
  }
  now_ = now;
  if (arrived_ && arrived_->stamp && now - *arrived_->stamp > options_.patience) {
    refuse("a command that is too old");
    arrived_.reset();
  }
  if (arrived_) {
    wanted_ = arrived_->velocity;
    since_ = now;
    arrived_.reset();
  } else if (now - since_ >= options_.patience) {
    wanted_ = {};
  }
  if (told_ == wanted_) return std::nullopt;
  told_ = wanted_;
  return wanted_;
}

std::map<std::string, std::uint64_t> VelocityCommand::leftOut() const {
  const std::lock_guard lock(mutex_);
  return leftOut_;
}

}  // namespace ortung::ros2
