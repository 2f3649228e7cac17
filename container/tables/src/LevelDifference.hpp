#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "DirectionCorners.hpp"
#include "ortung/base/InstructionSet.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/tables/RangeScale.hpp"

/// How far a range is from what the levels around a pose expect. Rounding both to levels would cost
/// more than most sensors' noise does, so the difference is counted in parts of a level.
namespace ortung {

inline constexpr std::int16_t kPartsALevel = 4;
/// Standard deviation of what a table has rounded to levels [levels].
inline constexpr double kRoundingOfLevels = 0.29;
/// Levels further apart may be those of different surfaces, of which either may be in sight. A wall
/// that is seen at 15 degrees recedes by four widths of a cell from one cell to the next.
inline constexpr std::int16_t kMostOnOneSurface = 24;
/// How far a surface's own levels differ from cell to cell, where it ends.
inline constexpr std::int16_t kAlongOneSurface = 8;

/// Returns where a range lies on a scale [parts of a level]; beyond the greatest range: what
/// RangeScale::kNothing has.
inline std::int16_t partsOf(const RangeScale& scale, double range) {
  const auto parts = [](double levels) {
    return static_cast<std::int16_t>(std::lround(levels * kPartsALevel));
  };
  const std::uint8_t level = scale.level(range);
  if (level == RangeScale::kNothing) return parts(level);
  const double at = scale.range(level);
  const int beside = level + (range > at ? 1 : -1);
  if (beside < 0 || beside >= RangeScale::kNothing) return parts(level);
  const double width = std::abs(scale.range(static_cast<std::uint8_t>(beside)) - at);
  return parts(level + (range - at) / width);
}

/// Returns the range at a place of a scale; its greatest range where that has no level.
inline double rangeOfParts(const RangeScale& scale, std::int16_t parts) {
  const int level = parts / kPartsALevel;
  if (level >= RangeScale::kNothing - 1) return scale.range(static_cast<std::uint8_t>(level));
  const double share = static_cast<double>(parts % kPartsALevel) / kPartsALevel;
  return (1.0 - share) * scale.range(static_cast<std::uint8_t>(level)) +
         share * scale.range(static_cast<std::uint8_t>(level + 1));
}

/// What a table knows of one direction around a pose.
class LevelMix {
 public:
  LevelMix() = default;
  /// @param sum of the levels, each times its weight; @param low, high least and greatest level
  ORTUNG_INLINE LevelMix(std::int16_t sum, std::uint8_t low, std::uint8_t high)
      : sum_(sum), low_(low), high_(high) {}

  ORTUNG_INLINE void add(std::int16_t level, std::int16_t weight) {
    sum_ = static_cast<std::int16_t>(sum_ + static_cast<std::int16_t>(level * weight));
    low_ = level < low_ ? level : low_;
    high_ = level > high_ ? level : high_;
  }
  /// Returns how far a reading is from the levels: from their mean, or from the nearer one of two
  /// surfaces. Both are in parts of a level.
  ORTUNG_INLINE std::int16_t differenceTo(std::int16_t reading) const {
    const auto off = static_cast<std::int16_t>(reading - mean());
    const auto ofOne = static_cast<std::int16_t>(off < 0 ? -off : off);
    const auto overLow = static_cast<std::int16_t>(reading - low_ * kPartsALevel);
    const auto underHigh = static_cast<std::int16_t>(high_ * kPartsALevel - reading);
    const std::int16_t within = overLow < underHigh ? overLow : underHigh;
    const auto beyond = static_cast<std::int16_t>(within - kAlongOneSurface * kPartsALevel);
    const std::int16_t between = beyond > 0 ? beyond : std::int16_t{0};
    const auto outside = static_cast<std::int16_t>(-within);
    const std::int16_t ofTwo = outside > between ? outside : between;
    const std::int16_t nearer = ofTwo < ofOne ? ofTwo : ofOne;
    return isEdge() ? nearer : ofOne;
  }
  /// Their mean [parts of a level].
  ORTUNG_INLINE std::int16_t mean() const {
    constexpr std::uint16_t kDivisor = LevelsAround::kWhole / kPartsALevel;
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(sum_ + kDivisor / 2) / kDivisor);
  }
  /// Whether they are of different surfaces.
  ORTUNG_INLINE bool isEdge() const {
    return static_cast<std::int16_t>(high_ - low_) > kMostOnOneSurface;
  }
  std::int16_t low() const { return low_; }
  std::int16_t high() const { return high_; }

 private:
  std::int16_t sum_ = 0;
  std::int16_t low_ = RangeScale::kNothing;
  std::int16_t high_ = 0;
};

/// Returns what a table knows of one direction around pose @p k of a block.
inline LevelMix mixAround(const DirectionTable& table, const DirectionCorners& corners,
                          std::size_t k, const LevelsAround& levels) {
  const int next = corners.direction(k) + 1 < table.directions() ? 1 : 1 - table.directions();
  LevelMix mix;
  for (std::size_t c = 0; c < LevelsAround::kCells; ++c) {
    mix.add(levels.rows[c][0], levels.weights[2 * c]);
    mix.add(levels.rows[c][next], levels.weights[2 * c + 1]);
  }
  return mix;
}

