#include "Delays.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "BeliefTuning.hpp"
#include "Lead.hpp"
#include "RivalsTuning.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {
namespace {

using namespace tuning::delays;

constexpr double kSmallest = 1e-6;  ///< variance added to a belief, so that it can be inverted

double prior(std::size_t delay) {
  return delay == 0 ? 1.0 - kLate : kLate / static_cast<double>(Delays::kCount - 1);
}

Eigen::Vector3d apart(const Pose2& a, const Pose2& b) {
  return {a.x - b.x, a.y - b.y, wrapAngle(a.theta - b.theta)};
}

Eigen::Matrix3d informationOf(const PoseEstimate& e, const Eigen::Vector3d& more) {
  Eigen::Matrix3d covariance;
  for (Eigen::Index row = 0; row < 3; ++row)
    for (Eigen::Index column = 0; column < 3; ++column)
      covariance(row, column) = e.covariance[static_cast<std::size_t>(3 * row + column)];
  covariance.diagonal() += more;
  return covariance.inverse();
}

/// A normal distribution of the pose relative to the present estimate.
struct Normal {
  Eigen::Vector3d mean;
  Eigen::Matrix3d information;
};

Normal normalOf(const PoseEstimate& predicted, const Pose2& seen) {
  return {apart(predicted.pose, seen),
          informationOf(predicted, {kMetres * kMetres, kMetres * kMetres, kRadians * kRadians})};
}

/// ln p(readings | other) - ln p(readings | present). The belief is proportional to p(readings |
/// pose) p(pose | present), so it is the mean of p(pose | other) / p(pose | present) over the
/// belief. Directions that the readings leave open do not contribute, since the belief there is
/// what the present motion has predicted.
std::optional<double> ratio(const Normal& other, const Normal& present,
                            const Eigen::Matrix3d& belief) {
  const Eigen::LLT<Eigen::Matrix3d> all(belief + other.information - present.information);
  if (all.info() != Eigen::Success) return std::nullopt;
  const Eigen::Vector3d sum = other.information * other.mean - present.information * present.mean;
  const double squares = sum.dot(all.solve(sum)) - other.mean.dot(other.information * other.mean) +
                         present.mean.dot(present.information * present.mean);
  const double logAll = 2.0 * all.matrixLLT().diagonal().array().log().sum();
  const double nats =
      0.5 * (squares + std::log(belief.determinant()) + std::log(other.information.determinant()) -
             std::log(present.information.determinant()) - logAll);
  return std::isfinite(nats) ? std::optional(nats) : std::nullopt;
}

void normalize(std::span<double> probability) {
  const double sum = std::accumulate(probability.begin(), probability.end(), 0.0);
  for (double& p : probability) p /= sum;
}

}  // namespace

void Delays::forget() {
  for (std::size_t i = 0; i < kCount; ++i) probability_[i] = prior(i);
}

std::size_t Delays::mostProbable() const {
  return static_cast<std::size_t>(std::max_element(probability_.begin(), probability_.end()) -
                                  probability_.begin());
}

void Delays::follow(const Predicted& predicted, std::size_t inForce, const PoseEstimate& seen,
                    double seconds) {
  const Eigen::Matrix3d belief = informationOf(seen, {kSmallest, kSmallest, kSmallest});
  const Normal present = normalOf(predicted[inForce], seen.pose);
  // Readings can only add information. If the belief has less than the prediction, the motion was
  // less certain than its model says.
  const Eigen::LLT<Eigen::Matrix3d> read(belief - present.information);
  if (read.info() != Eigen::Success) return;
  std::array<double, kCount> nats{};
  double best = -std::numeric_limits<double>::infinity();  ///< best of `met` [nats]
  for (std::size_t i = 0; i < kCount; ++i) {
    const Normal other = normalOf(predicted[i], seen.pose);
    const auto here = ratio(other, present, belief);
    const auto met = ratio({Eigen::Vector3d::Zero(), other.information}, present, belief);
    if (!here || !met) return;
    nats[i] = *here;
    best = std::max(best, *met);
  }
  const double begins = 1.0 - std::exp(-kChanges * seconds);
  // The last term is for wrong odometry, which says nothing about any delay.
  for (std::size_t i = 0; i < kCount; ++i)
    probability_[i] =
        ((1.0 - begins) * probability_[i] + begins * prior(i)) *
        (std::exp(std::min(0.0, nats[i] - best)) + std::exp(-tuning::lead::kMostNatsOfAReading));
  normalize(probability_);
}

void Delays::change(std::span<const double, kCount> nats) {
  const double best = *std::max_element(nats.begin(), nats.end());
  std::array<double, kCount> now{};
  for (std::size_t i = 0; i < kCount; ++i) now[i] = std::exp(nats[i] - best);
  normalize(now);
  for (std::size_t i = 0; i < kCount; ++i)
    probability_[i] = (1.0 - kLate) * now[i] + kLate * prior(i);
}

}  // namespace ortung
