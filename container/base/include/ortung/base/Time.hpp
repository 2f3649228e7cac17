#pragma once

#include <cstdint>

namespace ortung {

/// Point in time [microseconds]; the epoch is the source's own.
using Timestamp = std::int64_t;

inline constexpr double kMicrosecondsPerSecond = 1e6;

/// Returns a time or a difference of times in seconds.
constexpr double toSeconds(Timestamp t) { return static_cast<double>(t) / kMicrosecondsPerSecond; }

/// Returns the time stamp nearest to @p seconds; @pre |seconds| < 9e12.
constexpr Timestamp fromSeconds(double seconds) {
  return static_cast<Timestamp>(seconds * kMicrosecondsPerSecond + (seconds < 0 ? -0.5 : 0.5));
}

}  // namespace ortung
