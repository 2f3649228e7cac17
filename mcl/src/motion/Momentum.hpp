#pragma once

#include <optional>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung {

/// Predicts the motion of a robot without odometry: a constant-velocity model from one reading to
/// the next. With readings one second apart, a robot at walking pace would be a metre from where it
/// was seen last if it were assumed to be stationary. It is assumed to keep its velocity for as
/// long as the last two readings were apart, and then to be stationary.
///
/// The velocity is the posterior mean of a normal prior and a normal measurement: the prior has
/// mean zero and the variance of the process noise, and the difference of the two estimates has the
/// sum of their variances. So vague readings do not make the robot seem to move. Not thread-safe.
class ORTUNG_API Momentum {
 public:
  /// @param config borrowed; its process noise is used
  explicit Momentum(const MclConfig& config) : config_(config) {}

  /// Takes the estimate after readings were weighed. It begins anew if @p stamp is not later than
  /// the one before.
  void follow(const PoseEstimate& seen, Timestamp stamp);
  /// Returns the expected change of pose since the last reading, in the robot's frame then.
  Pose2 changeAt(Timestamp stamp) const;

 private:
  struct Seen {
    Pose2 pose;
    Timestamp stamp;
    double open;      ///< variance of the position along an axis [m^2]
    double openTurn;  ///< variance of the heading [rad^2]
  };
  const MclConfig& config_;
  std::optional<Seen> last_;
  Pose2 perSecond_;     ///< velocities ahead and to the left [m/s], turn rate [rad/s]
  double lasts_ = 0.0;  ///< time for which the velocities are kept [s]
};

}  // namespace ortung
