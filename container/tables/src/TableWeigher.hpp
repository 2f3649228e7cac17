#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "CellLookup.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/tables/PositionTable.hpp"
#include "ortung/tables/SensorModel.hpp"

/// Weighs samples by features that are tables over the position, a block of samples at a time:
/// looking up is a loop of its own, so that the arithmetic between the lookups vectorizes.
namespace ortung {

class TableWeigher {
 public:
  static constexpr std::size_t kBlock = 64;

  /// @param grid of all tables that are asked for
  explicit TableWeigher(const FieldGrid& grid) : lookup_(grid) {}

  /// @param poses at most kBlock, alive until the next call
  void start(const SensorPoses& poses, std::size_t n) {
    poses_ = poses;
    n_ = n;
    for (std::size_t k = 0; k < n; ++k) cells_[k] = lookup_.index(poses.x[k], poses.y[k]);
  }

  /// Adds ln p of a distance to out[0 .. n). @param perSigma of the reading [1/m]
  void addDistance(const PositionTable& table, const GaussianTable& gaussian, float reading,
                   float perSigma, float* out) {
    const auto metresPerLevel = static_cast<float>(table.metresPerLevel());
    take(table.cells());
    for (std::size_t k = 0; k < n_; ++k) {
      const float residual = reading - static_cast<float>(levels_[k]) * metresPerLevel;
      setPlace(k, residual * perSigma);
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
      const float turns = (reading + poses_.theta[k]) * (1.0F / kTurnFloat) -
                          static_cast<float>(levels_[k]) * turnsPerLevel;
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
  void take(const CellTable& table) {
    const std::uint16_t* levels = table.levels().data();
    for (std::size_t k = 0; k < n_; ++k)
      levels_[k] = cells_[k] < 0 ? CellTable::kNone : levels[cells_[k]];
  }
  /// Nothing expected is as bad as the worst residual.
  void setPlace(std::size_t k, float sigmas) {
    places_[k] = levels_[k] == CellTable::kNone ? GaussianTable::kFloorPlace
                                                : GaussianTable::placeOf(sigmas);
  }
  void add(const GaussianTable& gaussian, float* out) const {
    for (std::size_t k = 0; k < n_; ++k) out[k] += gaussian.atPlace(places_[k]);
  }

  CellLookup lookup_;
  SensorPoses poses_{};
  std::size_t n_ = 0;
  std::array<std::int32_t, kBlock> cells_;
  std::array<std::int32_t, kBlock> levels_;
  std::array<std::int32_t, kBlock> places_;
};

}  // namespace ortung
