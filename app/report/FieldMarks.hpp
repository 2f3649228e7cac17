#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "ortung/tables/FieldModel.hpp"

namespace ortung::app {

/// Greatest number of lines, and of landmarks, that are drawn.
inline constexpr std::size_t kMostMarks = 5000;

/// Returns a polyline along a line's middle, (x, y) [m]: its two ends, or many points of an arc.
std::vector<std::array<double, 2>> pointsOf(const FieldLine& line);

}  // namespace ortung::app