/// Returns what a direction at a pose is expected to read [m]; empty: nothing is known there.
inline std::optional<double> rangeBetween(const DirectionTable& table, const RangeScale& scale,
                                          const Pose2& sensor) {
  const std::uint8_t* own = table.row(sensor.x, sensor.y);
  if (own == nullptr) return std::nullopt;
  const auto x = static_cast<float>(sensor.x);
  const auto y = static_cast<float>(sensor.y);
  const auto theta = static_cast<float>(sensor.theta);
  DirectionCorners corners(table, 0.0F);
  corners.start({&x, &y, &theta}, 1);
  LevelsAround levels;
  if (!corners.around(0, levels)) return std::nullopt;
  const LevelMix mix = mixAround(table, corners, 0, levels);
  if (mix.isEdge()) return scale.range(own[table.directionOf(sensor.theta)]);
  return rangeOfParts(scale, mix.mean());
}

/// The levels of four cells in consecutive directions: each direction's part of the sums is
/// computed once, though it counts as the one before a beam and as the next one of the beam before.
class DirectionSums {
 public:
  static constexpr std::size_t kBlock = 32;         ///< directions of one vectorized loop
  static constexpr std::size_t kMost = 8 * kBlock;  ///< beams at a time

  /// @param n number of beams from the rows' place @p first on, a multiple of kBlock
  ORTUNG_INLINE void take(const LevelsAround& around, std::size_t first, std::size_t n) {
    for (std::size_t block = 0; block < n; block += kBlock) takeSome<kBlock>(around, first, block);
    takeSome<1>(around, first, n);
  }
  /// What is around the pose in the direction of beam @p k.
  ORTUNG_INLINE LevelMix of(std::size_t k) const {
    const std::uint8_t low = low_[k] < low_[k + 1] ? low_[k] : low_[k + 1];
    const std::uint8_t high = high_[k] > high_[k + 1] ? high_[k] : high_[k + 1];
    return {static_cast<std::int16_t>(before_[k] + next_[k + 1]), low, high};
  }

 private:
  template <std::size_t kCount>
  ORTUNG_INLINE void takeSome(const LevelsAround& around, std::size_t first, std::size_t at) {
    const std::uint8_t* rowA = around.rows[0] + first + at;
    const std::uint8_t* rowB = around.rows[1] + first + at;
    const std::uint8_t* rowC = around.rows[2] + first + at;
    const std::uint8_t* rowD = around.rows[3] + first + at;
    const auto weight = [&](std::size_t i) { return std::int16_t{around.weights[i]}; };
    const std::int16_t a0 = weight(0), a1 = weight(1), b0 = weight(2), b1 = weight(3);
    const std::int16_t c0 = weight(4), c1 = weight(5), d0 = weight(6), d1 = weight(7);
    for (std::size_t k = 0; k < kCount; ++k) {
      const std::uint8_t a = rowA[k];
      const std::uint8_t b = rowB[k];
      const std::uint8_t c = rowC[k];
      const std::uint8_t d = rowD[k];
      before_[at + k] = static_cast<std::int16_t>(a * a0 + b * b0 + c * c0 + d * d0);
      next_[at + k] = static_cast<std::int16_t>(a * a1 + b * b1 + c * c1 + d * d1);
      const std::uint8_t lowAB = a < b ? a : b;
      const std::uint8_t lowCD = c < d ? c : d;
      low_[at + k] = lowAB < lowCD ? lowAB : lowCD;
      const std::uint8_t highAB = a > b ? a : b;
      const std::uint8_t highCD = c > d ? c : d;
      high_[at + k] = highAB > highCD ? highAB : highCD;
    }
  }

  std::array<std::int16_t, kMost + 1> before_;  ///< levels times their weights as the one before
  std::array<std::int16_t, kMost + 1> next_;
  std::array<std::uint8_t, kMost + 1> low_;
  std::array<std::uint8_t, kMost + 1> high_;
};

/// Differences of the beams of a scan from what is expected around a pose, by loops that compilers
/// turn into vectors of any machine.
struct LevelDifferences {
  static constexpr std::size_t kBlock = DirectionSums::kBlock;  ///< n is a multiple of it
  /// @param reading, differences one a beam [parts of a level], 255 at most
  /// @pre rows can be read for n + 1 entries
  ORTUNG_INLINE static void run(const LevelsAround& around, const std::int16_t* reading,
                                std::size_t n, std::uint8_t* differences) {
    DirectionSums sums;
    std::array<std::uint8_t, kBlock> found;  // shares no memory with what is read
    for (std::size_t first = 0; first < n; first += DirectionSums::kMost) {
      const std::size_t size = std::min(DirectionSums::kMost, n - first);
      sums.take(around, first, size);
      for (std::size_t begin = 0; begin < size; begin += kBlock) {
        for (std::size_t k = 0; k < kBlock; ++k) {
          const std::int16_t difference =
              sums.of(begin + k).differenceTo(reading[first + begin + k]);
          found[k] = static_cast<std::uint8_t>(difference < 255 ? difference : 255);
        }
        std::copy(found.begin(), found.end(), differences + first + begin);
      }
    }
  }
};

}  // namespace ortung
