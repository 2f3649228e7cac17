#pragma once

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Thrown if the text of a fault is wrong, or names what the robot does not have.
class ORTUNG_API FaultError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
  ~FaultError() override;
};

/// A fault of some readings for some time, which makes a test from any log.
struct Fault {
  enum class Kind : std::uint8_t {
    kMissing,  ///< no reading comes
    kFrozen,   ///< the first reading is repeated with new stamps
    kDrop,     ///< a share of the readings does not come
    kLate,     ///< stamps are later by a time [s]
    kScale,    ///< odometry's distances are too long by a factor
    kTurns,    ///< odometry's turns are too large by a factor
    kReverse,  ///< odometry's distances have the wrong sign
    kSlip,     ///< odometry is stationary while the robot moves, and then goes on
    kJump,     ///< odometry's counter jumps once: x, y [m], heading [rad] in the robot's frame
    kCrowd,    ///< people around the robot hide half of a scan's beams or more
    kRandom,   ///< a share of a scan's beams, or of the landmarks in sight, is random
    kShort     ///< a share of a scan's beams reads too little
  };
  std::string text;  ///< text as the user gave it, for messages
  std::string what;  ///< "odometry", "readings" or "model/type/feature"
  Kind kind = Kind::kMissing;
  std::vector<double> values;  ///< numbers of the fault, as many as the kind takes
  /// Begin and end of the fault, since the first reading of the run [s]; the end is excluded.
  double from = 0.0;
  double to = std::numeric_limits<double>::infinity();
};

/// Reads "WHAT=FAULT[:VALUE][@FROM[-TO]]", e.g. "odometry=scale:1.2@20-50".
/// @throws FaultError saying what is wrong and what is permitted
ORTUNG_API Fault parseFault(const std::string& text);

/// Returns a line for each kind of fault with its values and effect, for a command's help.
ORTUNG_API std::string faultHelp();

}  // namespace ortung
