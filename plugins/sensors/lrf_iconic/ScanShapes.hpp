#pragma once

#include <span>
#include <vector>

#include "ortung/base/StraightPieces.hpp"

namespace ortung {

/// A round or small piece of outline.
struct ScanCircle {
  PlanePoint middle;
  double radius = 0.0;  ///< [m]
};

/// What a scan is taken apart into.
struct ScanShapes {
  std::vector<StraightPiece> segments;  ///< in the sensor's frame; it is on their left
  std::vector<ScanCircle> circles;
};

struct ScanShapesConfig {
  double breakDistance = 0.3;   ///< farther apart, neighbouring points are not of one body [m]
  double lineTolerance = 0.08;  ///< points of one segment are within it of a straight line [m]
  double shortest = 0.5;        ///< segments shorter than this are parts of small bodies [m]
  double largestRound = 0.9;    ///< outlines up to this across may be round bodies [m]
  int fewestPoints = 3;         ///< of a body; fewer are noise
};

/// Takes a scan apart: into outlines where neighbours are far from each other, those into straight
/// segments; small outlines become circles (Kasa 1976).
/// @param ranges counter-clockwise [m]; not finite: nothing
ScanShapes shapesOf(std::span<const float> ranges, double firstAngle, double angleStep,
                    const ScanShapesConfig& config);

}  // namespace ortung
