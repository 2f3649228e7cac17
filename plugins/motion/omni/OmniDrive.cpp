#include <array>
#include <cmath>

#include "../common/OdometryErrors.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/Words.hpp"
#include "ortung/sim_api/Drive.hpp"

namespace ortung {
namespace {

constexpr std::size_t kWheels = 3;
constexpr double kNoLimit = 1e9;
/// Speeds at the rims, positive counter-clockwise [m/s].
using WheelSpeeds = std::array<double, kWheels>;
using Matrix = std::array<std::array<double, 3>, kWheels>;

/// Three wheels that roll freely along their axles. Wheel i is at angle a_i around the robot, at
/// distance R, and drives at right angles to that: its speed is -sin a_i x + cos a_i y + R theta.
class Kinematics {
 public:
  Kinematics(const std::array<double, kWheels>& angles, double radius) {
    for (std::size_t i = 0; i < kWheels; ++i)
      toWheels_[i] = {-std::sin(angles[i]), std::cos(angles[i]), radius};
  }
  double determinant() const {
    const Matrix& m = toWheels_;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  }
  WheelSpeeds wheels(const Twist& velocity) const {
    WheelSpeeds speeds;
    for (std::size_t i = 0; i < kWheels; ++i)
      speeds[i] = toWheels_[i][0] * velocity.x + toWheels_[i][1] * velocity.y +
                  toWheels_[i][2] * velocity.theta;
    return speeds;
  }
  /// Returns the velocity at which no wheel slips, by Cramer's rule.
  Twist velocity(const WheelSpeeds& wheels) const {
    const double whole = determinant();
    std::array<double, 3> solution{};
    for (std::size_t column = 0; column < 3; ++column) {
      Kinematics replaced(*this);
      for (std::size_t row = 0; row < kWheels; ++row) replaced.toWheels_[row][column] = wheels[row];
      solution[column] = replaced.determinant() / whole;
    }
    return {solution[0], solution[1], solution[2]};
  }

 private:
  Matrix toWheels_{};
};

struct OmniSettings {
  std::array<double, kWheels> angles{};  ///< `wheel_angles_deg` [rad]
  double radius = 0.2;         ///< `wheel_distance_m`: distance of the wheels from the middle [m]
  double maxWheelSpeed = 3.0;  ///< `max_wheel_speed_m_s` [m/s]
  double wheelAcceleration = 4.0;  ///< `wheel_acceleration_m_s2` [m/s^2]
  double maxSpeed = 0.0;           ///< `max_speed_m_s`; default: the wheels' limit alone
  double maxTurn = 0.0;            ///< `max_turn_deg_s`; default: the wheels' limit alone
  OdometryErrors errors;

  static OmniSettings read(const Parameters& drive) {
    OmniSettings s;
    const auto angles =
        drive.numbersOr("wheel_angles_deg", {60.0, 180.0, 300.0}, 3, {-360.0, 360.0});
    for (std::size_t i = 0; i < kWheels; ++i) s.angles[i] = radians(angles[i]);
    s.radius = drive.numberOr("wheel_distance_m", s.radius, {0.01, 10.0});
    constexpr double kAlmostParallel = 0.05;
    if (std::abs(Kinematics(s.angles, 1.0).determinant()) < kAlmostParallel)
      drive.fail("wheel_angles_deg",
                 "puts two wheels almost in the same place, or all on one side");
    s.maxWheelSpeed = drive.numberOr("max_wheel_speed_m_s", s.maxWheelSpeed, {0.01, 50.0});
    s.wheelAcceleration =
        drive.numberOr("wheel_acceleration_m_s2", s.wheelAcceleration, {0.01, 100.0});
    s.maxSpeed = drive.numberOr("max_speed_m_s", kNoLimit, {0.01, 50.0});
    s.maxTurn = radiansOr(drive, "max_turn_deg_s", kNoLimit, {1.0, 7200.0});
    s.errors = OdometryErrors::read(drive);
    return s;
  }
};

double largest(const WheelSpeeds& speeds) {
  return std::max({std::abs(speeds[0]), std::abs(speeds[1]), std::abs(speeds[2])});
}

Twist scaled(const Twist& velocity, double factor) {
  return {velocity.x * factor, velocity.y * factor, velocity.theta * factor};
}

/// A drive with three wheels, which moves in any direction while it turns. Limits scale velocities
/// and changes of velocity as a whole, so that their direction stays the same.
class OmniDrive : public Drive {
 public:
  explicit OmniDrive(const Parameters& p)
      : settings_(OmniSettings::read(p)), kinematics_(settings_.angles, settings_.radius) {}

