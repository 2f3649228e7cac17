#pragma once

#include <limits>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {

/// A fault of an emulated device or its line, for a while.
struct EmulatorFault {
  enum class Kind : std::uint8_t {
    kUnplug,   ///< the device is not there
    kSilent,   ///< the device sends nothing
    kFreeze,   ///< the device repeats its last reading, while its clock runs
    kGarbage,  ///< noise precedes each telegram, and bits of telegrams flip
    kHalf,     ///< every other telegram ends in its middle
    kJump,     ///< the device's clock is set forward by `value` [s] for good
    kFlood     ///< the device sends each reading a thousand times
  };
  Kind kind = Kind::kSilent;  ///< what goes wrong
  double value = 0.0;         ///< value of kJump [s]
  Timestamp from = 0;         ///< begin of the fault [us of emulated time]
  Timestamp to = std::numeric_limits<Timestamp>::max();  ///< its end [us of emulated time]
  /// Whether the fault is present.
  bool isOn(Timestamp now) const { return now >= from && now < to; }
};

/// Parses "KIND[:VALUE][@FROM-TO]" with times in seconds, e.g. "jump:-3@10-20", "unplug@5-8".
/// @throws std::invalid_argument saying what is wrong
ORTUNG_API EmulatorFault parseEmulatorFault(const std::string& text);
/// Describes all kinds of faults, as lines for --help.
ORTUNG_API std::string emulatorFaultHelp();

/// Returns what a faulty line makes of a telegram.
/// @param kind kGarbage or kHalf; others change nothing
/// @param isOdd whether its number is odd; kHalf truncates those
ORTUNG_API std::string damaged(std::string telegram, EmulatorFault::Kind kind, bool isOdd,
                               Random& random);
/// Returns what one end of a line receives if its ends have different speeds.
ORTUNG_API std::string atWrongSpeed(const std::string& bytes, Random& random);

}  // namespace ortung
