#include "LearnedOdometry.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "MotionTuning.hpp"
#include "PoseMatrix.hpp"

namespace ortung {
namespace {

using namespace tuning::odometry;

using Effect = OdometryModels::Effect;
using ErrorMatrix = OdometryModels::ErrorMatrix;
using Matrix = LearnedOdometry::Matrix;

/// Returns what the systematic errors make of a change of pose that was corrected by @p errors, in
/// the robot's frame.
Effect effectOn(const Pose2& change, const OdometryErrors& errors) {
  const double way = std::hypot(change.x, change.y);
  const double c = std::cos(change.theta);
  const double s = std::sin(change.theta);
  Effect effect = Effect::Zero();
  effect.row(0) << change.x, -errors.ahead * s * change.theta, -errors.ahead * s * way, c - 1.0,
      change.y;
  effect.row(1) << change.y, errors.ahead * c * change.theta, errors.ahead * c * way, s, -change.x;
  effect.row(2) << 0.0, change.theta, way, 0.0, 0.0;
  return effect;
}

/// Returns the same in the field frame, for a robot with this heading.
Effect effectOn(const Pose2& change, const OdometryErrors& errors, double heading) {
  return Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
         effectOn(change, errors);
}

/// What maps, tables and correlated readings leave open of a pose by readings alone.
Matrix open() {
  return Eigen::Vector3d(kMetres * kMetres, kMetres * kMetres, kRadians * kRadians).asDiagonal();
}

/// Returns whether what readings leave open at the ends of a way hides not even the least noise of
/// odometry on it.
bool isClear(const OdometryModels::Seen& way) {
  const auto position = [](const Matrix& covariance) {
    return covariance(0, 0) + covariance(1, 1);
  };
  return kClear * position(way.rest) <= position(way.motion) &&
         kClear * way.rest(2, 2) <= way.motion(2, 2);
}

}  // namespace

LearnedOdometry::Way::Way(const PoseEstimate& from) : pose(from), motion(from) {
  motion.covariance.fill(0.0);
}

void LearnedOdometry::Way::move(const MotionChange& model, const OdometryErrors& errors) {
  const Pose2 before = pose.pose;
  pose = carriedOn(pose, model, 0.0);
  motion = carriedOn(motion, model);
  effect =
      derivativeOfMoved(before, pose.pose) * effect + effectOn(model.mean, errors, before.theta);
  come += std::hypot(model.mean.x, model.mean.y) + std::abs(model.mean.theta);
}

OdometryModels::Seen LearnedOdometry::Way::to(const PoseEstimate& alone,
                                              const OdometryModels::Errors& used) const {
  return {difference(alone.pose, pose.pose), effect, used, matrixOf(motion.covariance),
          matrixOf(pose.covariance) + matrixOf(alone.covariance)};
}

OdometryErrors LearnedOdometry::errors() const {
  const OdometryModels::Errors& mean = models_.errors();
  return {mean[0], mean[1], mean[2], mean[3], mean[4], models_.noise()};
}

/// The point that odometry follows moves; the robot's frame is fixed to it.
Pose2 LearnedOdometry::corrected(const Pose2& change) const {
  const OdometryErrors its = errors();
  const Pose2 frame{its.ahead, 0.0, its.turned};
  const double turn = change.theta * (1.0 + its.turn) + its.veer * std::hypot(change.x, change.y);
  return inverse(frame) * Pose2{change.x * (1.0 + its.way), change.y * (1.0 + its.way), turn} *
         frame;
}

MotionChange LearnedOdometry::expected(const MotionChange& model) const {
  return models_.isLearned() ? known(model) : model;
}

MotionChange LearnedOdometry::known(const MotionChange& model) const {
  const Effect effect = effectOn(model.mean, errors());
  MotionChange its = model;
  inPlace(its.covariance) = models_.noise() * matrixOf(model.covariance) +
                            effect * models_.covariance() * effect.transpose();
  return its;
}

void LearnedOdometry::move(const MotionChange& model, std::optional<PoseEstimate>& refined) {
  for (std::optional<Way>* way : {&step_, &way_})
    if (*way) (*way)->move(model, errors());
  if (refined) {
    const Pose2 before = refined->pose;
    refined = carriedOn(*refined, known(model));
    const Effect effect = effectOn(model.mean, errors(), before.theta);
    const Matrix forward = derivativeOfMoved(before, refined->pose);
    const Matrix mixed = forward * cross_ * effect.transpose();
    inPlace(refined->covariance) += mixed + mixed.transpose();
    cross_ = forward * cross_ + effect * models_.covariance();
  }
  const double metres = std::hypot(model.mean.x, model.mean.y);
  settled_.drift(metres, model.mean.theta);
  models_.drift(metres, model.mean.theta);
}

void LearnedOdometry::follow(const Matrix& information, const Matrix& predicted, double times) {
  const Matrix precision = (times * predicted).inverse();
  const Matrix posterior = (precision + information / times).inverse();
  const Effect cross = posterior * precision * cross_;
  if (cross.allFinite()) cross_ = cross;
}

void LearnedOdometry::compare(const PoseEstimate& alone) {
  if (step_) {
    const OdometryModels::Seen step = step_->to(alone, models_.errors());
    settled_.followNoise(step);
    models_.followNoise(step);
  }
  if (!way_ || (way_->come >= way_->compared + kWay && learnErrors(alone))) {
    settled_ = models_;
    way_.emplace(alone);
  }
  step_.emplace(alone);
}

/// What the whole way says takes the place of what a part of it has said before.
/// @returns whether it was long enough, so that another one may begin
bool LearnedOdometry::learnErrors(const PoseEstimate& alone) {
  const ErrorMatrix before = models_.covariance();
  const OdometryModels::Errors used = models_.errors();
  OdometryModels::Seen way = way_->to(alone, used);
  way.rest += open();
  models_ = settled_;
  models_.followErrors(way);
  way_->compared = way_->come;
  // Where odometry would have led to by what is known now.
  const Eigen::Vector3d shift = way_->effect * (models_.errors() - used);
  for (PoseEstimate* each : {&way_->pose, &way_->motion})
    each->pose = {each->pose.x + shift.x(), each->pose.y + shift.y(),
                  wrapAngle(each->pose.theta + shift.z())};
  // The refined pose depends on the errors as before, which are less uncertain now.
  const Effect cross = cross_ * before.inverse() * models_.covariance();
  if (cross.allFinite()) cross_ = cross;
  return way_->come >= kLongest || isClear(way);
}

}  // namespace ortung
