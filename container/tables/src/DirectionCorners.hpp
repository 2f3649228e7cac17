#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "CellCorners.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/InstructionSet.hpp"
#include "ortung/tables/DirectionTable.hpp"

namespace ortung {

/// The entries around a pose: those of four cells, each in two directions.
struct LevelsAround {
  static constexpr std::size_t kCells = 4;
  static constexpr std::int16_t kWhole = 128;  ///< sum of the weights
  /// Rows of the cells, beginning with the direction before the pose's. The pose's own cell stands
  /// in for a neighbour of which nothing is known.
  std::array<const std::uint8_t*, kCells> rows;
  /// Weight of each cell: in the direction before the pose's, then in the next.
  std::array<std::uint8_t, 2 * kCells> weights;
};

/// Returns a place among directions within one turn, in [0, turn]; 0 for NaN, and where single
/// precision has no direction. Without a branch, so that loops over it vectorize.
/// @param turn number of directions
ORTUNG_INLINE float withinTurn(float place, float turn) {
  constexpr float kMost = 1e6F;
  const bool usual = static_cast<int>(place > -kMost) & static_cast<int>(place < kMost);
  const float bounded = usual ? place : 0.0F;
  const float turns = bounded / turn;
  const auto towardsZero = static_cast<std::int32_t>(turns);
  const std::int32_t whole =
      towardsZero - static_cast<std::int32_t>(turns < static_cast<float>(towardsZero));
  return bounded - turn * static_cast<float>(whole);
}

/// Finds what a table by cell and direction knows around poses, a block of them at a time: it knows
/// the centres of cells, in its directions.
class ORTUNG_API DirectionCorners {
 public:
  static constexpr std::size_t kBlock = 64;

  /// @param firstAngle of what is looked up, in the sensor's frame [rad]
  DirectionCorners(const DirectionTable& table, float firstAngle)
      : table_(table), corners_(table.grid()), firstAngle_(firstAngle) {}

  /// @param n number of poses, at most kBlock
  void start(const SensorPoses& poses, std::size_t n);

  /// The direction before the pose's, in [0, directions).
  std::int32_t direction(std::size_t k) const { return direction_[k]; }

  /// Returns whether the table expects anything there, and what.
  bool around(std::size_t k, LevelsAround& levels) const {
    const std::int32_t* const rowOf = table_.rowIndex().data();
    const std::int32_t cell = corners_.own(k);
    const std::int32_t own = cell < 0 ? -1 : rowOf[cell];
    if (own < 0) return false;
    const std::uint8_t* const from = table_.levels().data() + direction_[k];
    const std::size_t stride = table_.stride();
    const std::int32_t lowest = corners_.lowest(k);
    const std::int32_t above = lowest + corners_.up();
    const auto rowAt = [&](std::int32_t one) {
      const std::int32_t row = rowOf[one];
      return from + static_cast<std::size_t>(row < 0 ? own : row) * stride;
    };
    levels.rows = {rowAt(lowest), rowAt(lowest + corners_.right()), rowAt(above),
                   rowAt(above + corners_.right())};
    for (std::size_t w = 0; w < kWords; ++w)
      std::memcpy(levels.weights.data() + w * kBytes, &weights_[w][k], kBytes);
    return true;
  }

 private:
  static constexpr std::size_t kWeights = 2 * LevelsAround::kCells;
  static constexpr std::size_t kBytes = sizeof(std::uint32_t);
  static constexpr std::size_t kWords = kWeights / kBytes;
  struct Start;

  const DirectionTable& table_;
  CellCorners corners_;
  float firstAngle_;
  std::array<std::int32_t, kBlock> direction_;
  /// Returns how far a weight is shifted in its word, so that it lies in memory's order.
  static constexpr std::size_t shiftOf(std::size_t weight) {
    const std::size_t byte = weight % kBytes;
    return 8 * (std::endian::native == std::endian::little ? byte : kBytes - 1 - byte);
  }

  /// As in LevelsAround, by pose: four weights a word.
  std::array<std::array<std::uint32_t, kBlock>, kWords> weights_;
};

}  // namespace ortung
