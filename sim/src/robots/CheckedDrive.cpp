#include "CheckedDrive.hpp"

#include <cmath>
#include <stdexcept>

namespace ortung {

CheckedDrive::CheckedDrive(std::unique_ptr<Drive> drive, std::string robot)
    : drive_(std::move(drive)), robot_(std::move(robot)) {}
CheckedDrive::~CheckedDrive() = default;

double CheckedDrive::checked(const char* what, double value) const {
  if (!std::isfinite(value))
    throw std::invalid_argument("robot " + robot_ + ": " + what + " is " + std::to_string(value) +
                                ", expected a finite number");
  return value;
}

void CheckedDrive::setTranslationalVelocity(double metresPerSecond) {
  drive_->setTranslationalVelocity(checked("the translational velocity", metresPerSecond));
}

void CheckedDrive::setRotationalVelocity(double radiansPerSecond) {
  drive_->setRotationalVelocity(checked("the rotational velocity", radiansPerSecond));
}

void CheckedDrive::setCommand(std::span<const double> command) {
  if (command.size() != commandSize())
    throw std::invalid_argument("robot " + robot_ + ": a command of " +
                                std::to_string(command.size()) + " numbers, expected " +
                                std::to_string(commandSize()) + ": " + commandHelp());
  for (const double value : command) checked("a number of the command", value);
  drive_->setCommand(command);
}

}  // namespace ortung
