#pragma once

#include "Lead.hpp"
#include "ortung/base/Export.hpp"

namespace ortung {

/// Whether odometry is believed. It is until readings have put the robot where odometry does not
/// lead (Rivals, around the estimate): wheels slip, are held, count backwards, or the robot is
/// pushed. From then on half of the samples go anywhere near, and both halves are compared: nobody
/// who drifts about meets the readings as well as a motion that is known. Odometry that says that
/// the robot stands has told nothing, and regains nothing. Not thread-safe.
class ORTUNG_API OdometryTrust {
 public:
  bool isLost() const { return lost_; }
  void lose();
  /// @param ratio ln p(readings | moved by odometry) - ln p(readings | drifted) [nats]
  /// @param way that odometry has come meanwhile [m]; a turn of 1 rad counts as 1 m
  void compare(double ratio, double way);
  void forget() { lost_ = false; }

 private:
  bool lost_ = false;
  Lead lead_;
};

}  // namespace ortung
