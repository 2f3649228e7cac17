#pragma once

#include <span>
#include <vector>

#include "LineFit.hpp"

namespace ortung {

/// Describes the best of some solutions: its fit, its certainty, and the best of the others whose
/// camera is another one. It looks for more of those at the second-best places of each picture.
/// @param found solutions, the best first; at least one
LineCalibration describe(const LineFit& fit, std::span<const LineSolution> found,
                         std::span<const LinePicture> pictures, const LineCalibrationGuess& guess);

}  // namespace ortung
