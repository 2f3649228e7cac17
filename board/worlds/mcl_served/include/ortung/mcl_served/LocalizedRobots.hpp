#pragma once

#include <cstdint>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/mcl_served/PerceivingRobots.hpp"
#include "ortung/server/ServedWorld.hpp"

namespace ortung {

/// How far the localization of a robot is.
struct LocalizationState {
  enum class Kind : std::uint8_t { kOff, kLearning, kSearching, kRunning, kFailed };
  Kind kind = Kind::kOff;
  double progress = 0.0;  ///< share of the tables that is learned, in [0, 1]
  std::string text = {};  ///< status of kRunning ("tracking: readings fit"), reason of kFailed
};

/// "off", "learning", "searching", "running", "failed".
ORTUNG_API const char* nameOf(LocalizationState::Kind kind);

/// A client's order to a localization.
struct LocalizationOrder {
  enum class Kind : std::uint8_t {
    kOn,        ///< goes on if it is on already
    kOff,       ///< ends learning, too
    kAnywhere,  ///< switches it on; the robot may be anywhere
    kPlace      ///< switches it on; the robot is near `pose`
  };
  Kind kind = Kind::kOn;
  Pose2 pose = {};               ///< field frame
  double sigmaPosition = 0.3;    ///< standard deviation [m], positive
  double sigmaHeading = 0.1745;  ///< standard deviation [rad], positive
};

/// Who localizes robots, for the commands of clients: filters beside a simulation, or the program
/// on a robot. Refusals are ServeErrors. Not thread-safe, but for PerceivingRobots: one thread owns
/// it.
class ORTUNG_API LocalizedRobots : public PerceivingRobots {
 public:
  ~LocalizedRobots() override;

  /// How far the localization of a robot is. @throws ServeError if the robot can't be localized
  virtual LocalizationState state(RobotId robot) = 0;
  /// Passes a client's order to the localization of a robot.
  /// @throws ServeError if the robot can't be localized, or can't stand at the pose
  virtual void order(RobotId robot, const LocalizationOrder& order) = 0;
};

}  // namespace ortung
