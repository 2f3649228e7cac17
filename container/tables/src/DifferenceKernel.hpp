#pragma once

#include <cstddef>
#include <cstdint>

#include "DirectionCorners.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/InstructionSet.hpp"

/// Differences of a scan from what is expected between cells: with those of ScanCost.hpp, the inner
/// loops of weighting.
namespace ortung {

/// Finds the differences of n beams from what is expected around a pose, as LevelMix has them, at
/// most 255. All kernels give the same.
/// @param reading one a beam [parts of a level]
/// @param n a multiple of LevelDifferences::kBlock
/// @pre rows can be read for n + 1 entries
using DifferenceKernel = void (*)(const LevelsAround& around, const std::int16_t* reading,
                                  std::size_t n, std::uint8_t* differences);

/// The kernel for an instruction set, or nullptr if this machine (or build) does not have it.
ORTUNG_API DifferenceKernel differenceKernel(InstructionSet set);

/// The kernel for instructionSet().
ORTUNG_API DifferenceKernel differenceKernel();

}  // namespace ortung
