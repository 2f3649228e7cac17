#include "LearnedOdometry.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "MotionTuning.hpp"
#include "PoseMatrix.hpp"

namespace ortung {
namespace {

using namespace tuning::odometry;

using Vector = LearnedOdometry::Vector;
using Matrix = LearnedOdometry::Matrix;

/// Returns the variances of what is not known of a robot.
Vector prior() { return {kScale * kScale, kScale * kScale, kVeer * kVeer}; }

/// Returns what the systematic errors (columns) make of a change of pose, in the robot's frame.
Matrix effectOn(const Pose2& change) {
  Matrix effect = Matrix::Zero();
  effect(0, 0) = change.x;
  effect(1, 0) = change.y;
  effect(2, 1) = change.theta;
  effect(2, 2) = std::hypot(change.x, change.y);
  return effect;
}

}  // namespace

LearnedOdometry::LearnedOdometry() : covariance_(prior().asDiagonal()) {}

OdometryErrors LearnedOdometry::errors() const {
  return {mean_.x(), mean_.y(), mean_.z(), noise_.value()};
}

Pose2 LearnedOdometry::corrected(const Pose2& change) const {
  const Vector error = effectOn(change) * mean_;
  return {change.x + error.x(), change.y + error.y(), change.theta + error.z()};
}

MotionChange LearnedOdometry::expected(const MotionChange& model) const {
  return isLearned_ ? known(model) : model;
}

MotionChange LearnedOdometry::known(const MotionChange& model) const {
  const Matrix effect = effectOn(model.mean);
  MotionChange its = model;
  inPlace(its.covariance) =
      noise_.value() * matrixOf(model.covariance) + effect * covariance_ * effect.transpose();
  return its;
}

void LearnedOdometry::move(const MotionChange& model, std::optional<PoseEstimate>& refined) {
  if (alone_) alone_ = {carriedOn(alone_->pose, model, 0.0), carriedOn(alone_->motion, model)};
  if (!refined) return;
  const Pose2 before = refined->pose;
  refined = carriedOn(*refined, known(model));
  const Matrix effect =
      Eigen::AngleAxisd(before.theta, Vector::UnitZ()).toRotationMatrix() * effectOn(model.mean);
  const Matrix forward = derivativeOfMoved(before, refined->pose);
  const Matrix mixed = forward * cross_ * effect.transpose();
  inPlace(refined->covariance) += mixed + mixed.transpose();
  cross_ = forward * cross_ + effect * covariance_;
  const double way = std::hypot(model.mean.x, model.mean.y);
  const double scale = kScaleDrift * kScaleDrift;
  const Vector drift(way * scale, std::abs(model.mean.theta) * scale,
                     way * kVeerDrift * kVeerDrift);
  // Without readings that say something, it is known no worse than at first.
  const Vector known = covariance_.diagonal();
  covariance_.diagonal() = (known + drift).cwiseMin(known.cwiseMax(prior()));
}

void LearnedOdometry::follow(const Vector& pull, const Matrix& information, const Matrix& predicted,
                             double times, bool determinesPose) {
  const Matrix prior = times * predicted;
  const Matrix precision = prior.inverse();
  const Matrix posterior = (precision + information / times).inverse();
  const Matrix gain = cross_.transpose() * precision;
  const Vector change = gain * (posterior * pull) / times;
  const Matrix covariance = covariance_ - gain * (prior - posterior) * gain.transpose();
  if (!change.allFinite() || !covariance.allFinite()) return;
  cross_ = posterior * gain.transpose();
  if (!determinesPose) return;
  const Vector most(kMostScale, kMostScale, kMostVeer);
  mean_ = (mean_ + change).cwiseMin(most).cwiseMax(-most);
  covariance_ = 0.5 * (covariance + covariance.transpose());
  isLearned_ = true;
}

void LearnedOdometry::compare(const std::optional<PoseEstimate>& alone) {
  if (alone && alone_) {
    noise_.follow(difference(alone->pose, alone_->pose.pose), matrixOf(alone_->motion.covariance),
                  matrixOf(alone_->pose.covariance) + matrixOf(alone->covariance));
  }
  alone_.reset();
  if (!alone) return;
  alone_ = {*alone, *alone};
  alone_->motion.covariance.fill(0.0);
}

}  // namespace ortung
