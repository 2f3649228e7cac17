#pragma once

#include <cstddef>
#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/vision/FieldLines.hpp"

namespace ortung {

/// How far a point is from the line nearest to it.
struct LineError {
  std::size_t picture = 0;  ///< number of its picture
  LinePlace place;          ///< the point in the field frame [m]
  double error = 0.0;       ///< its distance to the line / its standard deviation, at least 0
};

/// Returns how many points of a line count as one, because errors of neighbours are alike: 1 if
/// errors are independent of each other, at most 20. It is (1 + c) / (1 - c), where c is the
/// correlation of the errors of points that follow each other along a line of one picture.
/// Points whose error is above 3 are left out.
ORTUNG_API double alikeness(const FieldLines& field, std::span<const LineError> errors);

}  // namespace ortung
