#pragma once

#include <cstdint>
#include <span>

#include "WallMatcher.hpp"

namespace ortung {

/// The agreement of a scan with the known walls, for one pose of the scanner.
struct Agreement {
  int seen = 0;      ///< number of beams with a range
  int agreeing = 0;  ///< number of beams that end at the wall that is expected there
  /// Number of beams that end behind a wall, or get no echo from one within reach.
  int through = 0;
  int expected = 0;  ///< number of beams that would meet a wall
};

/// A measured scan.
struct MeasuredScan {
  std::span<const float> ranges;  ///< ranges [m]; infinite: nothing within reach; NaN: not valid
  std::span<const std::uint8_t> isOfSmallBody;  ///< whether each beam ends at a small body
  double firstAngle = 0.0;                      ///< angle of beam 0 in the scanner frame [rad]
  double angleStep = 0.0;                       ///< angle from one beam to the next [rad]
  double maxRange = 0.0;                        ///< greatest range [m]
};

/// Compares a scan with the expected one if there were only the walls.
/// @param sensor pose of the scanner in the field frame
/// @param tolerance greatest distance of a point from its wall [m]
Agreement agreementOf(const MeasuredScan& scan, std::span<const MeasuredWall> walls,
                      const Pose2& sensor, double tolerance);

}  // namespace ortung
