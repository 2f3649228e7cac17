#pragma once

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// The text of a fault is wrong, or names what the robot does not have.
class ORTUNG_API FaultError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
  ~FaultError() override;
};

/// What goes wrong with which readings, and when: a test that can be had from any log.
struct Fault {
  enum class Kind : std::uint8_t {
    kMissing,  ///< nothing comes
    kFrozen,   ///< the first reading is repeated with new stamps
    kDrop,     ///< a share of the readings does not come
    kLate,     ///< stamps are later [s]
    kScale,    ///< odometry's way is too long by a factor
    kTurns,    ///< odometry's turns are too large by a factor
    kReverse,  ///< odometry's way has the wrong sign
    kSlip,     ///< odometry stands while the robot moves, and goes on from there
    kJump,     ///< odometry's counter jumps once: x, y [m], heading [rad] in the robot's frame
    kCrowd,    ///< people around the robot hide half of a scan's beams or more
    kRandom,   ///< a share of a scan's beams, or of the landmarks in sight, is anything
    kShort     ///< a share of a scan's beams reads too little
  };
  std::string text;  ///< as it was given, for messages
  std::string what;  ///< "odometry", "readings" or "model/type/feature"
  Kind kind = Kind::kMissing;
  std::vector<double> values;  ///< as many as the kind takes
  /// Time since the first reading of the run [s]: from this one on, and before that one.
  double from = 0.0;
  double to = std::numeric_limits<double>::infinity();
};

/// Reads "WHAT=FAULT[:VALUE][@FROM[-TO]]", e.g. "odometry=scale:1.2@20-50".
/// @throws FaultError saying what is wrong and what is permitted
ORTUNG_API Fault parseFault(const std::string& text);

/// All faults with what they take and do, a line each, for a command's help.
ORTUNG_API std::string faultHelp();

}  // namespace ortung
