#pragma once

#include <optional>

#include "CarriedOn.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung {

/// How far an estimate is from where odometry alone would have led to, if that is more than their
/// covariances explain: one of the two is wrong, and nothing says which. A bound of the error has
/// to reach over both (the separation of solutions; Brenner, "Integrated GPS/inertial fault
/// detection availability", Navigation 43, 1996). A wrong estimate agrees with the next one, which
/// begins from it, so a separation counts for some updates. Not thread-safe.
class ORTUNG_API Separation {
 public:
  void forget() { *this = {}; }
  void move(const MotionChange& change);  ///< predicts by odometry
  /// Takes the estimate of the newest readings.
  void follow(const PoseEstimate& now);
  /// Returns how far apart both may be. @param way distance travelled since the newest readings [m]
  PoseDistance after(double way) const;

 private:
  std::optional<PoseEstimate> expected_;
  double way_ = 0.0;  ///< distance travelled since the readings before [m]
  PoseDistance apart_;
  PoseDistance perMetre_;  ///< the same by the distance travelled between readings
};

}  // namespace ortung
