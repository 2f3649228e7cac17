#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/formats/TrackStatus.hpp"

namespace ortung {

/// How far apart two poses are.
struct PoseDistance {
  double metres = 0.0;   ///< of their positions
  double radians = 0.0;  ///< of their headings, in [0, pi]
};

/// The distance of a bound where nothing bounds it.
inline constexpr PoseDistance kUnbounded{std::numeric_limits<double>::infinity(),
                                         std::numeric_limits<double>::infinity()};

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
  /// Protection level: the error exceeds it with a probability of at most 0.001 while tracking and
  /// 0.01 while uncertain, in position and in heading each; infinite while lost, and where nothing
  /// bounds it (docs/mcl.md, "A bound of the error").
  PoseDistance protection = kUnbounded;
  /// The pose without steps, for controllers: corrections by readings are blended in over half a
  /// second. Only a relocalization moves it at once.
  Pose2 smooth;
  /// How often the pose has moved by more than 0.10 m or 3 degrees beyond the robot's motion, or
  /// began anew; it begins anew itself after 2^32.
  std::uint32_t relocalizations = 0;
  Relocalization relocalization = Relocalization::kNone;  ///< why it did so last
};

}  // namespace ortung
