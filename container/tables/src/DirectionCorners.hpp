#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "CellCorners.hpp"
#include "ortung/base/Angles.hpp"
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
class DirectionCorners {
 public:
  static constexpr std::size_t kBlock = CellCorners::kBlock;

  /// @param firstAngle of what is looked up, in the sensor's frame [rad]
  DirectionCorners(const DirectionTable& table, float firstAngle)
      : table_(table),
        corners_(table.grid()),
        directions_(table.directions()),
        perRadian_(static_cast<float>(table.directions() / kTurn)),
        firstAngle_(firstAngle) {}

  /// @param n number of poses, at most kBlock
  void start(const SensorPoses& poses, std::size_t n) {
    corners_.start(poses, n);
    const auto turn = static_cast<float>(directions_);
    for (std::size_t k = 0; k < n; ++k) {  // vectorizes
      const float within = withinTurn((poses.theta[k] + firstAngle_) * perRadian_, turn);
      const auto before = static_cast<std::int32_t>(within);
      const std::int32_t safe = before < directions_ ? before : directions_ - 1;
      direction_[k] = safe;
      const float share = within - static_cast<float>(safe);
      shareTurn_[k] = share < 1.0F ? share : 1.0F;
    }
  }

  /// The direction before the pose's, in [0, directions).
  std::int32_t direction(std::size_t k) const { return direction_[k]; }

  /// Returns whether the table expects anything there, and what.
  bool around(std::size_t k, LevelsAround& levels) const {
    const std::uint8_t* own = corners_.own(k) < 0 ? nullptr : table_.rowOfCell(corners_.own(k));
    if (own == nullptr) return false;
    const std::int32_t lowest = corners_.lowest(k);
    const std::array<std::int32_t, LevelsAround::kCells> cells = {
        lowest, lowest + corners_.right(), lowest + corners_.up(),
        lowest + corners_.up() + corners_.right()};
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const std::uint8_t* row = table_.rowOfCell(cells[c]);
      levels.rows[c] = (row == nullptr ? own : row) + direction_[k];
    }
    setWeights(k, levels);
    return true;
  }

 private:
  /// Weights are rounded so that their sum stays whole.
  void setWeights(std::size_t k, LevelsAround& levels) const {
    const float x = corners_.shareX(k);
    const float y = corners_.shareY(k);
    const float next = shareTurn_[k];
    const std::array<float, LevelsAround::kCells> cells = {(1 - x) * (1 - y), x * (1 - y),
                                                           (1 - x) * y, x * y};
    float sum = 0.0F;
    int before = 0;
    for (std::size_t i = 0; i < levels.weights.size(); ++i) {
      sum += cells[i / 2] * (i % 2 == 0 ? 1 - next : next);
      const int upTo = i + 1 == levels.weights.size()
                           ? LevelsAround::kWhole
                           : static_cast<int>(sum * LevelsAround::kWhole + 0.5F);
      levels.weights[i] = static_cast<std::uint8_t>(upTo - before);
      before = upTo;
    }
  }

  const DirectionTable& table_;
  CellCorners corners_;
  std::int32_t directions_;
  float perRadian_;
  float firstAngle_;
  std::array<std::int32_t, kBlock> direction_;
  std::array<float, kBlock> shareTurn_;
};

}  // namespace ortung
