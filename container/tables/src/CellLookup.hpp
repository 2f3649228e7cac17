#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "ortung/base/InstructionSet.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/SampleView.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// FieldGrid::cellAt in single precision, for loops over samples.
class CellLookup {
 public:
  explicit CellLookup(const FieldGrid& grid)
      : originX_(static_cast<float>(grid.originX)),
        originY_(static_cast<float>(grid.originY)),
        perMetre_(static_cast<float>(1.0 / grid.cell)),
        columns_(grid.columns),
        rows_(grid.rows) {}

  std::ptrdiff_t operator()(float x, float y) const { return index(x, y); }

  /// Without a branch, so that loops over it vectorize. (Grids have fewer than 2^31 cells.)
  ORTUNG_INLINE std::int32_t index(float x, float y) const {
    const float column = (x - originX_) * perMetre_;
    const float row = (y - originY_) * perMetre_;
    const int inside = static_cast<int>(column >= 0.0F) & static_cast<int>(row >= 0.0F) &
                       static_cast<int>(column < static_cast<float>(columns_)) &
                       static_cast<int>(row < static_cast<float>(rows_));  // 0 for NaN
    const auto safeColumn = static_cast<std::int32_t>(inside != 0 ? column : 0.0F);
    const auto safeRow = static_cast<std::int32_t>(inside != 0 ? row : 0.0F);
    return inside != 0 ? safeRow * columns_ + safeColumn : -1;
  }

 private:
  float originX_;
  float originY_;
  float perMetre_;
  int columns_;
  int rows_;
};

/// Poses of a sensor, one a sample.
struct SensorPoses {
  const float* x;      ///< [m]
  const float* y;      ///< [m]
  const float* theta;  ///< [rad]
};

/// Finds the poses of sensors mounted at @p mount on robots.
/// @param x, y, theta out, n of each
void placeSensors(const SensorPoses& robots, const Pose2& mount, std::size_t n, float* x, float* y,
                  float* theta);

/// Calls visit(first, sensor, n) with the poses of a sensor mounted at @p mount for the samples
/// [first, first + n), at most @p kBlock at a time.
template <std::size_t kBlock, class Visit>
void forEachPoseBlock(const SampleView& robots, const Pose2& mount, Visit visit) {
  const bool atOrigin = static_cast<float>(mount.x) == 0.0F &&
                        static_cast<float>(mount.y) == 0.0F &&
                        static_cast<float>(mount.theta) == 0.0F;
  std::array<float, kBlock> x;
  std::array<float, kBlock> y;
  std::array<float, kBlock> theta;
  for (std::size_t first = 0; first < robots.size(); first += kBlock) {
    const std::size_t n = std::min(kBlock, robots.size() - first);
    const SensorPoses block{robots.x.data() + first, robots.y.data() + first,
                            robots.theta.data() + first};
    if (atOrigin) {
      visit(first, block, n);
      continue;
    }
    placeSensors(block, mount, n, x.data(), y.data(), theta.data());
    visit(first, SensorPoses{x.data(), y.data(), theta.data()}, n);
  }
}

/// Calls visit(i, x, y, theta) with the pose of a sensor mounted at @p mount for every sample.
template <class Visit>
void forEachSensorPose(const SampleView& robots, const Pose2& mount, Visit visit) {
  constexpr std::size_t kBlock = 64;
  forEachPoseBlock<kBlock>(robots, mount,
                           [&](std::size_t first, const SensorPoses& sensor, std::size_t n) {
                             for (std::size_t i = 0; i < n; ++i)
                               visit(first + i, sensor.x[i], sensor.y[i], sensor.theta[i]);
                           });
}

}  // namespace ortung
