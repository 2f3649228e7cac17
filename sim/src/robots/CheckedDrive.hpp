#pragma once

#include <memory>
#include <string>

#include "ortung/core/PluginGuard.hpp"
#include "ortung/sim_api/Drive.hpp"

namespace ortung {

/// Wraps a drive and checks its calls. Commands of clients and players that are not finite or of
/// the wrong size are refused with std::invalid_argument; exceptions of the drive, and numbers that
/// are not finite or faster than any base, become a PluginFailure that names it.
class CheckedDrive final : public Drive {
 public:
  CheckedDrive(std::unique_ptr<Drive> drive, const std::string& plugin, std::string robot);
  ~CheckedDrive() override;

  void setTranslationalVelocity(double metresPerSecond) override;
  void setRotationalVelocity(double radiansPerSecond) override;
  void setCommand(std::span<const double> command) override;
  std::size_t commandSize() const override;
  std::string kind() const override;
  std::string commandHelp() const override;
  DriveLimits limits() const override;
  Pose2 relocate(double dt, Random* noise) override;
  Twist velocity() const override;
  void setVelocity(const Twist& velocity) override;
  Pose2 measure(const Pose2& trueChange, Random* noise) override;
  Twist measuredVelocity(bool noise) const override;
  std::span<const std::uint32_t> motionData() const override;
  std::string motionDataHelp() const override;

 private:
  void checkCommand(const char* what, double value) const;
  void checkMotion(const char* what, double x, double y, double theta, double most) const;

  std::unique_ptr<Drive> drive_;
  std::string robot_;
  PluginGuard guard_;
  double dt_ = 0.0;  ///< time step of the last relocate() [s]
};

}  // namespace ortung
