#include "Polish.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

#include "BeliefTuning.hpp"
#include "CarriedOn.hpp"
#include "PoseMatrix.hpp"
#include "RefineTuning.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

using namespace tuning::polish;
using tuning::common::kOutlier;

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

constexpr double kSettledMetres = 2e-4;
constexpr double kSettledRadians = 2e-5;
/// Steps that change the pose by less than this share of its sigma end the iteration, too: what is
/// left after them is a fraction of that.
constexpr double kSettledShare = 0.05;

Matrix widened(const PoseCovariance& covariance, double metres, double radians) {
  Matrix wider = matrixOf(covariance);
  wider.diagonal() += Vector(metres * metres, metres * metres, radians * radians);
  return wider;
}

/// Returns whether a pose is at the place of a cluster, as far as a cluster of samples can tell.
bool isSame(const Pose2& pose, const PoseEstimate& cluster) {
  const Matrix covariance = widened(cluster.covariance, kClusterMetres, kClusterRadians);
  const Vector off = difference(pose, cluster.pose);
  return off.dot(covariance.ldlt().solve(off)) < kOutlier * kOutlier;
}

/// The normal distribution of the pose before the readings.
struct Prior {
  Pose2 mean;
  Matrix precision;
};

struct Solution {
  Pose2 pose;
  Matrix covariance;
  Slope slope;    ///< sum of the readings' derivatives
  Pose2 slopeAt;  ///< pose at which they were taken, which is hardly another one
};

/// Returns those of the readings that have derivatives.
std::vector<const Polishable*> polishableOf(const std::vector<NewReading>& news) {
  std::vector<const Polishable*> readings;
  for (const NewReading& one : news)
    if (const auto* reading = dynamic_cast<const Polishable*>(one.weigher.get()))
      readings.push_back(reading);
  return readings;
}

Slope slopeOf(const std::vector<const Polishable*>& readings, const Pose2& pose) {
  Slope slope;
  for (const Polishable* reading : readings) slope.add(reading->slopeAt(pose), 1.0);
  return slope;
}

/// Returns the maximum a posteriori of the readings and the prior, by iteration from @p start.
/// @param slope derivative of the readings at @p start
/// @param isOver ends the iteration, the first step of which takes next to no time
/// @param mostSteps number of steps at most
std::optional<Solution> agreement(const std::vector<const Polishable*>& readings,
                                  const Prior& prior, const Pose2& start, const Slope& slope,
                                  const IsOver& isOver, int mostSteps = kMostSteps) {
  Solution found{start, {}, slope, start};
  for (int step = 0; step < mostSteps; ++step) {
    if (step > 0 && isNow(isOver)) break;
    if (step > 0) found.slope = slopeOf(readings, found.pose);
    found.slopeAt = found.pose;
    const Matrix precision = prior.precision + matrixOf(found.slope.information);
    const Eigen::LDLT<Matrix> all(precision);
    const Vector change = all.solve(Vector(found.slope.pull.data()) +
                                    prior.precision * difference(prior.mean, found.pose));
    if (!change.allFinite()) return std::nullopt;
    found.covariance = all.solve(Matrix::Identity());
    found.pose = {found.pose.x + change.x(), found.pose.y + change.y(),
                  wrapAngle(found.pose.theta + change.z())};
    if (change.dot(precision * change) < kSettledShare * kSettledShare ||
        (std::hypot(change.x(), change.y()) < kSettledMetres &&
         std::abs(change.z()) < kSettledRadians))
      break;
  }
  return found;
}

/// In which directions the readings alone determine the pose better than a cluster of samples can.
enum class Determined { kNothing, kPartly, kAll };

/// For vaguer readings the samples are as good, and represent better what the readings leave open:
/// a distance, for instance, puts the robot on a circle.
Determined determinedBy(const Slope& slope) {
  const Vector unit(kClusterMetres, kClusterMetres, kClusterRadians);
  const Matrix times = unit.asDiagonal() * matrixOf(slope.information) * unit.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix> parts(times, Eigen::EigenvaluesOnly);
  if (!(parts.eigenvalues()[2] > 1.0)) return Determined::kNothing;
  return parts.eigenvalues()[0] > 1.0 ? Determined::kAll : Determined::kPartly;
}

