#pragma once

#include <array>
#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/vision/FieldLines.hpp"
#include "ortung/vision/LinesInSight.hpp"
#include "ortung/vision/Verdict.hpp"

namespace ortung {

/// Whether the points of one picture say where it was taken.
struct LinePoseVerdict {
  Verdict verdict;
  /// Standard deviations of x [m], y [m] and heading [rad].
  std::array<double, 3> sigmas{};
  /// Covariance of x, y and heading, row by row [m^2, m rad, rad^2].
  std::array<double, 9> covariance{};
  /// How much worse the second-best place is: its cost over all independent points, less that of
  /// the pose. 9 is what an error of three sigmas costs. Negative: another place fits better.
  double rivalCost = 0.0;
  Pose2 rival;  ///< the second-best place; the pose itself if there is no other
};

/// Judges a pose at which points on lines fit a field: points within 5 m, points on no line, lines
/// that should be in sight and are not, the second-best pose, and the pose's covariance. Where the
/// field looks the same after half a turn, the pose on its other side is no rival.
/// @param points points in one frame on the floor [m], size N
/// @param sigmas standard deviations of their places [m], size N
/// @param pose   the pose to be judged, as LinePoseSearch finds it
/// @param inSight what the picture shows of the lines; nothing found and missing: not judged
ORTUNG_API LinePoseVerdict judgePose(const LinePoseSearch& field, std::span<const LinePlace> points,
                                     std::span<const double> sigmas, const Pose2& pose,
                                     const LinesInSight& inSight);

}  // namespace ortung
