#pragma once

#include <cstddef>
#include <cstdint>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {

/// How far an estimate can be relied on.
enum class TrackStatus : std::uint8_t {
  kTracking,   ///< the position error is below 0.5 m almost surely
  kUncertain,  ///< it may well be, but something speaks against it
  kLost,       ///< it is not, more likely than not
  kLast = kLost,
};

/// Why it can, or can't. Their numbers are words of the protocol: new ones come last.
enum class TrackReason : std::uint8_t {
  kFits,
  kSeveralPlaces,
  kSpread,       ///< one place, but a wide one
  kNoReading,    ///< for three times as long as is usual
  kFrozen,       ///< a device repeats its reading though the robot moves
  kPoorFit,      ///< readings fit worse than they use to
  kRival,        ///< several readings have fitted better elsewhere
  kOdometry,     ///< readings contradict it
  kSearching,    ///< a global start has found no place yet
  kLate,         ///< the stamps of readings are, against odometry's
  kUnconfirmed,  ///< a global start has found one that few readings have confirmed
  kLast = kUnconfirmed,
};

/// "tracking", "uncertain", "lost".
ORTUNG_API const char* nameOf(TrackStatus status);
/// A few words, such as "readings fit worse than they use to".
ORTUNG_API const char* nameOf(TrackReason reason);

/// Where the robot is, as the heaviest cluster of the sample set says.
struct PoseEstimate {
  Timestamp stamp = 0;
  Pose2 pose;  ///< mean of the cluster, field frame
  PoseCovariance covariance{};
  double share = 0.0;       ///< weight of the cluster in the whole belief, in [0, 1]
  std::size_t samples = 0;  ///< size of the sample set
  TrackStatus status = TrackStatus::kLost;
  TrackReason reason = TrackReason::kNoReading;
  /// Probability that the position error is below 0.5 m, in [0, 1].
  double quality = 0.0;
};

}  // namespace ortung
