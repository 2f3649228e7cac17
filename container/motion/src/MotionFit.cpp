#include "MotionFit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "PluginProgress.hpp"

namespace ortung {
namespace {

constexpr std::array<std::size_t, 5> kLengths = {1, 2, 4, 8, 16};  // pieces in a row
constexpr std::size_t kFewest = 30;        // least number of pieces to learn from
constexpr std::size_t kFewestChains = 20;  // least number of chains of a length
constexpr double kFewestOutliers = 0.01;
constexpr double kMostOutliers = 0.3;
constexpr double kOutlierSpread = 16.0;  // variance of outliers by that of the others
constexpr double kFarSigmas = 6.0;       // outliers farther off are no motion
constexpr int kRounds = 100;
constexpr double kSignificant = 3.0;     // standard errors
constexpr double kSmallestShare = 1e-4;  // share of a variance, so that it never becomes 0

using Terms = Eigen::Vector3d;  // the error of truth itself, and two terms that grow

/// Errors over several consecutive pieces, and what they are worth in the fit.
struct Chain {
  MotionError sum;
  double weight;
  bool longest;
  double counts = 1.0;  ///< 1, or 0 if it is too far off to be motion
  /// Precision of its error, relative to that of an error that is no outlier.
  double precision = 1.0;
};

void addChains(const std::vector<std::vector<MotionError>>& drives, std::size_t length,
               std::vector<Chain>& out) {
  std::vector<Chain> chains;
  for (const auto& drive : drives) {
    for (std::size_t begin = 0; begin + length <= drive.size(); begin += length) {
      MotionError sum;
      for (std::size_t i = begin; i < begin + length; ++i) {
        sum.error += drive[i].error;
        for (std::size_t k = 0; k < 2; ++k) {
          sum.causes[k] += drive[i].causes[k];
          sum.roughness[k] += drive[i].roughness[k];
        }
      }
      chains.push_back({sum, static_cast<double>(length), false});
    }
  }
  if (chains.size() < kFewestChains && length > 1) return;
  for (Chain& chain : out) chain.longest = false;
  for (Chain& chain : chains) chain.longest = true;
  out.insert(out.end(), chains.begin(), chains.end());
}

double gaussian(double error, double variance) {
  return std::exp(-0.5 * error * error / variance) / std::sqrt(2.0 * std::numbers::pi * variance);
}

/// Fits by expectation maximization over outliers and others; the noise by Fisher scoring.
class Fit {
 public:
  explicit Fit(std::vector<Chain> chains) : chains_(std::move(chains)) {
    double squares = 0.0;
    double weights = 0.0;
    Terms reach = Terms::Zero();
    for (const Chain& c : chains_) {
      squares += c.weight * c.sum.error * c.sum.error;
      weights += c.weight;
      reach += c.weight * terms(c);
    }
    const double mean = std::max(squares / weights, 1e-12);
    reach /= weights;
    for (int k = 0; k < 3; ++k) {
      known_[static_cast<std::size_t>(k)] = reach[k] > 1e-9;
      if (known_[static_cast<std::size_t>(k)]) variances_[k] = mean / reach[k] / 3.0;
    }
    smallest_ = mean * kSmallestShare;
  }

  void run(std::array<bool, 2> used) {
    used_ = used;
    scale_ = {};
    for (int round = 0; round < kRounds; ++round) {
      notePluginProgress();  // a round takes as long as the logs are
      weighErrors();
      fitScale();
      fitVariances();
    }
  }

  /// Returns the standard errors of the scales, from the longest chains alone: these do not
  /// overlap, and have systematic errors in them.
  std::array<double, 2> standardErrors() const {
    const Eigen::Matrix2d information = normalMatrix(true);
    std::array<double, 2> errors{};
    const Eigen::Matrix2d covariance =
        (information + 1e-12 * Eigen::Matrix2d::Identity()).inverse();
    for (int k = 0; k < 2; ++k) {
      errors[static_cast<std::size_t>(k)] =
          used_[static_cast<std::size_t>(k)] ? std::sqrt(std::max(covariance(k, k), 0.0)) : 0.0;
    }
    return errors;
  }

  MotionFit result() const {
    MotionFit fit;
    fit.scale = scale_;
    fit.truthVariance = variances_[0];
    fit.outliers = outliers_;
    for (std::size_t k = 0; k < 2; ++k) {
      fit.variance[k] = known_[k + 1] ? variances_[static_cast<int>(k) + 1] : -1.0;
    }
    double sum = 0.0;
    double weights = 0.0;
    for (const Chain& c : chains_) {
      const double v = variance(c);
      sum += c.weight * std::log((1 - outliers_) * gaussian(error(c), v) +
                                 outliers_ * gaussian(error(c), kOutlierSpread * v) +
                                 std::numeric_limits<double>::min());
      weights += c.weight;
    }
    fit.logLikelihood = sum / weights;
    return fit;
  }

 private:
  static Terms terms(const Chain& c) { return {1.0, c.sum.roughness[0], c.sum.roughness[1]}; }
  double variance(const Chain& c) const { return std::max(variances_.dot(terms(c)), smallest_); }
  double error(const Chain& c) const {
    return c.sum.error - scale_[0] * c.sum.causes[0] - scale_[1] * c.sum.causes[1];
  }

