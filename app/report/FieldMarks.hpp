#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "ortung/tables/FieldModel.hpp"

namespace ortung::app {

/// Lines, and landmarks, of a field that are drawn at most.
inline constexpr std::size_t kMostMarks = 5000;

/// The way along a line's middle as straight pieces, (x, y) [m]: its two ends, or many points of an
/// arc.
std::vector<std::array<double, 2>> pointsOf(const FieldLine& line);

}  // namespace ortung::app
