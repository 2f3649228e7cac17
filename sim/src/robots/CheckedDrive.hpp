#pragma once

#include <memory>
#include <string>

#include "ortung/sim_api/Drive.hpp"

namespace ortung {

/// Hands commands on to a drive, unless they are not finite or of the wrong size: they come from
/// clients and players.
class CheckedDrive final : public Drive {
 public:
  /// @param robot whom errors name
  CheckedDrive(std::unique_ptr<Drive> drive, std::string robot);
  ~CheckedDrive() override;

  void setTranslationalVelocity(double metresPerSecond) override;
  void setRotationalVelocity(double radiansPerSecond) override;
  void setCommand(std::span<const double> command) override;
  std::size_t commandSize() const override { return drive_->commandSize(); }
  std::string commandHelp() const override { return drive_->commandHelp(); }
  DriveLimits limits() const override { return drive_->limits(); }
  Pose2 relocate(double dt, Random* noise) override { return drive_->relocate(dt, noise); }
  Twist velocity() const override { return drive_->velocity(); }
  void setVelocity(const Twist& velocity) override { drive_->setVelocity(velocity); }
  Pose2 measure(const Pose2& trueChange, Random* noise) override {
    return drive_->measure(trueChange, noise);
  }
  Twist measuredVelocity(bool noise) const override { return drive_->measuredVelocity(noise); }
  std::span<const std::uint32_t> motionData() const override { return drive_->motionData(); }
  std::string motionDataHelp() const override { return drive_->motionDataHelp(); }

 private:
  double checked(const char* what, double value) const;

  std::unique_ptr<Drive> drive_;
  std::string robot_;
};

}  // namespace ortung
