#pragma once

namespace ortung {

/// How a robot's odometry errs, as learned while the robot drives (MclConfig::learnsOdometry).
struct OdometryErrors {
  double way = 0.0;    ///< of distances travelled: the robot moves (1 + way) of what odometry says
  double turn = 0.0;   ///< of angles turned, likewise
  double veer = 0.0;   ///< turn to the left per metre that odometry does not count [rad/m]
  double ahead = 0.0;  ///< place of the robot's frame, ahead of the point that odometry follows [m]
  double turned = 0.0;  ///< turn of the robot's frame to the left of where odometry faces [rad]
  double noise = 1.0;   ///< variance of the rest, as a factor of the motion model's, in (0, 4]
};

}  // namespace ortung
