#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/base/InstructionSet.hpp"

/// Cost of a scan against rows of expected levels: the inner loop of weighting.
namespace ortung {

inline constexpr std::size_t kScanBlock = 64;  ///< readings are padded to a multiple of this
inline constexpr std::size_t kLevelDifferences =
    32;  ///< the sensor model's table; the last entry is the floor

/// A reading in the terms of a row of expected levels, beam j of the row's run at index j.
struct ScanReading {
  std::span<const std::uint8_t> levels;  ///< RangeScale levels, size a multiple of kScanBlock
  std::span<const std::uint8_t> caps;    ///< greatest cost of each beam; 0: not used (and padding)
  /// What a difference of levels counts for each beam, in units of 2^-shift, in [0, 127]; none: 1.
  std::span<const std::uint8_t> steps;
  int shift = 0;  ///< exponent of the unit of `steps`, in [0, kMostShift]
  /// Costs by steps of difference, not falling.
  std::array<std::uint8_t, kLevelDifferences> costs{};
};
inline constexpr int kMostShift = 9;  ///< products and half a unit have 15 bits

/// Returns the number of readings up to the last that counts: the rest need not be fetched.
inline std::size_t usedLength(const ScanReading& reading) {
  std::size_t n = reading.caps.size();
  while (n > 0 && reading.caps[n - 1] == 0) --n;
  return n;
}

/// costs[i] = sum over beams j of min(caps[j], reading.costs[min(31, d_j)]), where d_j is
/// |rows[i][j] - levels[j]|, times steps[j] / 2^shift and rounded to the nearest if there are
/// steps. Rows must be readable for levels.size() bytes. All kernels give the same sums.
using ScanCostKernel = void (*)(const ScanReading& reading,
                                std::span<const std::uint8_t* const> rows, std::uint32_t* costs);

#ifdef ORTUNG_NEON
/// The kernel for NEON.
void scanCostNeon(const ScanReading& reading, std::span<const std::uint8_t* const> rows,
                  std::uint32_t* costs);
#endif

/// The kernel for an instruction set, or nullptr if this machine (or build) does not have it.
ORTUNG_API ScanCostKernel scanCostKernel(InstructionSet set);

/// The kernel for instructionSet().
ORTUNG_API ScanCostKernel scanCostKernel();

}  // namespace ortung
