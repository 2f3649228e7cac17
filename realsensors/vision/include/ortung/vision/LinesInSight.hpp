#pragma once

#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/camera/CameraView.hpp"
#include "ortung/vision/FieldLines.hpp"
#include "ortung/vision/FloorMask.hpp"
#include "ortung/vision/LineFinder.hpp"

namespace ortung {

/// What a picture shows of the field's lines that should be in sight: lengths along them [m], and
/// numbers of filled spots, such as penalty marks.
struct LinesInSight {
  double found = 0.0;    ///< length with points on it
  double missing = 0.0;  ///< length at which there is bare floor instead
  double hidden = 0.0;   ///< length with neither: robots, balls, glare
  int marksFound = 0;    ///< number of spots at which there is something else than floor
  int marksMissing = 0;  ///< number of spots at which there is bare floor

  /// The share of what can be told that is missing, in [0, 1]; 0 if nothing can be told.
  double missingShare() const { return found + missing > 0.0 ? missing / (found + missing) : 0.0; }
};

/// Looks for the lines of a field where a camera at a pose would see them.
/// @param sensorInField pose of the view's sensor frame in the field frame
/// @param points points on lines that were found in the picture
/// @param floor  where the picture shows floor; without a picture, nothing is taken as hidden
/// @param range  how far from the camera lines are looked for [m]
ORTUNG_API LinesInSight linesInSight(const FieldLines& field, const CameraView& view,
                                     const Pose2& sensorInField, std::span<const LinePoint> points,
                                     const FloorMask& floor, double range);

}  // namespace ortung
