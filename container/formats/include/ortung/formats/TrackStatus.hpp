#pragma once

#include <cstdint>

#include "ortung/base/Export.hpp"

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
  kPoorFit,      ///< readings fit worse than usual
  kRival,        ///< several readings have fitted better elsewhere
  kOdometry,     ///< readings contradict it
  kSearching,    ///< a global start has found no place yet
  kLate,         ///< the stamps of readings are, against odometry's
  kUnconfirmed,  ///< a global start has found one that few readings have confirmed
  kLast = kUnconfirmed,
};

/// "tracking", "uncertain", "lost".
ORTUNG_API const char* nameOf(TrackStatus status);
/// A few words, such as "readings fit worse than usual".
ORTUNG_API const char* nameOf(TrackReason reason);

}  // namespace ortung
