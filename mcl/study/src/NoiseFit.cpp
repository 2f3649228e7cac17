#include "ortung/study/NoiseFit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ortung/base/Angles.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {
namespace {

constexpr std::size_t kFewest = 50;
constexpr double kBlock = 10.0;  ///< correlation time of errors [s]
constexpr double kErrors = 3.0;  ///< terms of fewer standard errors are dropped
constexpr int kRounds = 300;
constexpr double kLeastSigma = 1e-4;  ///< [m], [rad]
constexpr double kLeastShare = 1e-4;
constexpr double kMostShare = 0.9;
/// Sigmas of a prior around zero, so that terms that the data does not determine stay zero.
constexpr ByNoiseTerm<double> kPrior = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
constexpr int kKinds = 2;  ///< distances and angles
/// All numbers of the fit: the terms, and sigma, sigma per metre and outliers of each kind.
constexpr int kNumbers = static_cast<int>(kNoiseTerms) + 3 * kKinds;

using Vector = Eigen::Matrix<double, kNumbers, 1>;
using Matrix = Eigen::Matrix<double, kNumbers, kNumbers>;

struct Shape {
  std::size_t values = 0;
  double sigma = 0.0;
  double perMetre = 0.0;
  double outliers = 0.05;
  double width = 1.0;  ///< range over which outliers are spread
  bool grows = true;   ///< whether sigma grows with range
};

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The mixture of normal and outlier residuals, and its likelihood. Residuals are those without any
/// term.
class Mixture {
 public:
  Mixture(std::span<const NoiseResidual> residuals, const ByNoiseTerm<double>& already) {
    values_.assign(residuals.begin(), residuals.end());
    for (NoiseResidual& v : values_)
      for (std::size_t k = 0; k < kNoiseTerms; ++k) v.residual += v.by[k] * already[k];
    for (const bool isAngle : {false, true}) begin(isAngle);
  }

  /// Fits the wanted terms by expectation maximization.
  void fit(const ByNoiseTerm<bool>& wanted) {
    wanted_ = wanted;
    double before = -std::numeric_limits<double>::infinity();
    for (int round = 0; round < kRounds; ++round) {
      const double now = weigh();
      if (now - before < 1e-10 * static_cast<double>(values_.size())) break;
      before = now;
      fitTerms();
      for (int kind = 0; kind < kKinds; ++kind) fitShape(kind);
    }
  }