/// Returns how the readings pull a pose near the solution: their information times the distance
/// from there to where they alone would have it.
Vector pullOn(const Pose2& pose, const Solution& solution) {
  return matrixOf(solution.slope.information) * difference(solution.slopeAt, pose) +
         Vector(solution.slope.pull.data());
}

/// Returns whether the covariances of a predicted pose and of the readings explain how far apart
/// they are. @param times factor of the readings' squared errors
bool explains(const PoseEstimate& predicted, const Solution& solution, double times) {
  const Vector pull = pullOn(predicted.pose, solution);
  const Matrix seen = matrixOf(solution.slope.information);
  const Matrix expected = seen * matrixOf(predicted.covariance) * seen + times * seen;
  // Directions that the readings leave open are no directions of the pull.
  const Vector apart = expected.completeOrthogonalDecomposition().solve(pull);
  return pull.dot(apart) < kOutlier * kOutlier;
}

/// Returns the pose by the readings alone, which determine one. It is by a fraction of the prior's
/// sigma away from the solution, so the derivatives there lead to it in one step.
std::optional<PoseEstimate> aloneOf(const std::vector<const Polishable*>& readings,
                                    const Solution& near, const IsOver& isOver) {
  constexpr int kOneStep = 1;
  const auto solution =
      agreement(readings, {near.pose, Matrix::Zero()}, near.slopeAt, near.slope, isOver, kOneStep);
  if (!solution) return std::nullopt;
  PoseEstimate alone;
  alone.pose = solution->pose;
  inPlace(alone.covariance) = solution->covariance;
  return alone;
}

Prior priorOf(const PoseEstimate& cluster, double metres, double radians) {
  return {cluster.pose, widened(cluster.covariance, metres, radians).inverse()};
}

/// Interpolates between a cluster (0) and a refined pose (1) at the same place.
Prior between(const PoseEstimate& cluster, const PoseEstimate& place, double towards) {
  const Vector off = towards * difference(place.pose, cluster.pose);
  return {
      {cluster.pose.x + off.x(), cluster.pose.y + off.y(), wrapAngle(cluster.pose.theta + off.z())},
      (towards * matrixOf(place.covariance) + (1.0 - towards) * matrixOf(cluster.covariance))
          .inverse()};
}

/// Returns the normalized innovation squared per direction (NIS): 1 in the mean if the estimate is
/// consistent. Nothing if the readings gave no innovation.
/// @param moved change of the predicted pose by the readings
/// @param promised covariance of the predicted pose
std::optional<double> surprise(const Vector& moved, const Matrix& promised,
                               const Solution& solution) {
  const Matrix seen = matrixOf(solution.slope.information);
  const Matrix expected =
      solution.covariance * (seen * promised * seen + seen) * solution.covariance;
  const Matrix unit = Matrix(promised.llt().matrixL()).inverse();
  const Eigen::SelfAdjointEigenSolver<Matrix> parts(unit * expected * unit.transpose());
  const Vector off = parts.eigenvectors().transpose() * (unit * moved);
  double squares = 0.0;
  double count = 0.0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double share = parts.eigenvalues()[k];
    if (!(share > kLeastRemoved) || std::abs(share - 1.0) < kPredicted) continue;
    squares += off[k] * off[k] / share;
    count += 1.0;
  }
  if (count == 0.0 || !std::isfinite(squares)) return std::nullopt;
  return squares / count;
}

}  // namespace

void Polish::move(const MotionChange& change) {
  if (learnsOdometry_)
    odometry_.move(change, place_);
  else if (place_)
    place_ = carriedOn(*place_, change);
  if (careful_) careful_ = carriedOn(*careful_, change);
  if (cluster_) cluster_ = carriedOn(*cluster_, change);
}

