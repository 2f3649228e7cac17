#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Learns how a robot's odometry errs, from how far readings put the robot from where odometry has
/// led to: its systematic errors, and how much less or more than its motion model's noise the rest
/// is.
///
/// Both are learned together, since a systematic error that is not known yet looks like noise, and
/// how much a single way says of systematic errors depends on the noise. So there is a Kalman
/// filter of the systematic errors for each of eight factors of the noise's covariance, and a
/// probability of each factor (multiple models; Magill, IEEE Trans. Automatic Control 10, 1965).
/// Models are cautious, since samples have to cover what a robot does in the worst case; an
/// estimate that knows how good odometry is can average the noise of readings. Evidence of long ago
/// counts less, and errors drift, since loads, tyres and floors change. Not thread-safe.
class ORTUNG_API OdometryModels {
 public:
  /// Errors of ways [share], of turns [share], of the turn per metre [rad/m], and of the robot's
  /// frame, how far it is ahead [m] and turned [rad], as in OdometryErrors.
  using Errors = Eigen::Vector<double, 5>;
  using ErrorMatrix = Eigen::Matrix<double, 5, 5>;
  /// What errors (columns) make of a pose (rows).
  using Effect = Eigen::Matrix<double, 3, 5>;

  OdometryModels();
  const Errors& errors() const { return errors_; }
  const ErrorMatrix& covariance() const { return covariance_; }
  /// Returns the expected factor of the noise's covariance, in (0, 4].
  double noise() const { return noise_; }
  bool isLearned() const { return isLearned_; }

  /// How far a pose by readings is from where odometry has led to.
  struct Seen {
    Eigen::Vector3d off;     ///< [m], [m], [rad]
    Effect effect;           ///< derivative of where odometry leads to by the errors
    Errors used;             ///< errors by which odometry was corrected
    Eigen::Matrix3d motion;  ///< covariance by the model's noise
    Eigen::Matrix3d rest;    ///< covariance by everything else, e.g. the readings of both poses
  };
  /// Learns the noise. The shorter the step, the more steps there are.
  void followNoise(const Seen& step);
  /// Learns the errors. The longer the way, the less matters what readings leave open. What neither
  /// errors nor noise explain, a slip for instance, counts little.
  void followErrors(const Seen& way);
  /// Lets the errors drift along a way [m] with turns [rad], but what was learned is known no worse
  /// than before anything was.
  void drift(double way, double turn);

 private:
  /// The errors if one factor of the noise is the true one.
  struct Model {
    Errors errors = Errors::Zero();
    ErrorMatrix covariance;
    double log = 0.0;  ///< ln of its probability, the greatest one 0
  };
  static constexpr std::size_t kCount = 8;  ///< factors 4, 2, ..., 1/32

  struct Likely;
  static Likely likely(const Model& model, double factor, const Seen& seen);
  void mix();

  std::array<Model, kCount> models_;
  Errors errors_ = Errors::Zero();
  ErrorMatrix covariance_;
  double noise_ = 1.0;
  bool isLearned_ = false;
};

}  // namespace ortung