  /// Returns the covariance of all numbers, by blocks of time; it is zero for fixed ones.
  Matrix covariance(Matrix& asIfIndependent) {
    std::vector<int> open;
    for (int k = 0; k < kNumbers; ++k)
      if (isOpen(k)) open.push_back(k);
    const Matrix all = information();
    const auto n = static_cast<Eigen::Index>(open.size());
    Eigen::MatrixXd bread(n, n);
    Eigen::MatrixXd meat(n, n);
    const Matrix spread = scatter();
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) {
        const auto a = static_cast<std::size_t>(i);
        const auto b = static_cast<std::size_t>(j);
        bread(i, j) = all(open[a], open[b]);
        meat(i, j) = spread(open[a], open[b]);
      }
    const Eigen::MatrixXd inverse = bread.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
    const Eigen::MatrixXd sandwich = inverse * meat * inverse;
    Matrix result = Matrix::Zero();
    asIfIndependent = Matrix::Zero();
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) {
        const auto a = static_cast<std::size_t>(i);
        const auto b = static_cast<std::size_t>(j);
        result(open[a], open[b]) = sandwich(i, j);
        asIfIndependent(open[a], open[b]) = inverse(i, j);
      }
    return result;
  }

  const Shape& shape(int kind) const { return shapes_[static_cast<std::size_t>(kind)]; }
  double term(std::size_t k) const { return terms_[k]; }
  /// Returns the median range of residuals, at which a floor is reported.
  double usualRange() const { return usualRange_; }

 private:
  static int kindOf(const NoiseResidual& v) { return v.isAngle ? 1 : 0; }
  static int numberOf(int kind, int which) {
    return static_cast<int>(kNoiseTerms) + 3 * kind + which;
  }
  Shape& shapeOf(const NoiseResidual& v) { return shapes_[static_cast<std::size_t>(kindOf(v))]; }

  void begin(bool isAngle) {
    Shape& shape = shapes_[isAngle ? 1 : 0];
    std::vector<double> of;
    std::vector<double> ranges;
    for (const NoiseResidual& v : values_) {
      if (v.isAngle != isAngle) continue;
      of.push_back(v.residual);
      ranges.push_back(v.range);
    }
    shape.values = of.size();
    shape.grows = !isAngle;
    if (of.empty()) return;
    if (of.size() < kFewest) {
      throw std::invalid_argument("found " + std::to_string(of.size()) +
                                  (isAngle ? " bearings" : " ranges") +
                                  " beside what is expected, expected 50 at least");
    }
    const double middle = medianOf(of);
    double most = 0.0;
    for (double& r : of) {
      most = std::max(most, std::abs(r));
      r = std::abs(r - middle);
    }
    shape.sigma = std::max(kLeastSigma, 1.4826 * medianOf(of));
    shape.width = isAngle ? kTurn : 2.0 * std::max(most, 5.0 * shape.sigma);
    if (!isAngle) usualRange_ = medianOf(ranges);
  }

  bool isOpen(int number) const {
    const auto terms = static_cast<int>(kNoiseTerms);
    if (number < terms) return wanted_[static_cast<std::size_t>(number)];
    const Shape& s = shape((number - terms) / 3);
    const int which = (number - terms) % 3;
    if (s.values == 0) return false;
    if (which == 1) return s.grows && s.perMetre > 0.0;
    return which == 0 ? s.sigma > kLeastSigma : s.outliers > kLeastShare;
  }

  double error(const NoiseResidual& v) const {
    double e = v.residual;
    for (std::size_t k = 0; k < kNoiseTerms; ++k) e -= v.by[k] * terms_[k];
    return v.isAngle ? wrapAngle(e) : e;
  }

  struct Point {
    double error;
    double sigma;
    double weight;  ///< probability that it is no outlier
    double logLikelihood;
  };
  Point at(const NoiseResidual& v) const {
    const Shape& s = shape(kindOf(v));
    Point p{error(v), s.sigma + s.perMetre * v.range, 0.0, 0.0};
    const double z = p.error / p.sigma;
    const double inside =
        (1.0 - s.outliers) * std::exp(-0.5 * z * z) / (p.sigma * std::sqrt(2.0 * std::numbers::pi));
    const double outside = s.outliers / s.width;
    p.weight = inside / (inside + outside);
    p.logLikelihood = std::log(inside + outside);
    return p;
  }

  double weigh() {
    double sum = 0.0;
    points_.clear();
    for (const NoiseResidual& v : values_) {
      points_.push_back(at(v));
      sum += points_.back().logLikelihood;
    }
    return sum;
  }

  void fitTerms() {
    using Terms = Eigen::Matrix<double, static_cast<int>(kNoiseTerms), 1>;
    Eigen::Matrix<double, static_cast<int>(kNoiseTerms), static_cast<int>(kNoiseTerms)> normal;
    normal.setZero();
    Terms right = Terms::Zero();
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const double weight = points_[i].weight / (points_[i].sigma * points_[i].sigma);
      Terms by = Terms::Zero();
      for (std::size_t k = 0; k < kNoiseTerms; ++k)
        if (wanted_[k]) by[static_cast<Eigen::Index>(k)] = values_[i].by[k];
      const double whole = points_[i].error + by.dot(termsOf<Terms>());
      normal += weight * by * by.transpose();
      right += weight * whole * by;
    }
    for (std::size_t k = 0; k < kNoiseTerms; ++k) {
      const auto j = static_cast<Eigen::Index>(k);
      normal(j, j) += wanted_[k] ? 1.0 / (kPrior[k] * kPrior[k]) : 1.0;
    }
    const Terms found = normal.ldlt().solve(right);
    for (std::size_t k = 0; k < kNoiseTerms; ++k)
      terms_[k] = wanted_[k] ? found[static_cast<Eigen::Index>(k)] : 0.0;
    for (std::size_t i = 0; i < values_.size(); ++i) points_[i].error = error(values_[i]);
  }
  template <class Terms>
  Terms termsOf() const {
    return Eigen::Map<const Terms>(terms_.data());
  }

  /// Does two steps of Fisher scoring for the sigmas; the share of outliers is a mean.
  void fitShape(int kind) {
    Shape& s = shapes_[static_cast<std::size_t>(kind)];
    if (s.values == 0) return;
    double weights = 0.0;
    for (std::size_t i = 0; i < values_.size(); ++i)
      if (kindOf(values_[i]) == kind) weights += points_[i].weight;
    s.outliers = std::clamp(1.0 - weights / static_cast<double>(s.values), kLeastShare, kMostShare);
    for (int step = 0; step < 2; ++step) scoreSigmas(kind, s);
  }

  void scoreSigmas(int kind, Shape& s) {
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d score = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (kindOf(values_[i]) != kind) continue;
      const double sigma = s.sigma + s.perMetre * values_[i].range;
      const double z = points_[i].error / sigma;
      const Eigen::Vector2d by(1.0, s.grows ? values_[i].range : 0.0);
      score += points_[i].weight * (z * z - 1.0) / sigma * by;
      information += points_[i].weight * 2.0 / (sigma * sigma) * by * by.transpose();
    }
    information.diagonal().array() += 1e-9;
    Eigen::Vector2d step = s.grows ? Eigen::Vector2d(information.ldlt().solve(score))
                                   : Eigen::Vector2d(score[0] / information(0, 0), 0.0);
    if (s.perMetre + step[1] < 0.0) step = {score[0] / information(0, 0), -s.perMetre};
    if (s.sigma + step[0] < kLeastSigma && s.grows)
      step = {kLeastSigma - s.sigma, score[1] / information(1, 1)};
    // Sigmas shrink by half per step at most, so that they stay above 0.
    s.perMetre = std::max(0.0, s.perMetre + step[1]);
    s.sigma = std::max({kLeastSigma, 0.5 * s.sigma, s.sigma + step[0]});
  }

  /// Returns the derivative of one value's ln p by all numbers.
  Vector scoreOf(const NoiseResidual& v) const {
    const Point p = at(v);
    const Shape& s = shape(kindOf(v));
    const int kind = kindOf(v);
    Vector score = Vector::Zero();
    const double pull = p.weight * p.error / (p.sigma * p.sigma);
    for (std::size_t k = 0; k < kNoiseTerms; ++k)
      score[static_cast<Eigen::Index>(k)] = pull * v.by[k];
    const double z = p.error / p.sigma;
    const double widening = p.weight * (z * z - 1.0) / p.sigma;
    score[numberOf(kind, 0)] = widening;
    score[numberOf(kind, 1)] = widening * v.range;
    score[numberOf(kind, 2)] = (1.0 - p.weight) / s.outliers - p.weight / (1.0 - s.outliers);
    return score;
  }

  Vector wholeScore() const {
    Vector sum = Vector::Zero();
    for (const NoiseResidual& v : values_) sum += scoreOf(v);
    return sum;
  }

  double& number(int k) {
    const auto terms = static_cast<int>(kNoiseTerms);
    if (k < terms) return terms_[static_cast<std::size_t>(k)];
    Shape& s = shapes_[static_cast<std::size_t>((k - terms) / 3)];
    const int which = (k - terms) % 3;
    if (which == 0) return s.sigma;
    return which == 1 ? s.perMetre : s.outliers;
  }

  /// Returns minus the second derivative of ln p, by differences of the first.
  Matrix information() {
    Matrix result = Matrix::Zero();
    for (int k = 0; k < kNumbers; ++k) {
      if (!isOpen(k)) continue;
      double& value = number(k);
      const double kept = value;
      const double h = k < static_cast<int>(kNoiseTerms) ? 1e-5 : 1e-3 * kept;
      value = kept + h;
      const Vector after = wholeScore();
      value = kept - h;
      const Vector before = wholeScore();
      value = kept;
      result.col(k) = (before - after) / (2.0 * h);
    }
    return 0.5 * (result + result.transpose());
  }

  /// Returns the sum of the squared scores of all blocks of time.
  Matrix scatter() const {
    std::map<std::pair<std::size_t, std::int64_t>, Vector> blocks;
    for (const NoiseResidual& v : values_) {
      const auto block = static_cast<std::int64_t>(std::floor(toSeconds(v.stamp) / kBlock));
      blocks.try_emplace({v.log, block}, Vector::Zero()).first->second += scoreOf(v);
    }
    Matrix sum = Matrix::Zero();
    for (const auto& block : blocks) sum += block.second * block.second.transpose();
    const auto n = static_cast<double>(blocks.size());
    return n > 1.0 ? Matrix(sum * n / (n - 1.0)) : sum;
  }

  std::vector<NoiseResidual> values_;
  std::vector<Point> points_;
  std::array<Shape, kKinds> shapes_;
  ByNoiseTerm<double> terms_{};
  ByNoiseTerm<bool> wanted_{};
  double usualRange_ = 0.0;
};

