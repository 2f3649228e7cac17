#pragma once

#include <cstddef>
#include <memory>

#include "BeamRows.hpp"
#include "ortung/core/Polishable.hpp"

namespace ortung {

/// How far the ends of beams are from what they show, in standard deviations of the model: a row of
/// each quantity.
class FitResiduals {
 public:
  /// Residuals are summed up in so many lanes, the same on any machine.
  static constexpr std::size_t kLanes = 8;
  /// Those of a block of beams, across their surfaces, or along them.
  struct Block {
    BeamRows::Row<double> off;
    BeamRows::Row<double> x;      ///< derivatives of the expectation by the robot's x,
    BeamRows::Row<double> y;      ///< y
    BeamRows::Row<double> theta;  ///< and theta
    BeamRows::Row<double> lever;  ///< derivative of the distance by theta [m]
  };

  /// @param most greatest number of residuals
  explicit FitResiduals(std::size_t most);

  /// @param follows whether its beam is next to that of the residual before
  void add(const Block& block, std::size_t i, bool follows);
  bool isEmpty() const { return size_ == 0; }
  /// Root mean square of the levers [m].
  double lever() const;
  /// @param outliers share of residuals that are none of the model's
  Slope slope(double outliers);

 private:
  /// Whether a residual follows the one before is 1 or 0.
  enum Row { kOff, kFollows, kX, kY, kTheta, kRows };

  /// Number of residuals that loops do. Those behind the last one count for nothing.
  std::size_t padded() const { return (size_ + kLanes - 1) / kLanes * kLanes; }
  double* row(Row which) {
    return rows_.get() + static_cast<std::size_t>(which) * stride_ + kLanes;
  }
  float* squares() { return floats_.get() + kLanes; }
  /// How probably each is no outlier.
  float* shares() { return floats_.get() + stride_ + kLanes; }
  void pad();
  void judge(double variance, double outliers);
  double scatter(double outliers);

  std::size_t stride_;  ///< there is room before and behind each row
  std::size_t size_ = 0;
  double levers_ = 0.0;  ///< sum of squares [m^2]
  std::unique_ptr<double[]> rows_;
  std::unique_ptr<float[]> floats_;
};

}  // namespace ortung
