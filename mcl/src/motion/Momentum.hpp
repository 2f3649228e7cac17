#pragma once

#include <optional>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung {

/// How a robot goes on of which nobody tells how it moves: as it did from one reading to the next.
/// With readings one second apart, a robot at walking pace would be a metre from where it was seen
/// last, were it taken to stand. It keeps that motion for as long again, and stands then.
///
/// What two readings tell of a motion counts by how well they know it (the mean of the posterior of
/// two normal distributions): as much as it may have drifted is its variance before, and both
/// covariances that of what was seen. So vague readings make nothing move. Not thread-safe.
class ORTUNG_API Momentum {
 public:
  /// @param config borrowed; of its drift
  explicit Momentum(const MclConfig& config) : config_(config) {}

  /// Takes where readings have put the robot. Not later than the one before: begins anew.
  void follow(const PoseEstimate& seen, Timestamp stamp);
  /// Change of the pose, in the robot's frame at the last reading, up to this time.
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
  Pose2 perSecond_;     ///< ahead, to the left, turn [m/s, rad/s]
  double lasts_ = 0.0;  ///< [s]
};

}  // namespace ortung
