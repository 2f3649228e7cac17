#pragma once

#include <cstdint>

#include "ortung/base/Export.hpp"

namespace ortung {

/// How far an estimate can be relied on.
enum class TrackStatus : std::uint8_t {
  kTracking,   ///< the position error is almost certainly below 0.5 m
  kUncertain,  ///< the error may be below 0.5 m, but there is evidence against it
  kLost,       ///< the error is more likely above 0.5 m than below
  kLast = kLost,
};

/// The reason for a status. The numbers are words of the protocol: new ones come last.
enum class TrackReason : std::uint8_t {
  kFits,           ///< readings fit one place
  kSeveralPlaces,  ///< the belief has several places
  kSpread,         ///< the belief has one place, but a wide one
  kNoReading,      ///< no reading came for three times as long as usual
  kFrozen,         ///< a device repeats its reading though the robot moves
  kPoorFit,        ///< readings fit worse than usual
  kRival,          ///< several readings have fitted better elsewhere
  kOdometry,       ///< readings contradict odometry
  kSearching,      ///< a global start has found no place yet
  kLate,           ///< stamps of readings are late against odometry's
  kUnconfirmed,    ///< a global start has found a place that few readings have confirmed
  kMayBeLate,      ///< no turn or change of speed has shown yet that readings are in time
  kLast = kMayBeLate,
};

/// Why an estimate moved by more than the robot did. The numbers are words of the protocol: new
/// ones come last.
enum class Relocalization : std::uint8_t {
  kNone,        ///< it has not moved so
  kFound,       ///< a global start found the robot
  kGiven,       ///< a pose or a belief was given
  kOtherPlace,  ///< readings fit another place better
  kDelay,       ///< readings turned out to be late by another time
  kReadings,    ///< readings corrected it by more than 0.10 m or 3 degrees
  kLast = kReadings,
};

/// Returns "tracking", "uncertain" or "lost".
ORTUNG_API const char* nameOf(TrackStatus status);
/// Returns a few words, such as "readings fit worse than usual".
ORTUNG_API const char* nameOf(TrackReason reason);
/// Returns a few words, such as "readings fit another place better".
ORTUNG_API const char* nameOf(Relocalization cause);

}  // namespace ortung
