#include "ortung/mcl/PoseBound.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

/// Steps over which odometry is compared with truth: over one, rounded words would look like noise.
constexpr std::size_t kStride = 10;
constexpr int kDraws = 8;  ///< of errors, a step

/// Variances of ahead, aside and turn after 1 m of way and after 1 rad of turn.
struct MotionNoise {
  Eigen::Vector3d ofWay = Eigen::Vector3d::Zero();
  Eigen::Vector3d ofTurn = Eigen::Vector3d::Zero();
};

/// Way and turn between two steps and those between them, which curves do not shorten.
Eigen::Vector2d lengthOf(std::span<const BoundStep> steps, std::size_t from, std::size_t to) {
  Eigen::Vector2d length = Eigen::Vector2d::Zero();
  for (std::size_t i = from; i < to; ++i) {
    length[0] += distance(steps[i].truth, steps[i + 1].truth);
    length[1] += std::abs(wrapAngle(steps[i + 1].truth.theta - steps[i].truth.theta));
  }
  return length;
}

/// Least squares of the squared errors, none below 0.
MotionNoise fitMotion(std::span<const BoundStep> steps) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Identity() * 1e-12;
  Eigen::Matrix<double, 2, 3> right = Eigen::Matrix<double, 2, 3>::Zero();
  for (std::size_t i = 0; i + kStride < steps.size(); i += kStride) {
    const BoundStep& a = steps[i];
    const BoundStep& b = steps[i + kStride];
    const Pose2 error = inverse(inverse(a.truth) * b.truth) * (inverse(a.odometry) * b.odometry);
    const Eigen::Vector2d length = lengthOf(steps, i, i + kStride);
    normal += length * length.transpose();
    const Eigen::RowVector3d squares(error.x * error.x, error.y * error.y,
                                     error.theta * error.theta);
    right += length * squares;
  }
  MotionNoise noise;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector2d both = normal.ldlt().solve(right.col(axis));
    if (both.minCoeff() >= 0.0) {
      noise.ofWay[axis] = both[0];
      noise.ofTurn[axis] = both[1];
    } else if (both[0] >= both[1]) {
      noise.ofWay[axis] = right(0, axis) / normal(0, 0);
    } else {
      noise.ofTurn[axis] = right(1, axis) / normal(1, 1);
    }
  }
  return noise;
}

/// What is known after moving from one step to the next.
Eigen::Matrix3d moved(const Eigen::Matrix3d& covariance, const BoundStep& from, const BoundStep& to,
                      const MotionNoise& noise) {
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  f(0, 2) = -(to.truth.y - from.truth.y);
  f(1, 2) = to.truth.x - from.truth.x;
  const double way = distance(from.truth, to.truth);
  const double turn = std::abs(wrapAngle(to.truth.theta - from.truth.theta));
  const Eigen::Vector3d variances = noise.ofWay * way + noise.ofTurn * turn;
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
  turned(0, 0) = turned(1, 1) = std::cos(to.truth.theta);
  turned(1, 0) = std::sin(to.truth.theta);
  turned(0, 1) = -turned(1, 0);
  return f * covariance * f.transpose() + turned * variances.asDiagonal() * turned.transpose();
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
