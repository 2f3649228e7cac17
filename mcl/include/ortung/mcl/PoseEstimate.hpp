#pragma once

#include <cstddef>
#include <cstdint>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/formats/TrackStatus.hpp"

namespace ortung {

/// An estimate of the robot's pose, from the heaviest cluster of the sample set.
struct PoseEstimate {
  Timestamp stamp = 0;  ///< time of the pose [us]
  Pose2 pose;           ///< mean of the cluster, field frame
  /// Covariance of the pose, field frame, row-major, of (x [m], y [m], heading [rad]).
  PoseCovariance covariance{};
  double share = 0.0;       ///< weight of the cluster in the whole belief, in [0, 1]
  std::size_t samples = 0;  ///< size of the sample set
  TrackStatus status = TrackStatus::kLost;       ///< how far it can be relied on
  TrackReason reason = TrackReason::kNoReading;  ///< reason for the status
  /// Probability that the position error is below 0.5 m, in [0, 1].
  double quality = 0.0;
};

}  // namespace ortung