Learned learned(double value, double variance) {
  return {value, std::sqrt(std::max(0.0, variance))};
}

NoiseShape shapeOf(const Mixture& mixture, int kind, const Matrix& covariance,
                   const Matrix& independent) {
  const Shape& s = mixture.shape(kind);
  const int first = static_cast<int>(kNoiseTerms) + 3 * kind;
  NoiseShape shape;
  shape.values = s.values;
  if (s.values == 0) return shape;
  shape.sigma = learned(s.sigma, covariance(first, first));
  shape.sigmaPerMetre = learned(s.perMetre, covariance(first + 1, first + 1));
  shape.outliers = learned(s.outliers, covariance(first + 2, first + 2));
  const double sigma = s.sigma + s.perMetre * mixture.usualRange() * (s.grows ? 1.0 : 0.0);
  const double peak = (1.0 - s.outliers) / (sigma * std::sqrt(2.0 * std::numbers::pi));
  shape.floor = s.outliers / s.width / (peak + s.outliers / s.width);
  const double together = covariance(kind, kind);
  const double alone = independent(kind, kind);
  if (together > 0.0 && alone > 0.0) shape.independent = std::min(1.0, alone / together);
  return shape;
}

}  // namespace

NoiseFit fitNoise(std::span<const NoiseResidual> residuals, const ByNoiseTerm<bool>& wanted,
                  const ByNoiseTerm<double>& already) {
  Mixture mixture(residuals, already);
  NoiseFit fit;
  ByNoiseTerm<bool> open = wanted;
  // The variance of biases, kept or not, says how far errors are correlated; so it is computed
  // first.
  while (true) {
    mixture.fit(open);
    Matrix independent;
    const Matrix covariance = mixture.covariance(independent);
    for (const int kind : {0, 1}) {
      const NoiseShape shape = shapeOf(mixture, kind, covariance, independent);
      NoiseShape& kept = kind == 0 ? fit.distances : fit.angles;
      const double before = kept.independent;
      const bool isAsked = open[static_cast<std::size_t>(kind)];
      kept = shape;
      if (!isAsked) kept.independent = before;
    }
    std::size_t least = kNoiseTerms;
    double fewest = kErrors;
    for (std::size_t k = 0; k < kNoiseTerms; ++k) {
      if (!open[k]) continue;
      const auto j = static_cast<Eigen::Index>(k);
      fit.terms[k] = learned(mixture.term(k), covariance(j, j));
      const double errors = std::abs(fit.terms[k].value) / std::max(fit.terms[k].error, 1e-12);
      if (errors >= fewest) continue;
      fewest = errors;
      least = k;
    }
    if (least == kNoiseTerms) break;
    open[least] = false;
    fit.terms[least].value = 0.0;
  }
  fit.isKnown = open;
  return fit;
}

}  // namespace ortung
