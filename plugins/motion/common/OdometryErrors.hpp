#pragma once

/// What the [drive] tables of the shipped drives have in common.

#include <algorithm>
#include <cmath>
#include <string>

#include "ortung/base/Angles.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/sim_api/Twist.hpp"

namespace ortung {

/// Reads a key in degrees. @throws ConfigError
inline double radiansOr(const Parameters& p, const std::string& key, double fallback,
                        const Range& range) {
  if (!p.has(key)) return fallback;
  return radians(p.number(key, range));
}

/// Where a body is after @p dt [s] of moving with a constant velocity in its own frame: on an arc.
inline Pose2 moved(const Twist& velocity, double dt) {
  const double turn = velocity.theta * dt;
  const double half = turn / 2.0;
  // The chord of an arc is the way times sinc(turn / 2), in the direction of half the turn.
  const double chord = std::abs(half) < 1e-6 ? dt : dt * std::sin(half) / half;
  const double c = chord * std::cos(half);
  const double s = chord * std::sin(half);
  return {c * velocity.x - s * velocity.y, s * velocity.x + c * velocity.y, wrapAngle(turn)};
}

/// How odometry walks away from the truth: at random, where variances add up over way and turn, so
/// that the noise of a way does not depend on how many cycles it took; and systematically.
struct OdometryErrors {
  double distanceSigma = 0.02;         ///< `odometry_distance_sigma_m`: after 1 m driven [m]
  double headingSigma = radians(1.0);  ///< `odometry_heading_sigma_deg`: after 1 m driven [rad]
  double turnSigma = radians(4.0);     ///< `odometry_turn_sigma_deg`: after a whole turn [rad]
  double distanceScale = 1.0;          ///< `odometry_distance_scale`: measures this times the way
  double turnScale = 1.0;              ///< `odometry_turn_scale`

  static OdometryErrors read(const Parameters& drive) {
    OdometryErrors e;
    e.distanceSigma = drive.numberOr("odometry_distance_sigma_m", e.distanceSigma, {0.0, 1.0});
    e.headingSigma = radiansOr(drive, "odometry_heading_sigma_deg", e.headingSigma, {0.0, 90.0});
    e.turnSigma = radiansOr(drive, "odometry_turn_sigma_deg", e.turnSigma, {0.0, 180.0});
    e.distanceScale = drive.numberOr("odometry_distance_scale", e.distanceScale, {0.5, 2.0});
    e.turnScale = drive.numberOr("odometry_turn_scale", e.turnScale, {0.5, 2.0});
    return e;
  }

  double measuredWay(double way, Random& noise) const {
    return way * distanceScale + distanceSigma * std::sqrt(std::abs(way)) * noise.gaussian();
  }
  /// @param way driven meanwhile [m], not negative
  double measuredTurn(double turn, double way, Random& noise) const {
    const double variance =
        headingSigma * headingSigma * way + turnSigma * turnSigma * std::abs(turn) / kTurn;
    return turn * turnScale + std::sqrt(variance) * noise.gaussian();
  }
  /// Change of pose of a robot that drives where it faces. @param way below 0: backwards [m]
  Pose2 measured(double way, double turn, Random& noise) const {
    const double itsWay = measuredWay(way, noise);
    const double itsTurn = measuredTurn(turn, std::abs(way), noise);
    return {itsWay * std::cos(itsTurn / 2.0), itsWay * std::sin(itsTurn / 2.0), wrapAngle(itsTurn)};
  }
};

}  // namespace ortung