  void setTranslationalVelocity(double metresPerSecond) override {
    want({metresPerSecond, 0.0, asked_.theta});
  }
  void setRotationalVelocity(double radiansPerSecond) override {
    want({asked_.x, asked_.y, radiansPerSecond});
  }
  void setCommand(std::span<const double> command) override {
    want(kinematics_.velocity({command[0], command[1], command[2]}));
  }
  std::size_t commandSize() const override { return kWheels; }
  std::string kind() const override { return motion::kOmni3; }
  std::string commandHelp() const override {
    return "[wheel 1, wheel 2, wheel 3] speed at the rim [m/s], forwards is counter-clockwise";
  }
  DriveLimits limits() const override {
    // These limits hold in every direction; in some it is faster.
    return {std::min(settings_.maxSpeed, settings_.maxWheelSpeed),
            std::min(settings_.maxTurn, settings_.maxWheelSpeed / settings_.radius),
            settings_.wheelAcceleration, settings_.wheelAcceleration / settings_.radius};
  }

  Pose2 relocate(double dt, Random*) override {
    const Twist old = velocity_;
    const Twist change{wanted_.x - old.x, wanted_.y - old.y, wanted_.theta - old.theta};
    const double needed = largest(kinematics_.wheels(change));
    const double possible = settings_.wheelAcceleration * dt;
    const double share = needed > possible ? possible / needed : 1.0;
    if (share == 1.0) {
      velocity_ = wanted_;  // avoids the rounding errors of adding and subtracting
    } else {
      velocity_ = {old.x + share * change.x, old.y + share * change.y,
                   old.theta + share * change.theta};
    }
    return moved({(old.x + velocity_.x) / 2.0, (old.y + velocity_.y) / 2.0,
                  (old.theta + velocity_.theta) / 2.0},
                 dt);
  }
  Twist velocity() const override { return velocity_; }
  void setVelocity(const Twist& velocity) override { velocity_ = limited(velocity); }

  Pose2 measure(const Pose2& trueChange, Random* noise) override {
    const WheelSpeeds wheels = kinematics_.wheels(velocity_);
    for (std::size_t i = 0; i < kWheels; ++i) motionData_[i] = words::fromSignedMetres(wheels[i]);
    if (noise == nullptr) return trueChange;
    const double way = std::hypot(trueChange.x, trueChange.y);
    const double sigma = settings_.errors.distanceSigma * std::sqrt(way);
    const double scale = settings_.errors.distanceScale;
    Pose2 measured;  // wheels are all around, so noise is the same in all directions
    measured.x = trueChange.x * scale + sigma * noise->gaussian();
    measured.y = trueChange.y * scale + sigma * noise->gaussian();
    measured.theta = wrapAngle(settings_.errors.measuredTurn(trueChange.theta, way, *noise));
    return measured;
  }
  Twist measuredVelocity(bool noise) const override {
    if (!noise) return velocity_;
    return {velocity_.x * settings_.errors.distanceScale,
            velocity_.y * settings_.errors.distanceScale,
            velocity_.theta * settings_.errors.turnScale};
  }
  std::span<const std::uint32_t> motionData() const override { return motionData_; }
  std::string motionDataHelp() const override { return "speeds of the three wheels [2^31 + mm/s]"; }

 private:
  void want(const Twist& velocity) {
    asked_ = velocity;
    wanted_ = limited(velocity);
  }
  Twist limited(const Twist& velocity) const {
    const double share =
        std::max({1.0, largest(kinematics_.wheels(velocity)) / settings_.maxWheelSpeed,
                  std::hypot(velocity.x, velocity.y) / settings_.maxSpeed,
                  std::abs(velocity.theta) / settings_.maxTurn});
    return share > 1.0 ? scaled(velocity, 1.0 / share) : velocity;
  }

  OmniSettings settings_;
  Kinematics kinematics_;
  Twist asked_;   ///< velocity of the last commands, before limits
  Twist wanted_;  ///< velocity of the last commands, within limits
  Twist velocity_;
  std::array<std::uint32_t, kWheels> motionData_{words::kOffset, words::kOffset, words::kOffset};
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("omni_drive", ortung::provide<ortung::Drive, ortung::OmniDrive>("omni"));
