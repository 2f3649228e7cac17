#pragma once

#include <Eigen/Core>
#include <optional>

#include "CarriedOn.hpp"
#include "OdometryModels.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/mcl/OdometryErrors.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung {

/// Learns while the robot drives how odometry errs (OdometryModels), from two poses a way apart
/// that readings determine by themselves each; takes the systematic errors off odometry, and says
/// how uncertain refined poses become on the way by what is not known of it. The errors belong to
/// the robot, so they stay when the belief is another one.
///
/// They are no states of the refined pose that readings correct: a robot whose odometry errs far
/// more than is assumed makes refined poses inconsistent, so readings would count less, and teach
/// nothing of the very errors that are the reason. A refined pose is correlated with them, since
/// they act in the same way all along a way (Schmidt-Kalman filter; Schmidt 1966). Not thread-safe.
class ORTUNG_API LearnedOdometry {
 public:
  using Matrix = Eigen::Matrix3d;

  OdometryErrors errors() const;
  /// Returns a change of pose by odometry without its systematic errors, in the robot's frame.
  Pose2 corrected(const Pose2& change) const;
  /// Returns what the motion model predicts from a corrected change, with the uncertainty of what
  /// was learned instead of the model's; as it is if nothing was learned.
  MotionChange expected(const MotionChange& model) const;
  /// Predicts the refined pose, if there is one, by what the motion model predicts from a corrected
  /// change.
  void move(const MotionChange& model, std::optional<PoseEstimate>& refined);
  /// Takes what readings make of the pose that move() has predicted.
  /// @param information information of the readings, in the field frame
  /// @param predicted covariance of the predicted pose
  /// @param times factor of the squared errors of both
  void follow(const Matrix& information, const Matrix& predicted, double times);
  /// Learns from poses that readings determine by themselves.
  /// @param alone pose by the newest readings alone
  void compare(const PoseEstimate& alone);
  /// Keeps what was learned, but the refined pose is another one now.
  void separate() { cross_.setZero(); }
  /// Keeps what was learned, but the robot may be anywhere.
  void forgetPose() {
    separate();
    step_.reset();
    way_.reset();
  }

 private:
  /// The way since a pose by readings alone.
  struct Way {
    explicit Way(const PoseEstimate& from);
    void move(const MotionChange& model, const OdometryErrors& errors);
    /// @param used what odometry was corrected by
    OdometryModels::Seen to(const PoseEstimate& alone, const OdometryModels::Errors& used) const;

    PoseEstimate pose;    ///< moved without noise, by what is known of odometry now
    PoseEstimate motion;  ///< with the covariance of the model's noise since then
    OdometryModels::Effect effect = OdometryModels::Effect::Zero();  ///< on the moved pose
    double come = 0.0;      ///< distance and turns [m]; a turn of 1 rad counts as 1 m
    double compared = 0.0;  ///< the same when its end was compared last
  };

  MotionChange known(const MotionChange& model) const;
  bool learnErrors(const PoseEstimate& alone);

  OdometryModels settled_;  ///< what was known before the way
  OdometryModels models_;   ///< what is known by the way so far, too
  OdometryModels::Effect cross_ =
      OdometryModels::Effect::Zero();  ///< covariance of the refined pose (rows) and the errors
  std::optional<Way> step_;            ///< since the last pose by readings alone
  std::optional<Way> way_;             ///< since one that is longer ago
};

}  // namespace ortung
