#include "NoiseRatio.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "MotionTuning.hpp"

namespace ortung {
namespace {

using namespace tuning::odometry;

double factor(std::size_t k) { return std::ldexp(1.0, -static_cast<int>(k)); }

/// Returns the log of what is believed before anything is known.
double prior(std::size_t k) { return k == 0 ? 0.0 : -kCaution; }

}  // namespace

NoiseRatio::NoiseRatio() {
  for (std::size_t k = 0; k < kCount; ++k) logs_[k] = prior(k);
}

void NoiseRatio::follow(const Eigen::Vector3d& off, const Eigen::Matrix3d& motion,
                        const Eigen::Matrix3d& rest) {
  std::array<double, kCount> densities{};
  for (std::size_t k = 0; k < kCount; ++k) {
    const Eigen::LDLT<Eigen::Matrix3d> all(factor(k) * motion + rest);
    densities[k] = -0.5 * (off.dot(all.solve(off)) + all.vectorD().array().log().sum());
    if (!std::isfinite(densities[k])) return;
  }
  for (std::size_t k = 0; k < kCount; ++k) {
    const double said = std::max(densities[k] - densities[0], -kMostNats);
    logs_[k] = kKept * logs_[k] + (1.0 - kKept) * prior(k) + said;
  }
  const double most = *std::max_element(logs_.begin(), logs_.end());
  double sum = 0.0;
  double weighted = 0.0;
  for (std::size_t k = 0; k < kCount; ++k) {
    logs_[k] -= most;
    sum += std::exp(logs_[k]);
    weighted += std::exp(logs_[k]) * factor(k);
  }
  value_ = weighted / sum;
}

}  // namespace ortung
