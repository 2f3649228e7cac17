#include <algorithm>
#include <array>
#include <cmath>

#include "../common/OdometryErrors.hpp"
#include "NeuralSettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/Words.hpp"
#include "ortung/sim_api/Drive.hpp"

namespace ortung {
namespace {

/// Returns the constant velocity that leads to @p change in @p seconds on an arc.
Twist twistOf(const Pose2& change, double seconds) {
  const double half = change.theta / 2.0;
  const double stretch = (std::abs(half) < 1e-6 ? 1.0 : half / std::sin(half)) / seconds;
  const double c = stretch * std::cos(half);
  const double s = stretch * std::sin(half);
  return {c * change.x + s * change.y, c * change.y - s * change.x, change.theta / seconds};
}

/// A base that moves as a network has learned it from a real one. The network predicts step by
/// step; within a step the robot follows an arc to the predicted pose.
class NeuralDrive : public Drive {
 public:
  explicit NeuralDrive(const Parameters& drive)
      : network_(readNetworkOf(drive)), robot_(network_), errors_(OdometryErrors::read(drive)) {
    drive.textOr("plugin", "");
    drive.numberOr("body_height_m", 0.5);  // read by the simulator
    limits_.speed = network_.limit.translational;
    limits_.turn = network_.limit.rotational;
    limits_.acceleration = drive.numberOr("acceleration_m_s2", limits_.acceleration, {0.01, 100.0});
    limits_.turnAcceleration =
        radiansOr(drive, "turn_acceleration_deg_s2", limits_.turnAcceleration, {1.0, 36000.0});
  }

  void setTranslationalVelocity(double v) override {
    command_.translational = std::clamp(v, -limits_.speed, limits_.speed);
  }
  void setRotationalVelocity(double w) override {
    command_.rotational = std::clamp(w, -limits_.turn, limits_.turn);
  }
  void setCommand(std::span<const double> command) override {
    setTranslationalVelocity(command[0]);
    setRotationalVelocity(command[1]);
  }
  std::size_t commandSize() const override { return 2; }
  std::string kind() const override { return motion::kVelocities; }
  std::string commandHelp() const override {
    return "[translational velocity m/s, rotational velocity rad/s]";
  }
  DriveLimits limits() const override { return limits_; }

  Pose2 relocate(double dt, Random*) override {
    Pose2 change;
    double left = dt;
    while (left > kShortest) {
      if (ahead_ <= kShortest) lookAhead();
      const double now = std::min(left, ahead_);
      change = change * moved(twist_, now);
      ahead_ -= now;
      left -= now;
    }
    return change;
  }
  Twist velocity() const override { return twist_; }
  void setVelocity(const Twist& velocity) override {
    twist_ = {std::clamp(velocity.x, -limits_.speed, limits_.speed),
              std::clamp(velocity.y, -limits_.speed, limits_.speed),
              std::clamp(velocity.theta, -limits_.turn, limits_.turn)};
    robot_.setVelocity({twist_.x, twist_.theta});
  }

  Pose2 measure(const Pose2& trueChange, Random* noise) override {
    motionData_ = {words::fromSignedMetres(command_.translational),
                   words::fromRate(command_.rotational)};
    if (noise == nullptr) return trueChange;
    const double half = trueChange.theta / 2.0;
    const double way = trueChange.x * std::cos(half) + trueChange.y * std::sin(half);
    return errors_.measured(way, trueChange.theta, *noise);
  }
  Twist measuredVelocity(bool noise) const override {
    if (!noise) return velocity();
    return {twist_.x * errors_.distanceScale, 0.0, twist_.theta * errors_.turnScale};
  }
  std::span<const std::uint32_t> motionData() const override { return motionData_; }
  std::string motionDataHelp() const override {
    return "commanded velocities [2^31 + mm/s, 2^31 + 1/100 degree/s]";
  }

 private:
  static constexpr double kShortest = 1e-9;  ///< shortest time that is simulated [s]

  void lookAhead() {
    twist_ = twistOf(robot_.step(command_), network_.step);
    ahead_ = network_.step;
  }

  const MotionNetwork network_;
  NeuralRobot robot_;
  OdometryErrors errors_;
  DriveLimits limits_;
  Velocities command_;
  Twist twist_;         ///< velocity in the current step
  double ahead_ = 0.0;  ///< remaining time of the current step [s]
  std::array<std::uint32_t, 2> motionData_{words::kOffset, words::kOffset};
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("neural_drive", ortung::provide<ortung::Drive, ortung::NeuralDrive>("neural"));
