#pragma once

#include <cstdint>
#include <string_view>

#include "ortung/base/Export.hpp"
#include "ortung/sim/SimRobot.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung {

/// How a striker's one chance ended.
enum class GoalOutcome : std::uint8_t {
  goal,
  saved,  ///< the keeper touched the ball, which then lay still, came back or left the field
  out,    ///< the ball left the field, lay still or came back, and the keeper had no part in it
  time    ///< nothing of that within 10 s
};
/// "goal", "saved", "out", "time".
ORTUNG_API std::string_view nameOf(GoalOutcome outcome);

/// The half of the F2000 field that a keeper defends.
struct GoalField {
  static constexpr double kGoalX = -6.0;      ///< of the goal line [m]
  static constexpr double kHalfMouth = 1.0;   ///< [m]
  static constexpr double kHalfLength = 6.0;  ///< [m]
  static constexpr double kHalfWidth = 4.0;   ///< [m]
  static constexpr double kBall = 0.11;       ///< radius [m]
};

/// Follows one ball until its chance is over.
class ORTUNG_API GoalJudge {
 public:
  static constexpr double kShot = 1.0;  ///< faster towards the goal the ball was shot [m/s]

  /// To be called once a cycle, when everything has moved. @returns whether it is over
  bool sees(const Simulation::Thing& ball, const SimRobot& keeper, double cycle);
  /// @pre it is over
  GoalOutcome outcome() const { return outcome_; }
  bool wasShot() const { return wasShot_; }

 private:
  GoalOutcome missed() const { return wasTouched_ ? GoalOutcome::saved : GoalOutcome::out; }

  GoalOutcome outcome_ = GoalOutcome::time;
  bool wasShot_ = false;
  bool wasTouched_ = false;
  Twist velocity_;  ///< of the ball in the cycle before
};

}  // namespace ortung
