#include "CarriedOn.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "MotionTuning.hpp"
#include "PoseMatrix.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/Widest.hpp"

namespace ortung {
namespace {

using namespace tuning::carried;

/// Sums of x, y, theta over samples, then those of their products xx, xy, xt, yy, yt, tt; in
/// strands, so that loops vectorize with the same bits however wide they are.
struct Moments {
  static constexpr std::size_t kFirstProduct = 3;
  static constexpr std::size_t kStrands = 8;
  using Strands = std::array<double, kStrands>;
  std::array<Strands, 9> sums{};

  double sum(std::size_t which) const {
    const Strands& s = sums[which];
    return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
  }
};

/// Sums up how far samples are off @p about. They are near it, so that squares lose no digits.
/// Turns are taken relative to it, so that angles near half a turn do not wrap.
struct SumMoments {
  ORTUNG_INLINE static void run(Moments* moments, const float* x, const float* y,
                                const float* theta, Pose2 about, std::size_t n) {
    constexpr double kHalf = 0.5 * kTurn;
    std::array<Moments::Strands, 9> sums{};
    const auto add = [&](std::size_t i, std::size_t k) {
      const double dx = static_cast<double>(x[i]) - about.x;
      const double dy = static_cast<double>(y[i]) - about.y;
      const double turn = static_cast<double>(theta[i]) - about.theta;
      const double dt = turn > kHalf ? turn - kTurn : turn <= -kHalf ? turn + kTurn : turn;
      sums[0][k] += dx;
      sums[1][k] += dy;
      sums[2][k] += dt;
      sums[3][k] += dx * dx;
      sums[4][k] += dx * dy;
      sums[5][k] += dx * dt;
      sums[6][k] += dy * dy;
      sums[7][k] += dy * dt;
      sums[8][k] += dt * dt;
    };
    std::size_t i = 0;
    for (; i + Moments::kStrands <= n; i += Moments::kStrands)
      for (std::size_t k = 0; k < Moments::kStrands; ++k) add(i + k, k);
    for (std::size_t k = 0; i + k < n; ++k) add(i + k, k);
    moments->sums = sums;
  }
};

}  // namespace

MotionChange changeOf(const MotionModel& motion, const Pose2& odometryChange, std::size_t samples,
                      std::uint64_t seed, std::uint64_t stream) {
  if (const auto known = momentsOf(motion, odometryChange)) return *known;
  std::array<std::vector<float>, 3> drawn;
  for (std::vector<float>& axis : drawn) axis.assign(samples, 0.0F);
  motion.sampleMotion({drawn[0], drawn[1], drawn[2]}, odometryChange, seed, stream, 0);
  Moments moments;
  runWidest<SumMoments>(&moments, drawn[0].data(), drawn[1].data(), drawn[2].data(), odometryChange,
                        samples);
  const auto n = static_cast<double>(samples);
  const std::array<double, 3> mean = {moments.sum(0) / n, moments.sum(1) / n, moments.sum(2) / n};
  MotionChange change;
  change.mean = {odometryChange.x + mean[0], odometryChange.y + mean[1],
                 wrapAngle(odometryChange.theta + mean[2])};
  std::size_t product = Moments::kFirstProduct;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = row; column < 3; ++column) {
      const double covariance = moments.sum(product++) / n - mean[row] * mean[column];
      change.covariance[3 * row + column] = change.covariance[3 * column + row] =
          row == column ? std::max(0.0, covariance) : covariance;  // by rounding
    }
  }
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
