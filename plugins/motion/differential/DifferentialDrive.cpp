#include <array>
#include <cmath>

#include "../common/OdometryErrors.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/Words.hpp"
#include "ortung/sim_api/Drive.hpp"

namespace ortung {
namespace {

/// The table [drive] of a robot with two driven wheels.
struct DifferentialSettings {
  DriveLimits limits;            ///< `max_speed_m_s`, `max_turn_deg_s`, `acceleration_m_s2`, ...
  double axle = 0.36;            ///< `axle_m`: distance between the wheels [m]
  double maxWheelSpeed = 100.0;  ///< `max_wheel_speed_m_s`: greatest speed of a wheel [m/s]
  double slipShare = 0.0;        ///< `slip_share`: share of a wheel's distance that is lost by slip
  /// `slip_sigma_m`: noise of a wheel's distance on the floor after 1 m [m].
  double slipSigma = 0.0;
  double ticksPerMetre = 0.0;  ///< `encoder_ticks_per_m`; 0: infinitely fine encoders
  /// `encoder_sigma_m`: noise of each wheel's measured distance after 1 m [m].
  double encoderSigma = 0.0;
  OdometryErrors errors;

  static DifferentialSettings read(const Parameters& drive) {
    DifferentialSettings s;
    s.limits.speed = drive.numberOr("max_speed_m_s", s.limits.speed, {0.01, 20.0});
    s.limits.turn = radiansOr(drive, "max_turn_deg_s", radians(120.0), {1.0, 1440.0});
    s.limits.acceleration =
        drive.numberOr("acceleration_m_s2", s.limits.acceleration, {0.01, 100.0});
    s.limits.turnAcceleration =
        radiansOr(drive, "turn_acceleration_deg_s2", radians(360.0), {1.0, 36000.0});
    s.axle = drive.numberOr("axle_m", s.axle, {0.01, 10.0});
    s.maxWheelSpeed = drive.numberOr("max_wheel_speed_m_s", s.maxWheelSpeed, {0.01, 100.0});
    s.slipShare = drive.numberOr("slip_share", 0.0, {0.0, 0.9});
    s.slipSigma = drive.numberOr("slip_sigma_m", 0.0, {0.0, 1.0});
    s.ticksPerMetre = drive.numberOr("encoder_ticks_per_m", 0.0, {0.0, 1e7});
    s.encoderSigma = drive.numberOr("encoder_sigma_m", 0.0, {0.0, 1.0});
    s.errors = OdometryErrors::read(drive);
    return s;
  }
};

/// Speeds or distances of the two wheels.
struct Wheels {
  double left = 0.0;
  double right = 0.0;
};

/// Returns @p value moved towards @p goal by at most @p step.
double approach(double value, double goal, double step) {
  return value + std::clamp(goal - value, -step, step);
}

/// The encoder of a wheel, which counts whole ticks.
class Encoder {
 public:
  /// Returns the distance that the ticks of @p way report [m].
  double measure(double way, double ticksPerMetre) {
    if (ticksPerMetre <= 0.0) return way;
    const double ticks = (way + rest_) * ticksPerMetre;
    const double whole = std::floor(ticks);
    rest_ = (ticks - whole) / ticksPerMetre;
    return whole / ticksPerMetre;
  }

 private:
  double rest_ = 0.0;  ///< distance since the last tick [m]
};

/// Two driven wheels: accelerations are limited, and the robot moves on an arc.
class DifferentialDrive : public Drive {
 public:
  explicit DifferentialDrive(const Parameters& p) : settings_(DifferentialSettings::read(p)) {}

  void setTranslationalVelocity(double metresPerSecond) override {
    wantedSpeed_ = std::clamp(metresPerSecond, -settings_.limits.speed, settings_.limits.speed);
  }
  void setRotationalVelocity(double radiansPerSecond) override {
    wantedTurn_ = std::clamp(radiansPerSecond, -settings_.limits.turn, settings_.limits.turn);
  }
  /// A command that exceeds a limit is scaled as a whole, so that the curve stays the same.
  void setCommand(std::span<const double> command) override {
    const double speed = (command[0] + command[1]) / 2.0;
    const double turn = (command[1] - command[0]) / settings_.axle;
    const double share = std::max(
        {1.0, std::abs(speed) / settings_.limits.speed, std::abs(turn) / settings_.limits.turn});
    wantedSpeed_ = speed / share;
    wantedTurn_ = turn / share;
  }
  std::size_t commandSize() const override { return 2; }
  std::string kind() const override { return motion::kDifferential; }
  std::string commandHelp() const override { return "[left, right] wheel speed [m/s]"; }
  DriveLimits limits() const override { return settings_.limits; }

