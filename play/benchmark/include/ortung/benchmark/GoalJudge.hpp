#pragma once

#include <cstdint>
#include <string_view>

#include "ortung/base/Export.hpp"
#include "ortung/sim/SimRobot.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung {

/// The outcome of a striker's attempt at the goal.
enum class GoalOutcome : std::uint8_t {
  kGoal,   ///< the ball is in the goal
  kSaved,  ///< the keeper touched the ball, which then lay still, came back or left the field
  kOut,    ///< the ball left the field, lay still or came back without a touch of the keeper
  kTime    ///< none of these within 10 s
};
/// Returns "goal", "saved", "out" or "time".
ORTUNG_API std::string_view nameOf(GoalOutcome outcome);

/// The half of the F2000 field that a keeper defends.
struct GoalField {
  static constexpr double kGoalX = -6.0;      ///< x of the goal line [m]
  static constexpr double kHalfMouth = 1.0;   ///< half the width between the posts [m]
  static constexpr double kHalfLength = 6.0;  ///< half the length of the field [m]
  static constexpr double kHalfWidth = 4.0;   ///< half the width of the field [m]
  static constexpr double kBall = 0.11;       ///< radius of the ball [m]
};

/// Watches a ball until the attempt is over.
class ORTUNG_API GoalJudge {
 public:
  /// Least speed towards the goal of a ball that counts as shot [m/s].
  static constexpr double kShot = 1.0;

  /// Observes a cycle; to be called once per cycle, after everything has moved. @returns whether
  /// the attempt is over
  bool sees(const Simulation::Thing& ball, const SimRobot& keeper, double cycle);
  /// Returns the outcome. @pre the attempt is over
  GoalOutcome outcome() const { return outcome_; }
  /// Returns whether the ball has been shot at the goal.
  bool wasShot() const { return wasShot_; }

 private:
  GoalOutcome missed() const { return wasTouched_ ? GoalOutcome::kSaved : GoalOutcome::kOut; }

  GoalOutcome outcome_ = GoalOutcome::kTime;
  bool wasShot_ = false;
  bool wasTouched_ = false;
  Twist velocity_;  ///< velocity of the ball in the previous cycle
};

}  // namespace ortung
