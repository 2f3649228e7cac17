#pragma once

#include <cmath>
#include <cstddef>

#include "ortung/container/FieldRegion.hpp"
#include "ortung/container/Pose2.hpp"
#include "ortung/container/SampleView.hpp"

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

  std::ptrdiff_t operator()(float x, float y) const {
    const float column = (x - originX_) * perMetre_;
    const float row = (y - originY_) * perMetre_;
    const bool inside = column >= 0.0F && row >= 0.0F && column < static_cast<float>(columns_) &&
                        row < static_cast<float>(rows_);  // false for NaN
    if (!inside) return -1;
    return static_cast<std::ptrdiff_t>(row) * columns_ + static_cast<std::ptrdiff_t>(column);
  }

 private:
  float originX_;
  float originY_;
  float perMetre_;
  int columns_;
  int rows_;
};

/// Calls visit(i, x, y, theta) with the pose of a sensor mounted at @p mount for every sample.
template <class Visit>
void forEachSensorPose(const SampleView& robots, const Pose2& mount, Visit visit) {
  const auto mx = static_cast<float>(mount.x);
  const auto my = static_cast<float>(mount.y);
  const auto turn = static_cast<float>(mount.theta);
  if (mx == 0.0F && my == 0.0F) {
    for (std::size_t i = 0; i < robots.size(); ++i) {
      visit(i, robots.x[i], robots.y[i], robots.theta[i] + turn);
    }
    return;
  }
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const float c = std::cos(robots.theta[i]);
    const float s = std::sin(robots.theta[i]);
    visit(i, robots.x[i] + c * mx - s * my, robots.y[i] + s * mx + c * my, robots.theta[i] + turn);
  }
}

}  // namespace ortung
