#include "CarriedOn.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "MotionTuning.hpp"
#include "PoseMatrix.hpp"

namespace ortung {
namespace {

using namespace tuning::carried;

}  // namespace

MotionChange changeOf(const MotionModel& motion, const Pose2& odometryChange, std::size_t samples,
                      std::uint64_t seed, std::uint64_t stream) {
  std::array<std::vector<float>, 3> drawn;
  for (std::vector<float>& axis : drawn) axis.assign(samples, 0.0F);
  motion.sampleMotion({drawn[0], drawn[1], drawn[2]}, odometryChange, seed, stream, 0);
  const auto n = static_cast<double>(samples);
  // Turns are taken relative to odometry's, so that angles near half a turn do not wrap.
  std::array<std::vector<double>, 3> off;
  for (std::vector<double>& axis : off) axis.resize(samples);
  std::array<double, 3> mean{};
  for (std::size_t i = 0; i < samples; ++i) {
    off[0][i] = static_cast<double>(drawn[0][i]) - odometryChange.x;
    off[1][i] = static_cast<double>(drawn[1][i]) - odometryChange.y;
    off[2][i] = wrapAngle(static_cast<double>(drawn[2][i]) - odometryChange.theta);
    for (std::size_t k = 0; k < 3; ++k) mean[k] += off[k][i] / n;
  }
  MotionChange change;
  change.mean = {odometryChange.x + mean[0], odometryChange.y + mean[1],
                 wrapAngle(odometryChange.theta + mean[2])};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      for (std::size_t i = 0; i < samples; ++i)
        change.covariance[3 * row + column] +=
            (off[row][i] - mean[row]) * (off[column][i] - mean[column]) / n;
  return change;
}

MotionChange changeOf(const MotionModel& motion, const Pose2& odometryChange, std::uint64_t seed,
                      std::uint64_t stream) {
  // What is left of no change by rounding is none, either.
  constexpr double kRounding = 1e-12;
  if (std::max({std::abs(odometryChange.x), std::abs(odometryChange.y),
                std::abs(odometryChange.theta)}) < kRounding)
    return {};
  return changeOf(motion, odometryChange, kCopies, seed, stream);
}

PoseEstimate moved(PoseEstimate e, const Pose2& change) {
  const Pose2 before = std::exchange(e.pose, e.pose * change);
  const Eigen::Matrix3d derivative = derivativeOfMoved(before, e.pose);
  inPlace(e.covariance) = derivative * matrixOf(e.covariance) * derivative.transpose();
  return e;
}

PoseEstimate carriedOn(const PoseEstimate& estimate, const MotionModel& motion,
                       const Pose2& odometryChange, std::uint64_t seed, std::uint64_t stream) {
  return carriedOn(estimate, changeOf(motion, odometryChange, seed, stream));
}

PoseEstimate carriedOn(const PoseEstimate& estimate, const MotionChange& change, double noise) {
  PoseEstimate then = moved(estimate, change.mean);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(estimate.pose.theta, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  inPlace(then.covariance) += noise * turn * matrixOf(change.covariance) * turn.transpose();
  return then;
}

}  // namespace ortung
