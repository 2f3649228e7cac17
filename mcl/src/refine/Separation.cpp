#include "Separation.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "BeliefTuning.hpp"
#include "PoseMatrix.hpp"
#include "RefineTuning.hpp"

namespace ortung {
namespace {

using namespace tuning::separation;
using tuning::common::kOutlier;

PoseDistance greater(const PoseDistance& a, const PoseDistance& b) {
  return {std::max(a.metres, b.metres), std::max(a.radians, b.radians)};
}

}  // namespace

void Separation::move(const MotionChange& change) {
  if (!expected_) return;
  expected_ = carriedOn(*expected_, change);
  way_ += std::hypot(change.mean.x, change.mean.y);
}

void Separation::follow(const PoseEstimate& now) {
  apart_ = {kKept * apart_.metres, kKept * apart_.radians};
  perMetre_ = {kKept * perMetre_.metres, kKept * perMetre_.radians};
  if (expected_) {
    const Eigen::Vector3d off = difference(now.pose, expected_->pose);
    const Eigen::Matrix3d covariance = matrixOf(expected_->covariance);
    if (off.dot(covariance.ldlt().solve(off)) > kOutlier * kOutlier) {
      const PoseDistance its{std::hypot(off.x(), off.y()), std::abs(off.z())};
      apart_ = greater(apart_, its);
      if (way_ > 0.0)  // no odometry errs by more than all of its way
        perMetre_ = greater(perMetre_,
                            {std::min(1.0, its.metres / way_), std::min(1.0, its.radians / way_)});
    }
  }
  expected_ = now;
  way_ = 0.0;
}

PoseDistance Separation::after(double way) const {
  return {apart_.metres + perMetre_.metres * way, apart_.radians + perMetre_.radians * way};
}

}  // namespace ortung
