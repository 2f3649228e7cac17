#pragma once

#include <span>
#include <vector>

#include "WallRaster.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {

/// A point of a straight outline, in the scanner's frame.
struct OutlinePoint {
  double x = 0.0;  ///< [m]
  double y = 0.0;
  double direction = 0.0;  ///< of the outline, with the scanner on its left [rad]
};

struct PlaceSearchConfig {
  double least = 0.5;            ///< share of the points that must lie at walls
  double alike = 0.7;            ///< share of the best place's points that others must have
  std::size_t most = 64;         ///< greatest number of places
  double apart = 0.3;            ///< poses that are nearer to each other are one place [m], ...
  double turned = 0.1;           ///< ... if their headings are, too [rad]
  std::size_t effort = 4000000;  ///< greatest number of squares of the field that are looked at
};

struct FoundPlaces {
  std::vector<Pose2> scanners;  ///< poses of the scanner in the field frame, the best first
  bool isAll = true;            ///< false: there are more than the most, or than effort could find
};

/// Finds all places at which so many points lie at walls, in the whole field and at all headings.
/// Branch and bound leaves out what can't hold any, so none is missed, but for the width of a cell
/// and half a step of the heading: points so much farther from their walls than the raster's reach
/// may count or not.
FoundPlaces findPlaces(const WallRaster& raster, std::span<const OutlinePoint> points,
                       const PlaceSearchConfig& config);

}  // namespace ortung
