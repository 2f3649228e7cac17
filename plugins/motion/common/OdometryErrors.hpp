#pragma once

/// The part that the [drive] tables of the shipped drives have in common.

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

/// Returns the change of pose after @p dt [s] with a constant velocity in the body's own frame,
/// which is an arc.
inline Pose2 moved(const Twist& velocity, double dt) {
  const double turn = velocity.theta * dt;
  const double half = turn / 2.0;
  // The chord of an arc is its length times sinc(turn / 2), in the direction of half the turn.
  const double chord = std::abs(half) < 1e-6 ? dt : dt * std::sin(half) / half;
  const double c = chord * std::cos(half);
  const double s = chord * std::sin(half);
  return {c * velocity.x - s * velocity.y, s * velocity.x + c * velocity.y, wrapAngle(turn)};
}

/// The errors of odometry: random ones, whose variances are proportional to distance and turn, so
/// that the noise over a distance does not depend on the number of cycles; and systematic ones.
struct OdometryErrors {
  double distanceSigma = 0.02;  ///< `odometry_distance_sigma_m`: error of distance after 1 m [m]
  /// `odometry_heading_sigma_deg`: error of heading after 1 m [rad].
  double headingSigma = radians(1.0);
  /// `odometry_turn_sigma_deg`: error of heading after a full turn [rad].
  double turnSigma = radians(4.0);
  double distanceScale = 1.0;  ///< `odometry_distance_scale`: measured by true distance
  double turnScale = 1.0;      ///< `odometry_turn_scale`: measured by true turn

  static OdometryErrors read(const Parameters& drive) {
    OdometryErrors e;
    e.distanceSigma = drive.numberOr("odometry_distance_sigma_m", e.distanceSigma, {0.0, 1.0});
    e.headingSigma = radiansOr(drive, "odometry_heading_sigma_deg", e.headingSigma, {0.0, 90.0});
    e.turnSigma = radiansOr(drive, "odometry_turn_sigma_deg", e.turnSigma, {0.0, 180.0});
    e.distanceScale = drive.numberOr("odometry_distance_scale", e.distanceScale, {0.5, 2.0});
    e.turnScale = drive.numberOr("odometry_turn_scale", e.turnScale, {0.5, 2.0});
    return e;
  }

  /// Returns the measured distance [m].
  double measuredWay(double way, Random& noise) const {
    return way * distanceScale + distanceSigma * std::sqrt(std::abs(way)) * noise.gaussian();
  }
  /// Returns the measured turn [rad]. @param way distance driven meanwhile [m], not negative
  double measuredTurn(double turn, double way, Random& noise) const {
    const double variance =
        headingSigma * headingSigma * way + turnSigma * turnSigma * std::abs(turn) / kTurn;
    return turn * turnScale + std::sqrt(variance) * noise.gaussian();
  }
  /// Returns the measured change of pose of a robot that drives where it faces. @param way
  /// distance, negative if backwards [m]
  Pose2 measured(double way, double turn, Random& noise) const {
    const double itsWay = measuredWay(way, noise);
    const double itsTurn = measuredTurn(turn, std::abs(way), noise);
    return {itsWay * std::cos(itsTurn / 2.0), itsWay * std::sin(itsTurn / 2.0), wrapAngle(itsTurn)};
  }
};

}  // namespace ortung
