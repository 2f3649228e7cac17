#pragma once

#include <string>
#include <vector>

#include "ortung/tables/FieldModel.hpp"

namespace ortung::app {

/// The text beside a landmark on a map.
struct LandmarkLabel {
  std::string text;
  bool isLeft = false;  ///< whether it is on the left, since there is no room on the right
};

/// Returns the kind of all landmarks, or "" if there are several kinds.
std::string commonKind(const FieldModel& field);

/// Returns the labels of all landmarks: the number, after the kind if there are several kinds. None
/// if there are so many that they would cover each other.
/// @param letter height of letters [m]
/// @param right x coordinate of the map's right end [m]
std::vector<LandmarkLabel> labelsOf(const FieldModel& field, double letter, double right);

}  // namespace ortung::app
