#include "ortung/study/PoseBound.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>

#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

/// Number of steps over which odometry is compared with truth: over one, rounding would look like
/// noise.
constexpr std::size_t kStride = 10;
/// Least improvement by noise of the position beyond that of the heading, which moves it, too: two
/// sigmas, for stretches that overlap.
constexpr double kSignificant = 4.0 * kStride;
constexpr double kRounded = 4.0 * 1e-6 / 12.0;  ///< variance of four words of 1 mm [m^2]
constexpr int kDraws = 8;                       ///< number of draws of errors, per step

/// Variances ahead, aside and of the turn after 1 m of distance travelled and after 1 rad of turn.
struct MotionNoise {
  Eigen::Vector3d ofWay = Eigen::Vector3d::Zero();
  Eigen::Vector3d ofTurn = Eigen::Vector3d::Zero();
};

/// Returns distance travelled and turn from one step to the next.
Eigen::Vector2d lengthOf(const BoundStep& from, const BoundStep& to) {
  return {distance(from.truth, to.truth), std::abs(wrapAngle(to.truth.theta - from.truth.theta))};
}

/// Returns the pose halfway from one step to the next, where the step's noise is added.
Pose2 middleOf(const BoundStep& from, const BoundStep& to) {
  const double turn = wrapAngle(to.truth.theta - from.truth.theta);
  return {0.5 * (from.truth.x + to.truth.x), 0.5 * (from.truth.y + to.truth.y),
          wrapAngle(from.truth.theta + 0.5 * turn)};
}

/// Least-squares fit of squared errors by N variances, none of which is below 0.
template <int N>
struct VarianceFit {
  using Vector = Eigen::Matrix<double, N, 1>;
  Eigen::Matrix<double, N, N> normal = Eigen::Matrix<double, N, N>::Identity() * 1e-12;
  Vector right = Vector::Zero();
  double squares = 0.0;
  double count = 0.0;

  void add(const Vector& times, double square) {
    normal += times * times.transpose();
    right += times * square;
    squares += square * square;
    ++count;
  }
  /// Tries all choices of variances that are 0, since there are few.
  /// @param significant least improvement by each, in variances of a square
  Vector solve(double significant) const {
    const double least = squares - right.dot(normal.ldlt().solve(right));
    const double ofChance = significant * least / std::max(count, 1.0);
    Vector best = Vector::Zero();
    double most = 0.0;
    for (int kept = 1; kept < (1 << N); ++kept) {
      Eigen::Matrix<double, N, N> some = normal;
      Vector its = right;
      for (int i = 0; i < N; ++i) {
        if (((kept >> i) & 1) != 0) continue;
        some.row(i).setZero();
        some.col(i).setZero();
        some(i, i) = 1.0;
        its[i] = 0.0;
      }
      const Vector found = some.ldlt().solve(its);
      const double explained = found.dot(its) - ofChance * std::popcount(unsigned(kept));
      if (found.minCoeff() < 0.0 || explained <= most) continue;
      best = found;
      most = explained;
    }
    return best;
  }
};

/// Errors over some steps in the frame of the last one, and the motion that causes them.
struct Stretch {
  Eigen::Vector3d error;
  Eigen::Vector2d length = Eigen::Vector2d::Zero();  ///< sums of distance and turn along the path
  // Distance and turn of each step times its squared lever: how far a turn by 1 there moves the
  // end, ahead and aside ...
  Eigen::Vector2d leverAhead = Eigen::Vector2d::Zero();
  Eigen::Vector2d leverAside = Eigen::Vector2d::Zero();
  // ... and how far 1 m ahead and aside there moves it.
  Eigen::Vector4d placeAhead = Eigen::Vector4d::Zero();
  Eigen::Vector4d placeAside = Eigen::Vector4d::Zero();
};

Stretch stretchOf(std::span<const BoundStep> steps) {
  const BoundStep& a = steps.front();
  const BoundStep& b = steps.back();
  const Pose2 error = inverse(inverse(a.truth) * b.truth) * (inverse(a.odometry) * b.odometry);
  Stretch stretch;
  stretch.error = {error.x, error.y, error.theta};
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    const Eigen::Vector2d length = lengthOf(steps[i], steps[i + 1]);
    const Pose2 middle = inverse(b.truth) * middleOf(steps[i], steps[i + 1]);
    stretch.length += length;
    stretch.leverAhead += middle.y * middle.y * length;
    stretch.leverAside += middle.x * middle.x * length;
    const double along = std::pow(std::cos(middle.theta), 2);
    Eigen::Vector4d ahead;
    ahead << along * length, (1.0 - along) * length;
    Eigen::Vector4d aside;
    aside << (1.0 - along) * length, along * length;
    stretch.placeAhead += ahead;
    stretch.placeAside += aside;
  }
  return stretch;
}

