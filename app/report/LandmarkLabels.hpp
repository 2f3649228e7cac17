#pragma once

#include <string>
#include <vector>

#include "ortung/tables/FieldModel.hpp"

namespace ortung::app {

/// What a map writes beside a landmark.
struct LandmarkLabel {
  std::string text;
  bool isLeft = false;  ///< of the landmark, as there is no room on the right
};

/// All landmarks' kind, or "" if there are several.
std::string commonKind(const FieldModel& field);

/// Labels of all landmarks: the number, with the kind before it if there are several kinds. None at
/// all if there are so many that they would cover each other.
/// @param letter height of letters [m]
/// @param right end of the map [m]
std::vector<LandmarkLabel> labelsOf(const FieldModel& field, double letter, double right);

}  // namespace ortung::app
