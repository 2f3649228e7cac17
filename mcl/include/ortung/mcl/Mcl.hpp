#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/motion/MotionModel.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// Monte Carlo localization (paper, section 5.2) on the container's interface alone: it knows
/// neither sensors nor where their readings come from. Not thread-safe. The container may be filled
/// by other threads meanwhile: update() holds its read lock only while it takes what is new, not
/// while it computes.
class ORTUNG_API Mcl {
 public:
  /// @param region where the robot can stand
  /// @throws std::invalid_argument if that is nowhere, or for a configuration that makes no sense
  Mcl(const MclConfig& config, FieldRegion region, std::unique_ptr<MotionModel> motion);
  ~Mcl();
  Mcl(const Mcl&) = delete;
  Mcl& operator=(const Mcl&) = delete;

  /// Unknown start: candidates all over the region, weighed by the first reading.
  void startGlobal();
  /// Known start with standard deviations [m], [rad].
  void startAt(const Pose2& pose, double sigmaPosition, double sigmaHeading);

  /// Looks at the container: moves the samples by what odometry says up to the newest reading
  /// (eq. 8), and weighs them by every feature that is newer than the last update (eq. 7).
  /// Returns whether the belief was weighed, i.e. whether there is a new estimate.
  bool update(const SensorContainer& container);

  const PoseEstimate& estimate() const;
  const SampleSet& samples() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ortung
