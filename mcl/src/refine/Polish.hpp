#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "News.hpp"
#include "RefineTuning.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/Polishable.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {

/// The heaviest place, finer than samples are apart and tables round: the pose where the readings
/// and what was known before them agree best, by Gauss and Newton (an iterated extended Kalman
/// filter; Bell, Cathey, IEEE Trans. Automatic Control 38, 1993), of the readings whose weighers
/// tell a slope. It rides on the samples, which stay as they are: a place that is not theirs is
/// forgotten. Not thread-safe.
class ORTUNG_API Polish {
 public:
  void forget() {
    place_.reset();
    cluster_.reset();
  }
  /// By odometry. @param change in the robot's old frame
  void move(const MotionModel& motion, const Pose2& change, std::uint64_t seed,
            std::uint64_t stream);
  /// Takes readings in. @param estimate heaviest cluster after they were weighed: polished, if they
  /// can do it
  void follow(const std::vector<News>& news, PoseEstimate& estimate);
  /// Puts the place in for a cluster of samples that is at the same place.
  void apply(PoseEstimate& cluster) const;

 private:
  void put(PoseEstimate& cluster) const;
  void learnTimes(double observed);

  /// Refined place; its covariance is that of readings and motion.
  std::optional<PoseEstimate> place_;
  std::optional<PoseEstimate> cluster_;  ///< cluster of samples as the last readings left it
  /// Of the place, row-major: what its readings were compared with is off by this, times something
  /// of variance 1 that is the same for all of them, so that it is mixed, but never averaged out.
  std::array<double, 9> blur_{};
  /// Ratio of squared innovations to those of consistent estimates: it grows where readings have
  /// common errors, surfaces are not where the map has them, or odometry errs more than its model.
  double times_ = tuning::polish::kTimesAtFirst;
  int surprises_ = 0;
};

}  // namespace ortung
