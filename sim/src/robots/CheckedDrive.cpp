#include "CheckedDrive.hpp"

#include <cmath>
#include <stdexcept>

#include "ortung/core/Format.hpp"

namespace ortung {
namespace {

/// Fastest motion that is accepted from a drive [m/s], [rad/s].
constexpr double kFastest = 1000.0;
constexpr std::size_t kMostMotionData = 16;

}  // namespace

CheckedDrive::CheckedDrive(std::unique_ptr<Drive> drive, const std::string& plugin,
                           std::string robot)
    : drive_(std::move(drive)),
      robot_(std::move(robot)),
      guard_("the drive plugin '" + plugin + "' of robot " + robot_) {}
CheckedDrive::~CheckedDrive() = default;

void CheckedDrive::checkCommand(const char* what, double value) const {
  if (!std::isfinite(value))
    throw std::invalid_argument("robot " + robot_ + ": " + what + " is " + std::to_string(value) +
                                ", expected a finite number");
}

/// @param most greatest magnitude of each number, in its unit
void CheckedDrive::checkMotion(const char* what, double x, double y, double theta,
                               double most) const {
  if (std::abs(x) <= most && std::abs(y) <= most && std::abs(theta) <= most) return;  // NaN is not
  guard_.fail(what, "it gave (" + std::to_string(x) + ", " + std::to_string(y) + ", " +
                        std::to_string(theta) +
                        "), which is not finite, or faster than 1000 m/s or rad/s");
}

void CheckedDrive::setTranslationalVelocity(double metresPerSecond) {
  checkCommand("the translational velocity", metresPerSecond);
  guard_("setTranslationalVelocity", [&] { drive_->setTranslationalVelocity(metresPerSecond); });
}

void CheckedDrive::setRotationalVelocity(double radiansPerSecond) {
  checkCommand("the rotational velocity", radiansPerSecond);
  guard_("setRotationalVelocity", [&] { drive_->setRotationalVelocity(radiansPerSecond); });
}

void CheckedDrive::setCommand(std::span<const double> command) {
  if (command.size() != commandSize())
    throw std::invalid_argument("robot " + robot_ + ": a command of " +
                                std::to_string(command.size()) + " numbers, expected " +
                                std::to_string(commandSize()) + ": " + commandHelp());
  for (const double value : command) checkCommand("a number of the command", value);
  guard_("setCommand", [&] { drive_->setCommand(command); });
}

std::size_t CheckedDrive::commandSize() const {
  return guard_("commandSize", [&] { return drive_->commandSize(); });
}

std::string CheckedDrive::kind() const {
  return guard_("kind", [&] { return Format(drive_->kind()).name(); });
}

std::string CheckedDrive::commandHelp() const {
  return guard_("commandHelp", [&] { return drive_->commandHelp(); });
}

DriveLimits CheckedDrive::limits() const {
  const DriveLimits limits = guard_("limits", [&] { return drive_->limits(); });
  for (const double limit :
       {limits.speed, limits.turn, limits.acceleration, limits.turnAcceleration})
    if (!(limit >= 0.0 && std::isfinite(limit)))
      guard_.fail("limits", "it gave " + std::to_string(limit) + ", expected numbers >= 0");
  return limits;
}

Pose2 CheckedDrive::relocate(double dt, Random* noise) {
  dt_ = dt;
  const Pose2 change = guard_("relocate", [&] { return drive_->relocate(dt, noise); });
  checkMotion("relocate", change.x, change.y, change.theta, kFastest * dt);
  return change;
}

Twist CheckedDrive::velocity() const {
  const Twist velocity = guard_("velocity", [&] { return drive_->velocity(); });
  checkMotion("velocity", velocity.x, velocity.y, velocity.theta, kFastest);
  return velocity;
}

void CheckedDrive::setVelocity(const Twist& velocity) {
  guard_("setVelocity", [&] { drive_->setVelocity(velocity); });
}

Pose2 CheckedDrive::measure(const Pose2& trueChange, Random* noise) {
  const Pose2 change = guard_("measure", [&] { return drive_->measure(trueChange, noise); });
  checkMotion("measure", change.x, change.y, change.theta, kFastest * dt_);
  return change;
}

Twist CheckedDrive::measuredVelocity(bool noise) const {
  const Twist told = guard_("measuredVelocity", [&] { return drive_->measuredVelocity(noise); });
  checkMotion("measuredVelocity", told.x, told.y, told.theta, kFastest);
  return told;
}

std::span<const std::uint32_t> CheckedDrive::motionData() const {
  const std::span<const std::uint32_t> words =
      guard_("motionData", [&] { return drive_->motionData(); });
  if (words.size() > kMostMotionData)
    guard_.fail("motionData",
                "it gave " + std::to_string(words.size()) + " words, expected at most 16");
  return words;
}

std::string CheckedDrive::motionDataHelp() const {
  return guard_("motionDataHelp", [&] { return drive_->motionDataHelp(); });
}

}  // namespace ortung
