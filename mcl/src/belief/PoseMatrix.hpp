#pragma once

#include <Eigen/Core>

#include "ortung/base/Angles.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/PoseCovariance.hpp"

namespace ortung {

// Poses and covariances as Eigen computes with them: axes x [m], y [m], heading [rad].

using PoseMatrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

inline PoseMatrix matrixOf(const PoseCovariance& covariance) {
  return Eigen::Map<const PoseMatrix>(covariance.data());
}

inline Eigen::Map<PoseMatrix> inPlace(PoseCovariance& covariance) {
  return Eigen::Map<PoseMatrix>(covariance.data());
}

inline Eigen::Vector3d difference(const Pose2& to, const Pose2& from) {
  return {to.x - from.x, to.y - from.y, wrapAngle(to.theta - from.theta)};
}

/// Returns the derivative of a moved pose by the pose before, both in the field frame: an error of
/// the heading turns the displacement.
inline Eigen::Matrix3d derivativeOfMoved(const Pose2& before, const Pose2& after) {
  Eigen::Matrix3d derivative = Eigen::Matrix3d::Identity();
  derivative(0, 2) = before.y - after.y;
  derivative(1, 2) = after.x - before.x;
  return derivative;
}

}  // namespace ortung