/// Fits the motion noise. Noise of the heading moves later positions: position errors that it
/// explains are not counted as noise of the position.
MotionNoise fitMotion(std::span<const BoundStep> steps) {
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i + kStride < steps.size(); ++i)
    stretches.push_back(stretchOf(steps.subspan(i, kStride + 1)));
  VarianceFit<2> turns;
  for (const Stretch& s : stretches) turns.add(s.length, s.error[2] * s.error[2]);
  const Eigen::Vector2d heading = turns.solve(0.0);
  VarianceFit<4> places;
  for (const Stretch& s : stretches) {
    places.add(s.placeAhead, s.error[0] * s.error[0] - kRounded - s.leverAhead.dot(heading));
    places.add(s.placeAside, s.error[1] * s.error[1] - kRounded - s.leverAside.dot(heading));
  }
  const Eigen::Vector4d place = places.solve(kSignificant);
  return {{place[0], place[2], heading[0]}, {place[1], place[3], heading[1]}};
}

/// Returns the covariance after an exact motion: uncertain heading becomes uncertain position.
Eigen::Matrix3d carried(const Eigen::Matrix3d& covariance, const Pose2& from, const Pose2& to) {
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  f(0, 2) = -(to.y - from.y);
  f(1, 2) = to.x - from.x;
  return f * covariance * f.transpose();
}

/// Returns the covariance after the motion from one step to the next.
Eigen::Matrix3d moved(const Eigen::Matrix3d& covariance, const BoundStep& from, const BoundStep& to,
                      const MotionNoise& noise) {
  const Eigen::Vector2d length = lengthOf(from, to);
  const Pose2 middle = middleOf(from, to);
  const Eigen::Vector3d variances = noise.ofWay * length[0] + noise.ofTurn * length[1];
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
  turned(0, 0) = turned(1, 1) = std::cos(middle.theta);
  turned(1, 0) = std::sin(middle.theta);
  turned(0, 1) = -turned(1, 0);
  const Eigen::Matrix3d halfway = carried(covariance, from.truth, middle) +
                                  turned * variances.asDiagonal() * turned.transpose();
  return carried(halfway, middle, to.truth);
}

}  // namespace

std::vector<PoseBound> poseBound(std::span<const BoundStep> steps, double sigmaStart) {
  const MotionNoise noise = fitMotion(steps);
  std::vector<PoseBound> bounds;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity() * sigmaStart * sigmaStart;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (i > 0) covariance = moved(covariance, steps[i - 1], steps[i], noise);
    // C - C (C + I^-1)^-1 C, written so that neither C nor I need have an inverse.
    const Eigen::Map<const Eigen::Matrix3d> information(steps[i].information.data());
    const Eigen::Matrix3d both = Eigen::Matrix3d::Identity() + covariance * information;
    covariance = both.partialPivLu().solve(covariance);
    covariance = 0.5 * (covariance + covariance.transpose().eval());
    PoseBound bound{steps[i].stamp, {}};
    Eigen::Map<Eigen::Matrix3d>(bound.covariance.data()) = covariance;
    bounds.push_back(bound);
  }
  return bounds;
}

BoundFigures figuresOf(std::span<const PoseBound> bounds, Timestamp since) {
  BoundFigures figures;
  std::vector<double> errors;
  double squares = 0.0;
  double turns = 0.0;
  std::size_t count = 0;
  Random random(1, 0x626f756e64);
  for (const PoseBound& bound : bounds) {
    if (bound.stamp < since) continue;
    const Eigen::Map<const Eigen::Matrix3d> c(bound.covariance.data());
    ++count;
    squares += c(0, 0) + c(1, 1);
    turns += c(2, 2);
    const double sigmaX = std::sqrt(c(0, 0));
    const double slope = c(0, 0) > 0.0 ? c(0, 1) / c(0, 0) : 0.0;
    const double sigmaY = std::sqrt(std::max(0.0, c(1, 1) - slope * c(0, 1)));
    for (int draw = 0; draw < kDraws; ++draw) {
      const double x = sigmaX * random.gaussian();
      errors.push_back(std::hypot(x, slope * x + sigmaY * random.gaussian()));
    }
  }
  if (count == 0) return figures;
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  figures.positionMedian = *middle;
  figures.positionRmse = std::sqrt(squares / static_cast<double>(count));
  figures.headingRmse = std::sqrt(turns / static_cast<double>(count));
  return figures;
}

}  // namespace ortung
