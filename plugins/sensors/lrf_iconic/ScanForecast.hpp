#pragma once

#include <cstdint>
#include <span>

#include "WallMatcher.hpp"

namespace ortung {

/// How the beams of a scan agree with the walls that are known, for the scanner at one pose.
struct Agreement {
  int seen = 0;      ///< beams with a range
  int agreeing = 0;  ///< end at the wall that is expected there
  int through = 0;   ///< end behind a wall, or where nothing comes back from one that is in reach
  int expected = 0;  ///< beams that would meet a wall
};

/// A scan as it was measured.
struct MeasuredScan {
  std::span<const float> ranges;  ///< [m]; infinite: nothing within reach; NaN: not valid
  std::span<const std::uint8_t> isOfSmallBody;  ///< by beam
  double firstAngle = 0.0;                      ///< [rad]
  double angleStep = 0.0;                       ///< [rad]
  double maxRange = 0.0;                        ///< [m]
};

/// Compares a scan with what it would be if there were nothing but the walls.
/// @param sensor pose of the scanner in the field
/// @param tolerance of a point across its wall [m]
Agreement agreementOf(const MeasuredScan& scan, std::span<const MeasuredWall> walls,
                      const Pose2& sensor, double tolerance);

}  // namespace ortung
