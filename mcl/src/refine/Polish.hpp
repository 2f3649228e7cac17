#pragma once

#include <array>
#include <optional>
#include <vector>

#include "CarriedOn.hpp"
#include "IsOver.hpp"
#include "LearnedOdometry.hpp"
#include "NewReadings.hpp"
#include "RefineTuning.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/Polishable.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung {

/// Refines the estimate of the heaviest cluster beyond the spacing of samples and the resolution of
/// tables: it is the maximum a posteriori of the prior and of all readings whose weighers have a
/// derivative (Polishable), by Gauss-Newton (an iterated extended Kalman filter; Bell, Cathey, IEEE
/// Trans. Automatic Control 38, 1993). The samples are not changed, and a refined pose away
/// from their heaviest cluster is dropped. Not thread-safe.
class ORTUNG_API Polish {
 public:
  /// @param learnsOdometry whether odometry's errors are learned from refined poses
  explicit Polish(bool learnsOdometry = true) : learnsOdometry_(learnsOdometry) {}
  void forget() {
    place_.reset();
    careful_.reset();
    cluster_.reset();
    odometry_.forgetPose();
  }
  void move(const MotionChange& change);  ///< moves the refined pose by odometry
  /// Returns what is known of odometry's errors.
  const LearnedOdometry& odometry() const { return odometry_; }
  /// Refines the estimate by readings.
  /// @param estimate in: the heaviest cluster after the readings were weighed; out: refined, if
  ///   they permit it
  /// @param isOver ends the iterations earlier, asked after each; if it is over at once, the
  ///   readings do not refine
  void follow(const std::vector<NewReading>& news, PoseEstimate& estimate,
              const IsOver& isOver = {});
  /// Replaces the estimate of a cluster by the refined one, if both are at the same place and the
  /// refined one is more certain.
  void apply(PoseEstimate& cluster) const;

 private:
  void put(PoseEstimate& cluster) const;
  void learnTimes(double observed);

  /// Refined estimate; its covariance is that of readings and motion alone.
  std::optional<PoseEstimate> place_;
  /// The same, predicted with all of the motion model's noise: for readings that less noise does
  /// not explain.
  std::optional<PoseEstimate> careful_;
  bool learnsOdometry_;
  LearnedOdometry odometry_;
  std::optional<PoseEstimate> cluster_;  ///< cluster of samples as the last readings left it
  /// Error of the refined pose by systematic errors of the map or the tables, row-major: this times
  /// a random vector of unit variance. As the same vector holds for all readings, the error is
  /// mixed from update to update, but never averaged out.
  std::array<double, 9> blur_{};
  /// Ratio of squared innovations to those of consistent estimates: it grows where readings have
  /// common errors, surfaces are not where the map has them, or odometry errs more than its model.
  double times_ = tuning::polish::kTimesAtFirst;
  int surprises_ = 0;
};

}  // namespace ortung
