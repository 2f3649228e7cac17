#include "GivenBelief.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

#include "PoseMatrix.hpp"
#include "ortung/mcl/Belief.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMostSamples = 5'000'000;
constexpr double kFarthest = 1e6;   // farthest position that is permitted [m]
constexpr double kRounding = 1e-5;  // tolerance of correlations, for numbers with six digits
constexpr std::array<const char*, 3> kNames = {"x", "y", "theta"};

std::string nameOf(Eigen::Index row, Eigen::Index column) {
  return std::string("(") + kNames[static_cast<std::size_t>(row)] + ", " +
         kNames[static_cast<std::size_t>(column)] + ")";
}

template <class... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  throw std::invalid_argument(text.str());
}

/// Returns a matrix R with R R^T = covariance. It is computed from the correlations, so that metres
/// and radians are not compared with each other.
PoseMatrix rootOf(const PoseCovariance& given) {
  const PoseMatrix covariance = matrixOf(given);
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index k = 0; k < 3; ++k)
      if (!std::isfinite(covariance(i, k)))
        refuse("covariance ", nameOf(i, k), " is ", covariance(i, k), ", expected a finite number");
  for (Eigen::Index i = 0; i < 3; ++i)
    if (covariance(i, i) < 0.0)
      refuse("covariance ", nameOf(i, i), " is ", covariance(i, i), ", expected at least 0");
  const Eigen::Vector3d sigma = covariance.diagonal().cwiseSqrt();
  PoseMatrix correlation = PoseMatrix::Identity();
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index k = 0; k < i; ++k) {
      const double unit = sigma(i) * sigma(k);
      if (std::abs(covariance(i, k) - covariance(k, i)) > kRounding * unit)
        refuse("covariance ", nameOf(k, i), " is ", covariance(k, i), ", but ", nameOf(i, k),
               " is ", covariance(i, k), ", expected a symmetric matrix");
      if (unit == 0.0 && covariance(i, k) != 0.0)
        refuse("covariance ", nameOf(k, i), " is ", covariance(k, i), ", expected 0: one of the ",
               "two is known without error");
      if (unit > 0.0)
        correlation(i, k) = correlation(k, i) = (covariance(i, k) + covariance(k, i)) / (2 * unit);
    }
  }
  const Eigen::SelfAdjointEigenSolver<PoseMatrix> solver(correlation);
  const Eigen::Vector3d& values = solver.eigenvalues();
  if (!(values.minCoeff() >= -kRounding))
    refuse("covariance is not positive semi-definite: its correlations have the eigenvalue ",
           values.minCoeff(), ", expected at least 0");
  return sigma.asDiagonal() * solver.eigenvectors() * values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

}  // namespace

SampleSet normalSamples(const Pose2& pose, const PoseCovariance& covariance, std::size_t n,
                        Random random) {
  if (!isFinite(pose))
    refuse("pose is (", pose.x, ", ", pose.y, ", ", pose.theta, "), expected finite numbers");
  const PoseMatrix root = rootOf(covariance);
  SampleSet set;
  set.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    Eigen::Vector3d standard;
    for (double& value : standard) value = random.gaussian();
    const Eigen::Vector3d error = root * standard;
    set.x[i] = static_cast<float>(pose.x + error(0));
    set.y[i] = static_cast<float>(pose.y + error(1));
    set.theta[i] = static_cast<float>(pose.theta + error(2));
    set.logWeight[i] = 0.0F;
  }
  return set;
}

void shift(SampleSet& samples, const Pose2& change) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Pose2 moved = Pose2{samples.x[i], samples.y[i], samples.theta[i]} * change;
    samples.x[i] = static_cast<float>(moved.x);
    samples.y[i] = static_cast<float>(moved.y);
    samples.theta[i] = static_cast<float>(moved.theta);
  }
}

void Belief::check() const {
  const std::size_t n = samples.x.size();
  for (const auto* other : {&samples.y, &samples.theta, &samples.logWeight})
    if (other->size() != n)
      refuse("the belief has ", n, " x and ", other->size(), " of another kind, expected as many");
  if (n == 0 || n > kMostSamples)
    refuse("the belief has ", n, " samples, expected 1 to ", kMostSamples);
  float largest = -std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < n; ++i) {
    const double x = samples.x[i];
    const double y = samples.y[i];
    const double theta = samples.theta[i];
    const float weight = samples.logWeight[i];
    if (!(std::abs(x) <= kFarthest && std::abs(y) <= kFarthest && std::isfinite(theta)))
      refuse("sample ", i, " of the belief is at (", x, ", ", y, ", ", theta,
             "), expected numbers within ", kFarthest, " m");
    if (std::isnan(weight) || weight == std::numeric_limits<float>::infinity())
      refuse("sample ", i, " of the belief has the logarithmic weight ", weight,
             ", expected a number");
    largest = std::max(largest, weight);
  }
  if (!std::isfinite(largest)) refuse("all samples of the belief have the weight 0");
}

}  // namespace ortung