  /// Computes the weight of each error, and the share of outliers.
  void weighErrors() {
    double outliers = 0.0;
    double all = 0.0;
    for (Chain& c : chains_) {
      const double v = variance(c);
      const double e = error(c);
      c.counts = e * e < kFarSigmas * kFarSigmas * kOutlierSpread * v ? 1.0 : 0.0;
      if (c.counts == 0.0) {
        c.precision = 0.0;
        continue;
      }
      const double near = (1 - outliers_) * gaussian(e, v);
      const double far = outliers_ * gaussian(e, kOutlierSpread * v);
      const double outlier = far / (near + far);
      c.precision = 1.0 - outlier + outlier / kOutlierSpread;
      outliers += c.weight * outlier;
      all += c.weight;
    }
    if (all > 0.0) outliers_ = std::clamp(outliers / all, kFewestOutliers, kMostOutliers);
  }

  Eigen::Matrix2d normalMatrix(bool longestOnly) const {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    for (const Chain& c : chains_) {
      if (longestOnly && !c.longest) continue;
      const double w = c.precision * (longestOnly ? 1.0 : c.weight) / variance(c);
      for (int a = 0; a < 2; ++a) {
        for (int b = 0; b < 2; ++b) {
          const auto ka = static_cast<std::size_t>(a);
          const auto kb = static_cast<std::size_t>(b);
          if (used_[ka] && used_[kb]) normal(a, b) += w * c.sum.causes[ka] * c.sum.causes[kb];
        }
      }
    }
    return normal;
  }

  void fitScale() {
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (const Chain& c : chains_) {
      const double w = c.precision * c.weight / variance(c);
      for (int k = 0; k < 2; ++k) {
        const auto at = static_cast<std::size_t>(k);
        if (used_[at]) right[k] += w * c.sum.causes[at] * c.sum.error;
      }
    }
    // The ridge keeps scales at 0 that no piece determines.
    const Eigen::Matrix2d normal = normalMatrix(false) + 1e-9 * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d solution = normal.ldlt().solve(right);
    for (int k = 0; k < 2; ++k) {
      const auto at = static_cast<std::size_t>(k);
      scale_[at] = used_[at] && std::isfinite(solution[k]) ? solution[k] : 0.0;
    }
  }

  /// Regresses squared errors on the terms with which variances grow. At the maximum with no
  /// variance below 0 some of them are 0: all choices are tried.
  void fitVariances() {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Terms right = Terms::Zero();
    for (const Chain& c : chains_) {
      const double v = variance(c);
      const double w = c.counts * c.weight / (v * v);
      normal += w * terms(c) * terms(c).transpose();
      right += w * c.precision * error(c) * error(c) * terms(c);
    }
    double best = 0.0;
    Terms found = Terms::Zero();
    for (unsigned choice = 1; choice < 8; ++choice) {
      const Terms candidate = solve(normal, right, choice);
      const double gain = 2.0 * right.dot(candidate) - candidate.dot(normal * candidate);
      if (candidate.allFinite() && candidate.minCoeff() >= 0.0 && gain > best) {
        best = gain;
        found = candidate;
      }
    }
    if (best > 0.0) variances_ = 0.5 * (variances_ + found);  // half steps do not oscillate
  }

  Terms solve(const Eigen::Matrix3d& normal, const Terms& right, unsigned choice) const {
    Eigen::Matrix3d a = Eigen::Matrix3d::Identity();
    Terms b = Terms::Zero();
    for (int r = 0; r < 3; ++r) {
      const auto chosen = [&](int k) {
        return (choice >> k & 1U) != 0 && known_[static_cast<std::size_t>(k)];
      };
      if (!chosen(r)) continue;
      b[r] = right[r];
      for (int c = 0; c < 3; ++c) a(r, c) = chosen(c) ? normal(r, c) : 0.0;
    }
    return a.fullPivLu().solve(b);
  }

  std::vector<Chain> chains_;
  double outliers_ = 0.05;  ///< share of errors
  std::array<bool, 2> used_{};
  std::array<double, 2> scale_{};
  std::array<bool, 3> known_{};  ///< says whether a variance's term is ever above 0
  Terms variances_ = Terms::Zero();
  double smallest_ = 0.0;
};

}  // namespace

MotionFit fitMotion(const std::vector<std::vector<MotionError>>& drives) {
  std::size_t pieces = 0;
  for (const auto& drive : drives) pieces += drive.size();
  if (pieces < kFewest) {
    throw std::runtime_error("found " + std::to_string(pieces) +
                             " pieces of motion with odometry and truth, expected at least " +
                             std::to_string(kFewest));
  }
  std::vector<Chain> chains;
  for (const std::size_t length : kLengths) addChains(drives, length, chains);
  std::array<bool, 2> used{true, true};
  while (true) {
    Fit fit(chains);
    fit.run(used);
    const std::array<double, 2> errors = fit.standardErrors();
    MotionFit result = fit.result();
    // The least significant scale is dropped first; without it the other one may be significant.
    std::size_t worst = 2;
    double least = kSignificant;
    for (std::size_t k = 0; k < 2; ++k) {
      if (!used[k]) continue;
      const double certainty = std::abs(result.scale[k]) / std::max(errors[k], 1e-12);
      if (certainty < least) {
        least = certainty;
        worst = k;
      }
    }
    if (worst == 2) return result;
    used[worst] = false;
  }
}

}  // namespace ortung
