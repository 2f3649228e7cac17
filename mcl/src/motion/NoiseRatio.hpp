#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Learns how much less than its motion model's noise a robot's odometry errs: a Bayes filter over
/// six factors of the noise's covariance, in which what was long ago counts less. Models are
/// cautious, since samples have to cover what a robot does in the worst case; an estimate that
/// knows how good odometry is can average the noise of readings. Not thread-safe.
class ORTUNG_API NoiseRatio {
 public:
  NoiseRatio();
  /// Returns the expected factor, in (0, 1].
  double value() const { return value_; }
  /// Takes how far a pose is from where odometry has led to.
  /// @param off the difference @param motion covariance by the model's noise
  /// @param rest covariance by everything else, e.g. the readings of both poses
  void follow(const Eigen::Vector3d& off, const Eigen::Matrix3d& motion,
              const Eigen::Matrix3d& rest);

 private:
  static constexpr std::size_t kCount = 6;  ///< factors 1, 1/2, ..., 1/32
  std::array<double, kCount> logs_{};       ///< ln p of each, the greatest one 0
  double value_ = 1.0;
};

}  // namespace ortung
