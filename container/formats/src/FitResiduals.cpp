#include "FitResiduals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "ortung/base/FastMath.hpp"
#include "ortung/base/Widest.hpp"

namespace ortung {
namespace {

constexpr std::size_t kLanes = FitResiduals::kLanes;
/// Number of residuals by which the model's scatter and correlation count beside the measured ones.
constexpr double kSupposed = 10.0;
constexpr double kMostAlike = 0.95;
constexpr int kScatterSteps = 4;
constexpr double kLeastScatter = 0.01;    ///< least scatter, as a share of the model's variance
constexpr float kLeastOutliers = 1e-30F;  ///< share of outliers below which it counts as none

/// Computes how probably residuals are no outliers, in single precision.
struct InlierShares {
  /// @param squares squared residuals [variances of the model] @param variance of those that are no
  /// outliers, in the same unit
  ORTUNG_INLINE static void run(const float* squares, float variance, float outliers, float* shares,
                                std::size_t n) {
    const float halfPrecision = -0.5F / variance;
    for (std::size_t k = 0; k < n; ++k) {
      const float inlier = (1.0F - outliers) * powerOfE(halfPrecision * squares[k]);
      shares[k] = inlier / (inlier + outliers);
    }
  }
};

/// Adds up shares, and squares by their shares.
struct ScatterSums {
  ORTUNG_INLINE static void run(const float* squares, const float* shares, std::size_t n,
                                double* sums) {
    std::array<double, kLanes> count{};
    std::array<double, kLanes> sum{};
    for (std::size_t k = 0; k < n; k += kLanes)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const auto share = static_cast<double>(shares[k + lane]);
        count[lane] += share;
        sum[lane] += share * static_cast<double>(squares[k + lane]);
      }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      sums[lane] = count[lane];
      sums[kLanes + lane] = sum[lane];
    }
  }
};

/// Pointers to rows of residuals.
struct Rows {
  const double* off;
  const double* follows;
  const double* x;
  const double* y;
  const double* theta;
  const float* shares;
};

/// Adds up what residuals say of the pose: nine sums of kLanes lanes.
struct SlopeSums {
  ORTUNG_INLINE static void run(Rows rows, std::size_t n, double* sums) {
    std::array<std::array<double, kLanes>, 9> all{};
    for (std::size_t k = 0; k < n; k += kLanes)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const auto share = static_cast<double>(rows.shares[k + lane]);
        const double off = rows.off[k + lane];
        const double x = rows.x[k + lane];
        const double y = rows.y[k + lane];
        const double theta = rows.theta[k + lane];
        all[0][lane] += share * x * off;
        all[1][lane] += share * y * off;
        all[2][lane] += share * theta * off;
        all[3][lane] += share * x * x;
        all[4][lane] += share * x * y;
        all[5][lane] += share * x * theta;
        all[6][lane] += share * y * y;
        all[7][lane] += share * y * theta;
        all[8][lane] += share * theta * theta;
      }
    for (std::size_t row = 0; row < all.size(); ++row)
      for (std::size_t lane = 0; lane < kLanes; ++lane) sums[row * kLanes + lane] = all[row][lane];
  }
};

/// Adds up products of neighbouring residuals, and the mean squares of these.
struct LikenessSums {
  ORTUNG_INLINE static void run(Rows rows, std::size_t n, double* sums) {
    std::array<double, kLanes> products{};
    std::array<double, kLanes> squares{};
    const double* before = rows.off - 1;
    const float* sharesBefore = rows.shares - 1;
    for (std::size_t k = 0; k < n; k += kLanes)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const float its = rows.shares[k + lane];
        const float last = sharesBefore[k + lane];
        const double both = rows.follows[k + lane] * static_cast<double>(its < last ? its : last);
        const double a = rows.off[k + lane];
        const double b = before[k + lane];
        products[lane] += both * (a * b);
        squares[lane] += both * (0.5 * (a * a + b * b));
      }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      sums[lane] = products[lane];
      sums[kLanes + lane] = squares[lane];
    }
  }
};

double total(const double* sums) { return std::accumulate(sums, sums + kLanes, 0.0); }

}  // namespace

FitResiduals::FitResiduals(std::size_t most)
    : stride_(most + 2 * kLanes),
      rows_(std::make_unique_for_overwrite<double[]>(kRows * stride_)),
      floats_(std::make_unique_for_overwrite<float[]>(2 * stride_)) {}

void FitResiduals::add(const Block& block, std::size_t i, bool follows) {
  const std::size_t at = size_++;
  row(kOff)[at] = block.off[i];
  row(kFollows)[at] = follows ? 1.0 : 0.0;
  row(kX)[at] = block.x[i];
  row(kY)[at] = block.y[i];
  row(kTheta)[at] = block.theta[i];
  squares()[at] = static_cast<float>(block.off[i] * block.off[i]);
  levers_ += block.lever[i] * block.lever[i];
}

/// Sets what loops read before the first residual and behind the last one.
void FitResiduals::pad() {
  const std::size_t behind = padded() - size_;
  for (int which = 0; which < kRows; ++which) {
    double* values = row(static_cast<Row>(which));
    values[-1] = 0.0;
    std::fill_n(values + size_, behind, 0.0);
  }
  shares()[-1] = 0.0F;
  std::fill_n(squares() + size_, behind, 0.0F);
}

double FitResiduals::lever() const { return std::sqrt(levers_ / static_cast<double>(size_)); }

void FitResiduals::judge(double variance, double outliers) {
  runWidest<InlierShares>(squares(), static_cast<float>(variance),
                          std::max(static_cast<float>(outliers), kLeastOutliers), shares(),
                          padded());
  std::fill_n(shares() + size_, padded() - size_, 0.0F);
}

/// Returns the variance of residuals that are no outliers, in variances of the model, by
/// expectation maximization from the model's.
double FitResiduals::scatter(double outliers) {
  double variance = 1.0;
  std::array<double, 2 * kLanes> sums;
  for (int k = 0; k < kScatterSteps; ++k) {
    judge(variance, outliers);
    runWidest<ScatterSums>(squares(), shares(), padded(), sums.data());
    const double count = kSupposed + total(sums.data());
    const double squares = kSupposed * variance + total(sums.data() + kLanes);
    variance = std::clamp(squares / count, kLeastScatter, 1.0);
  }
  return variance;
}

Slope FitResiduals::slope(double outliers) {
  pad();
  const double variance = scatter(outliers);
  judge(variance, outliers);
  const Rows rows{row(kOff), row(kFollows), row(kX), row(kY), row(kTheta), shares()};
  std::array<double, 9 * kLanes> sums;
  runWidest<LikenessSums>(rows, padded(), sums.data());
  const double alike =
      std::clamp(total(sums.data()) / (total(sums.data() + kLanes) + 1e-9), 0.0, kMostAlike);
  runWidest<SlopeSums>(rows, padded(), sums.data());
  const double worth = (1.0 - alike) / (1.0 + alike) / variance;
  const auto sum = [&](std::size_t k) { return worth * total(sums.data() + k * kLanes); };
  Slope slope;
  slope.pull = {sum(0), sum(1), sum(2)};
  slope.information = {sum(3), sum(4), sum(5), sum(4), sum(6), sum(7), sum(5), sum(7), sum(8)};
  return slope;
}

}  // namespace ortung
