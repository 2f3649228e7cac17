#pragma once

#include <span>
#include <vector>

#include "ortung/base/StraightPieces.hpp"

namespace ortung {

/// A round or small body in a scan.
struct ScanCircle {
  PlanePoint middle;
  double radius = 0.0;  ///< radius [m]
};

/// The shapes into which a scan is segmented.
struct ScanShapes {
  /// Straight pieces in the sensor frame, with the sensor on their left.
  std::vector<StraightPiece> segments;
  std::vector<ScanCircle> circles;
};

struct ScanShapesConfig {
  /// Distance beyond which neighbouring points belong to different bodies [m].
  double breakDistance = 0.3;
  double lineTolerance = 0.08;  ///< greatest distance of a segment's points from its line [m]
  double shortest = 0.5;  ///< least length of a segment; shorter ones are parts of small bodies [m]
  double largestRound = 0.9;  ///< greatest width of an outline that may be a round body [m]
  int fewestPoints = 3;       ///< least number of points of a body; fewer are noise
};

/// Segments a scan: into outlines where neighbours are far from each other, and these into straight
/// segments; small outlines become circles (Kasa 1976).
/// @param ranges ranges in counter-clockwise order [m]; not finite: nothing
ScanShapes shapesOf(std::span<const float> ranges, double firstAngle, double angleStep,
                    const ScanShapesConfig& config);

}  // namespace ortung
