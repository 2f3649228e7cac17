#include "ortung/sim/Drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ortung {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;  // [rad]

double radiansOr(const Parameters& p, const std::string& key, double fallback,
                 const Range& degrees) {
  if (!p.has(key)) return fallback;
  return p.number(key, degrees) * std::numbers::pi / 180.0;
}

/// Brings @p value nearer to @p goal by at most @p step.
double approach(double value, double goal, double step) {
  return value + std::clamp(goal - value, -step, step);
}

/// Pose at the end of an arc of length @p way that turns by @p turn.
Pose2 arc(double way, double turn) {
  // The chord of an arc is way * sinc(turn / 2), in the direction of half the turn.
  const double half = turn / 2.0;
  const double chord = std::abs(half) < 1e-6 ? way : way * std::sin(half) / half;
  return {chord * std::cos(half), chord * std::sin(half), wrapAngle(turn)};
}

}  // namespace

Drive::~Drive() = default;
DifferentialDrive::~DifferentialDrive() = default;

DriveConfig DriveConfig::read(const Parameters& drive) {
  DriveConfig c;
  c.maxSpeed = drive.numberOr("max_speed_m_s", c.maxSpeed, {0.01, 20.0});
  c.maxTurn = radiansOr(drive, "max_turn_deg_s", c.maxTurn, {1.0, 1440.0});
  c.acceleration = drive.numberOr("acceleration_m_s2", c.acceleration, {0.01, 100.0});
  c.turnAcceleration =
      radiansOr(drive, "turn_acceleration_deg_s2", c.turnAcceleration, {1.0, 36000.0});
  c.bodyHeight = drive.numberOr("body_height_m", c.bodyHeight, {0.01, 10.0});
  c.distanceSigma = drive.numberOr("odometry_distance_sigma_m", c.distanceSigma, {0.0, 1.0});
  c.headingSigma = radiansOr(drive, "odometry_heading_sigma_deg", c.headingSigma, {0.0, 90.0});
  c.turnSigma = radiansOr(drive, "odometry_turn_sigma_deg", c.turnSigma, {0.0, 180.0});
  c.distanceScale = drive.numberOr("odometry_distance_scale", c.distanceScale, {0.5, 2.0});
  c.turnScale = drive.numberOr("odometry_turn_scale", c.turnScale, {0.5, 2.0});
  drive.refuseUnread();
  return c;
}

Pose2 DriveConfig::measure(const Pose2& change, Random* noise) const {
  if (noise == nullptr) return change;
  const double chord = std::hypot(change.x, change.y);
  const double way = change.x < 0.0 ? -chord : chord;
  const double turn = change.theta;
  // A random walk: the variance of a step grows with its length, so the noise of a way does not
  // depend on how many cycles it took.
  const double waySigma = distanceSigma * std::sqrt(chord);
  const double headingVariance =
      headingSigma * headingSigma * chord + turnSigma * turnSigma * std::abs(turn) / kTurn;
  const double measuredWay = way * distanceScale + waySigma * noise->gaussian();
  const double measuredTurn = turn * turnScale + std::sqrt(headingVariance) * noise->gaussian();
  return {measuredWay * std::cos(measuredTurn / 2.0), measuredWay * std::sin(measuredTurn / 2.0),
          wrapAngle(measuredTurn)};
}

void DifferentialDrive::setTranslationalVelocity(double metresPerSecond) {
  wantedSpeed_ = std::clamp(metresPerSecond, -config_.maxSpeed, config_.maxSpeed);
}

void DifferentialDrive::setRotationalVelocity(double radiansPerSecond) {
  wantedTurn_ = std::clamp(radiansPerSecond, -config_.maxTurn, config_.maxTurn);
}

Pose2 DifferentialDrive::relocate(double dt) {
  const double oldSpeed = speed_;
  const double oldTurn = turn_;
  speed_ = approach(speed_, wantedSpeed_, config_.acceleration * dt);
  turn_ = approach(turn_, wantedTurn_, config_.turnAcceleration * dt);
  // Linear acceleration: the mean of both velocities gives the exact way and turn.
  return arc((oldSpeed + speed_) / 2.0 * dt, (oldTurn + turn_) / 2.0 * dt);
}

}  // namespace ortung