void Polish::follow(const std::vector<NewReading>& news, PoseEstimate& estimate,
                    const IsOver& isOver) {
  const std::optional<PoseEstimate> predicted = std::exchange(cluster_, estimate);
  const std::vector<const Polishable*> readings = polishableOf(news);
  const bool follows = place_ && predicted && isSame(place_->pose, *predicted);
  if (isNow(isOver)) {
    apply(estimate);
    return;
  }
  const Slope slope = slopeOf(readings, estimate.pose);
  const Determined pose = determinedBy(slope);
  // A consistent refined pose is known well enough to be normal in the directions that the readings
  // leave open.
  const bool isNormal = follows && times_ < kConsistentRatio;
  if (pose == Determined::kNothing || (pose == Determined::kPartly && !isNormal)) {
    apply(estimate);
    return;
  }
  Prior prior = follows ? between(*predicted, *place_, std::min(1.0, kRandomRatio / times_))
                        : priorOf(predicted.value_or(estimate), kClusterMetres, kClusterRadians);
  auto solution = agreement(readings, prior, estimate.pose, slope, isOver);
  if (solution && follows && !explains(*place_, *solution, times_)) {
    // Less noise than the model's does not explain the readings, so it is the model's.
    place_ = careful_;
    odometry_.separate();
    prior = between(*predicted, *place_, std::min(1.0, kRandomRatio / times_));
    solution = agreement(readings, prior, estimate.pose, slope, isOver);
  }
  if (learnsOdometry_ && solution && determinedBy(solution->slope) == Determined::kAll) {
    if (const auto alone = aloneOf(readings, *solution, isOver)) odometry_.compare(*alone);
  }
  if (!solution || !isSame(solution->pose, estimate)) {
    place_.reset();
    return;
  }
  if (follows) {
    const auto observed =
        surprise(difference(solution->pose, place_->pose), matrixOf(place_->covariance), *solution);
    if (observed) learnTimes(*observed);
  }
  // Where estimates err by more than they promise, readings say less of the pose.
  if (follows && learnsOdometry_) {
    odometry_.follow(matrixOf(solution->slope.information), matrixOf(place_->covariance), times_);
  } else
    odometry_.separate();
  const Matrix blur =
      Vector(solution->slope.blurMetres, solution->slope.blurMetres, solution->slope.blurRadians)
          .asDiagonal();
  const Matrix kept = solution->covariance * prior.precision;
  auto mixed = inPlace(blur_);
  mixed = follows ? Matrix(kept * mixed + (Matrix::Identity() - kept) * blur) : blur;
  place_ = estimate;
  place_->pose = solution->pose;
  inPlace(place_->covariance) = solution->covariance;
  careful_ = place_;
  if (readings.size() == news.size()) {
    put(estimate);
  } else {
    apply(estimate);
  }
}

void Polish::learnTimes(double observed) {
  const double rate = std::max(kRate, 1.0 / (2.0 + surprises_));
  if (rate > kRate) ++surprises_;
  times_ += rate * (std::min(observed, kMostTimes * times_) - times_);
  times_ = std::max(1.0, times_);
}

/// The samples were also weighed by readings without derivatives. If the samples are more certain
/// for that, they stay the estimate.
void Polish::apply(PoseEstimate& cluster) const {
  if (!place_ || !isSame(place_->pose, cluster)) return;
  const auto spread = [](const PoseEstimate& e) { return positionVariance(e.covariance); };
  if (times_ * spread(*place_) < spread(cluster)) put(cluster);
}

/// Where the refined pose is not consistent, the covariance of the samples is added.
void Polish::put(PoseEstimate& cluster) const {
  const Vector apart = difference(place_->pose, cluster.pose);
  const Matrix samples = matrixOf(cluster.covariance) + apart * apart.transpose();
  const Matrix covariance = times_ * matrixOf(place_->covariance) +
                            (1.0 - std::min(1.0, kRandomRatio / times_)) * samples;
  const Matrix blur = matrixOf(blur_);
  cluster.pose = place_->pose;
  inPlace(cluster.covariance) = covariance + blur * blur.transpose();
}

}  // namespace ortung
