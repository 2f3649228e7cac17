#pragma once

#include "Lead.hpp"
#include "ortung/base/Export.hpp"

namespace ortung {

/// Whether odometry is trusted. It is, until readings have put the robot where odometry does not
/// lead (Rivals, around the estimate), because wheels slip, are blocked or count backwards, or the
/// robot is pushed. From then on half of the samples follow odometry and half spread by process
/// noise, and the likelihoods of both halves are compared: correct odometry predicts the readings
/// better than process noise does, and is trusted again. Odometry that says that the robot is
/// stationary is no evidence, and regains no trust. Not thread-safe.
class ORTUNG_API OdometryTrust {
 public:
  bool isLost() const { return lost_; }
  void lose();
  /// @param ratio ln p(readings | moved by odometry) - ln p(readings | moved by process noise)
  ///   [nats]
  /// @param travelled distance travelled by odometry meanwhile [m]; a turn of 1 rad counts as 1 m
  void compare(double ratio, double travelled);
  void forget() { lost_ = false; }

 private:
  bool lost_ = false;
  Lead lead_;
};

}  // namespace ortung
