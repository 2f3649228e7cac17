#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "ortung/base/Angles.hpp"
#include "ortung/formats/PoseFixData.hpp"

namespace ortung {

/// Positions found in scans, compared with the truth: right is one of them within 0.3 m and
/// 0.2 rad.
struct FoundPositions {
  std::size_t scans = 0;
  std::size_t certain = 0;  ///< scans with one position alone
  std::size_t certainlyWrong = 0;
  std::size_t wrong = 0;       ///< scans with positions, none of which is right
  std::vector<double> errors;  ///< of the best of a scan's positions, if it is right [m]
  double squares = 0.0;        ///< of their errors in sigmas, summed

  std::size_t fixed() const { return errors.size() + wrong; }
  double nees() const { return squares / static_cast<double>(errors.size()); }

  /// Returns whether the positions, if any, have the right one among them.
  bool add(const PoseFixData::Reading& fixes, const Pose2& truth) {
    ++scans;
    if (fixes.empty()) return true;
    const auto& best = *std::min_element(fixes.begin(), fixes.end(), [&](auto& a, auto& b) {
      return distance(a.pose, truth) < distance(b.pose, truth);
    });
    const Eigen::Vector3d error(best.pose.x - truth.x, best.pose.y - truth.y,
                                wrapAngle(best.pose.theta - truth.theta));
    const bool isRight = error.head<2>().norm() < 0.3 && std::abs(error[2]) < 0.2;
    certain += fixes.size() == 1 ? 1 : 0;
    certainlyWrong += fixes.size() == 1 && !isRight ? 1 : 0;
    wrong += isRight ? 0 : 1;
    if (!isRight) return false;
    errors.push_back(error.head<2>().norm());
    const Eigen::Matrix3d covariance = Eigen::Map<const Eigen::Matrix3d>(best.covariance.data());
    squares += error.dot(covariance.ldlt().solve(error));
    return true;
  }

  /// @pre there is a right one
  double medianError() {
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::nth_element(errors.begin(), middle, errors.end());
    return *middle;
  }
};

}  // namespace ortung
