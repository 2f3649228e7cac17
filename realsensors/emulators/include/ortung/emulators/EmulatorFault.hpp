#pragma once

#include <limits>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {

/// Something that goes wrong with an emulated device, or its line, for a while.
struct EmulatorFault {
  enum class Kind : std::uint8_t {
    kUnplug,   ///< nothing is there
    kSilent,   ///< it says nothing any more
    kFreeze,   ///< it repeats its last reading, with its clock running
    kGarbage,  ///< noise before each telegram, and telegrams with flipped bits
    kHalf,     ///< every other telegram ends in its middle
    kJump,     ///< its clock is set, by `value` [s], and stays so
    kFlood     ///< a thousand readings in place of one
  };
  Kind kind = Kind::kSilent;
  double value = 0.0;
  Timestamp from = 0;  ///< [us] of emulated time
  Timestamp to = std::numeric_limits<Timestamp>::max();
  bool isOn(Timestamp now) const { return now >= from && now < to; }
};

/// "KIND[:VALUE][@FROM-TO]" with times in seconds, e.g. "jump:-3@10-20", "unplug@5-8".
/// @throws std::invalid_argument saying what is wrong
ORTUNG_API EmulatorFault parseEmulatorFault(const std::string& text);
/// Lines for --help.
ORTUNG_API std::string emulatorFaultHelp();

/// What a faulty line makes of a telegram. @param isOdd whether it is every other one
ORTUNG_API std::string damaged(std::string telegram, EmulatorFault::Kind kind, bool isOdd,
                               Random& random);
/// What comes out at one end of a line whose ends have different speeds.
ORTUNG_API std::string atWrongSpeed(const std::string& bytes, Random& random);

}  // namespace ortung
