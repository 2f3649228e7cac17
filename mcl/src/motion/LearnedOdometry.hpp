#pragma once

#include <Eigen/Core>
#include <optional>

#include "CarriedOn.hpp"
#include "NoiseRatio.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/mcl/OdometryErrors.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung {

/// Learns from refined poses how odometry errs: its systematic errors, which are taken off, and how
/// much less than its model's noise the rest is.
///
/// Systematic errors are states of a Kalman filter beside the pose, as biases of devices are in
/// Biases (Friedland 1969): each change of pose is uncertain by them, and what is learned of the
/// pose is learned of them, too. They drift slowly, since loads, tyres and floors change. They
/// belong to the robot, so they stay when the belief is another one. Not thread-safe.
class ORTUNG_API LearnedOdometry {
 public:
  using Vector = Eigen::Vector3d;
  using Matrix = Eigen::Matrix3d;

  LearnedOdometry();
  OdometryErrors errors() const;
  /// Returns a change of pose by odometry without its systematic errors, in the robot's frame.
  Pose2 corrected(const Pose2& change) const;
  /// Returns what the motion model predicts from a corrected change, with the uncertainty of what
  /// was learned instead of the model's; as it is if nothing was learned.
  MotionChange expected(const MotionChange& model) const;
  /// Predicts the refined pose, if there is one, by what the motion model predicts from a corrected
  /// change.
  void move(const MotionChange& model, std::optional<PoseEstimate>& refined);
  /// Takes how readings pull the pose that move() has predicted. Systematic errors are learned if
  /// the readings determine a pose: errors of a radio's distances, for instance, would be taken for
  /// odometry's.
  /// @param pull the readings' information times the distance to where they alone would have it
  /// @param information information of the readings, in the field frame
  /// @param predicted covariance of the predicted pose
  /// @param times factor of the squared errors of both
  void follow(const Vector& pull, const Matrix& information, const Matrix& predicted, double times,
              bool determinesPose);
  /// Learns the noise, from poses that readings determine by themselves twice in a row.
  /// @param alone pose by the newest readings alone, if they determine one
  void compare(const std::optional<PoseEstimate>& alone);
  /// Keeps what was learned, but the refined pose is another one now.
  void separate() { cross_.setZero(); }
  /// Keeps what was learned, but the robot may be anywhere.
  void forgetPose() {
    separate();
    alone_.reset();
  }

 private:
  /// The pose by the last readings alone.
  struct Alone {
    PoseEstimate pose;    ///< moved without noise
    PoseEstimate motion;  ///< with the covariance of the model's noise since then
  };

  MotionChange known(const MotionChange& model) const;

  Vector mean_ = Vector::Zero();  ///< of ways, of turns, of the turn per metre
  Matrix covariance_;
  Matrix cross_ = Matrix::Zero();  ///< covariance of the refined pose (rows) and the errors
  bool isLearned_ = false;
  NoiseRatio noise_;
  std::optional<Alone> alone_;
};

}  // namespace ortung
