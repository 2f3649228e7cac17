#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "CellCorners.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/tables/PositionTable.hpp"
#include "ortung/tables/SensorModel.hpp"

/// Weighs samples by features that are tables over the position, interpolated as their at() does, a
/// block of samples at a time: looking up is a loop of its own, so that
/// the arithmetic between the lookups vectorizes.
namespace ortung {

class TableWeigher {
 public:
  static constexpr std::size_t kBlock = CellCorners::kBlock;

  /// @param grid of all tables that are asked for
  explicit TableWeigher(const FieldGrid& grid) : corners_(grid) {}

  /// @param poses at most kBlock, alive until the next call
  void start(const SensorPoses& poses, std::size_t n) {
    poses_ = poses;
    n_ = n;
    corners_.start(poses, n);
  }

  /// Adds ln p of a distance to out[0 .. n). @param perSigma of the reading [1/m]
  void addDistance(const PositionTable& table, const GaussianTable& gaussian, float reading,
                   float perSigma, float* out) {
    const auto metresPerLevel = static_cast<float>(table.metresPerLevel());
    take(table.cells());
    for (std::size_t k = 0; k < n_; ++k) {
      const auto right = static_cast<float>(right1_[k] - levels_[k]);
      const auto up = static_cast<float>(up1_[k] - levels_[k]);
      const auto both = static_cast<float>(both1_[k] - levels_[k]);
      setPlace(k, (reading - between(k, right, up, both) * metresPerLevel) * perSigma);
    }
    add(gaussian, out);
  }

  /// Adds ln p of a bearing in the sensor's frame. @param perSigma [1/rad]
  void addBearing(const BearingTable& table, const GaussianTable& gaussian, float reading,
                  float perSigma, float* out) {
    constexpr float kMostTurns = 1e6F;
    const auto turnsPerLevel = static_cast<float>(BearingTable::kRadiansPerLevel / kTurn);
    take(table.cells());
    for (std::size_t k = 0; k < n_; ++k) {
      const auto right = static_cast<float>(shorter(right1_[k] - levels_[k]));
      const auto up = static_cast<float>(shorter(up1_[k] - levels_[k]));
      const auto both = static_cast<float>(shorter(both1_[k] - levels_[k]));
      const float turns = (reading + poses_.theta[k]) * (1.0F / kTurnFloat) -
                          between(k, right, up, both) * turnsPerLevel;
      const int usual =
          static_cast<int>(turns > -kMostTurns) & static_cast<int>(turns < kMostTurns);
      const float bounded = usual != 0 ? turns : 0.0F;
      const auto nearest =
          static_cast<float>(static_cast<std::int32_t>(bounded + (bounded < 0.0F ? -0.5F : 0.5F)));
      setPlace(k, (bounded - nearest) * kTurnFloat * perSigma);
    }
    add(gaussian, out);
  }

 private:
  /// Levels from one direction to another, by the shorter way.
  static std::int32_t shorter(std::int32_t way) {
    constexpr auto kDirections =
        static_cast<std::int32_t>(kTurn / BearingTable::kRadiansPerLevel + 0.5);
    constexpr std::int32_t kHalf = kDirections / 2;
    way = way > kHalf ? way - kDirections : way;
    return way < -kHalf ? way + kDirections : way;
  }

  void take(const CellTable& table) {
    const std::uint16_t* levels = table.levels().data();
    if (levels == nullptr) {  // nobody learned it
      levels_.fill(CellTable::kNone);
      return;
    }
    for (std::size_t k = 0; k < n_; ++k) {
      const std::uint16_t* corner = levels + corners_.lowest(k);
      levels_[k] = corner[0];
      right1_[k] = corner[corners_.right()];
      up1_[k] = corner[corners_.up()];
      both1_[k] = corner[corners_.up() + corners_.right()];
      own_[k] = corners_.own(k) < 0 ? CellTable::kNone : levels[corners_.own(k)];
    }
    for (std::size_t k = 0; k < n_; ++k) {  // vectorizes
      const int none = isNone(levels_[k]) | isNone(right1_[k]) | isNone(up1_[k]) |
                       isNone(both1_[k]) | isNone(own_[k]);
      levels_[k] = none != 0 ? own_[k] : levels_[k];
      right1_[k] = none != 0 ? own_[k] : right1_[k];
      up1_[k] = none != 0 ? own_[k] : up1_[k];
      both1_[k] = none != 0 ? own_[k] : both1_[k];
    }
  }
  static int isNone(std::int32_t level) { return static_cast<int>(level == CellTable::kNone); }
  float between(std::size_t k, float right, float up, float both) const {
    const float lower = corners_.shareX(k) * right;
    const float upper = up + corners_.shareX(k) * (both - up);
    return static_cast<float>(levels_[k]) + lower + corners_.shareY(k) * (upper - lower);
  }
  /// Nothing expected is as bad as the worst residual.
  void setPlace(std::size_t k, float sigmas) {
    places_[k] = levels_[k] == CellTable::kNone ? GaussianTable::kFloorPlace
                                                : GaussianTable::placeOf(sigmas);
  }
  void add(const GaussianTable& gaussian, float* out) const {
    for (std::size_t k = 0; k < n_; ++k) out[k] += gaussian.atPlace(places_[k]);
  }

  CellCorners corners_;
  SensorPoses poses_{};
  std::size_t n_ = 0;
  /// Levels of the lower left cells, or of the sample's own cell (then in all four).
  std::array<std::int32_t, kBlock> levels_;
  std::array<std::int32_t, kBlock> right1_;
  std::array<std::int32_t, kBlock> up1_;
  std::array<std::int32_t, kBlock> both1_;
  std::array<std::int32_t, kBlock> own_;
  std::array<std::int32_t, kBlock> places_;
};

}  // namespace ortung