  Pose2 relocate(double dt, Random* noise) override {
    const double share = shareOfWheels();
    const double oldSpeed = speed_;
    const double oldTurn = turn_;
    speed_ = approach(speed_, share * wantedSpeed_, settings_.limits.acceleration * dt);
    turn_ = approach(turn_, share * wantedTurn_, settings_.limits.turnAcceleration * dt);
    // Linear acceleration: the mean of both velocities gives the exact distance and turn.
    const Twist mean{(oldSpeed + speed_) / 2.0, 0.0, (oldTurn + turn_) / 2.0};
    lost_ = slip(mean, dt, noise);
    if (lost_.left == 0.0 && lost_.right == 0.0) return moved(mean, dt);
    return moved({mean.x - (lost_.left + lost_.right) / (2.0 * dt), 0.0,
                  mean.theta - (lost_.right - lost_.left) / (settings_.axle * dt)},
                 dt);
  }
  Twist velocity() const override { return {speed_, 0.0, turn_}; }
  /// Wheels do not roll sideways, so a push from the side does not change their speeds.
  void setVelocity(const Twist& velocity) override {
    speed_ = std::clamp(velocity.x, -settings_.limits.speed, settings_.limits.speed);
    turn_ = std::clamp(velocity.theta, -settings_.limits.turn, settings_.limits.turn);
  }

  Pose2 measure(const Pose2& trueChange, Random* noise) override {
    tellWheelSpeeds();
    if (noise == nullptr) return trueChange;
    const double half = trueChange.theta / 2.0;
    const double chord = trueChange.x * std::cos(half) + trueChange.y * std::sin(half);
    const double way = chord + (lost_.left + lost_.right) / 2.0;
    const double turn = trueChange.theta + (lost_.right - lost_.left) / settings_.axle;
    const Wheels seen =
        read({way - turn * settings_.axle / 2.0, way + turn * settings_.axle / 2.0}, *noise);
    const double seenWay = (seen.left + seen.right) / 2.0;
    const double seenTurn = (seen.right - seen.left) / settings_.axle;
    return settings_.errors.measured(seenWay, seenTurn, *noise);
  }
  Twist measuredVelocity(bool noise) const override {
    if (!noise) return velocity();
    return {speed_ * settings_.errors.distanceScale, 0.0, turn_ * settings_.errors.turnScale};
  }
  std::span<const std::uint32_t> motionData() const override { return motionData_; }
  std::string motionDataHelp() const override {
    return "left, right wheel speed [2^31 + mm/s], commanded velocities [2^31 + mm/s, "
           "2^31 + 1/100 degree/s]";
  }

 private:
  Wheels wheelsOf(const Twist& velocity) const {
    const double turn = velocity.theta * settings_.axle / 2.0;
    return {velocity.x - turn, velocity.x + turn};
  }
  void tellWheelSpeeds() {
    const Wheels wheels = wheelsOf(velocity());
    motionData_ = {words::fromSignedMetres(wheels.left), words::fromSignedMetres(wheels.right),
                   words::fromSignedMetres(wantedSpeed_), words::fromRate(wantedTurn_)};
  }

  /// Returns the share of the wanted velocities that the wheels can reach; both are scaled by it,
  /// so the curve stays the same.
  double shareOfWheels() const {
    const double fastest = std::abs(wantedSpeed_) + std::abs(wantedTurn_) * settings_.axle / 2.0;
    return fastest > settings_.maxWheelSpeed ? settings_.maxWheelSpeed / fastest : 1.0;
  }

  /// Returns the distances of the wheels that are lost by slip [m].
  Wheels slip(const Twist& mean, double dt, Random* noise) const {
    const Wheels speeds = wheelsOf(mean);
    const auto lost = [&](double way) {
      double slipped = settings_.slipShare * way;
      if (noise != nullptr && settings_.slipSigma > 0.0)
        slipped += settings_.slipSigma * std::sqrt(std::abs(way)) * noise->gaussian();
      return slipped;
    };
    Wheels both;
    both.left = lost(speeds.left * dt);
    both.right = lost(speeds.right * dt);
    return both;
  }

  Wheels read(const Wheels& ways, Random& noise) {
    const auto noisy = [&](double way) {
      if (settings_.encoderSigma <= 0.0) return way;
      return way + settings_.encoderSigma * std::sqrt(std::abs(way)) * noise.gaussian();
    };
    Wheels seen;
    seen.left = left_.measure(noisy(ways.left), settings_.ticksPerMetre);
    seen.right = right_.measure(noisy(ways.right), settings_.ticksPerMetre);
    return seen;
  }

  DifferentialSettings settings_;
  double wantedSpeed_ = 0.0;  ///< commanded speed [m/s]
  double wantedTurn_ = 0.0;   ///< commanded turn rate [rad/s]
  double speed_ = 0.0;
  double turn_ = 0.0;
  Wheels lost_;  ///< distances lost by slip in the last cycle [m]
  Encoder left_;
  Encoder right_;
  std::array<std::uint32_t, 4> motionData_{words::kOffset, words::kOffset, words::kOffset,
                                           words::kOffset};
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("differential_drive",
               ortung::provide<ortung::Drive, ortung::DifferentialDrive>("differential"));
