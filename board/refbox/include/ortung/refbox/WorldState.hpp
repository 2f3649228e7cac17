#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/sim_api/Twist.hpp"

namespace ortung::refbox {

/// A team's report to the box. Field frame, [m], [rad], [m/s]. Entries with numbers that
/// are not finite are left out of the message.
struct WorldState {
  /// One robot of the team, with the pose that it is heading for.
  struct Robot {
    int id = 0;                  ///< number of the robot in its team
    Pose2 pose = {};             ///< estimated pose
    Pose2 targetPose = {};       ///< pose that it is driving to
    Twist velocity = {};         ///< velocity in the field frame
    std::string intention = {};  ///< what it is doing, for people
    double batteryLevel = 1.0;   ///< charge, in [0, 1]
    bool ballEngaged = false;    ///< whether it has the ball
  };
  /// A position [m] or a velocity [m/s] in three dimensions.
  struct Point {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
  };
  /// A ball as the team perceives it; `confidence` is in [0, 1].
  struct Ball {
    Point position = {};
    Point velocity = {};
    double confidence = 1.0;
  };
  /// A circular obstacle [m] with its velocity [m/s]; `confidence` is in [0, 1].
  struct Obstacle {
    double x = 0.0;
    double y = 0.0;
    double vx = 0.0;
    double vy = 0.0;
    double radius = 0.25;
    double confidence = 1.0;
  };

  std::string teamName;   ///< the team's name
  std::string intention;  ///< what the team is doing, for people
  std::vector<Robot> robots;
  std::vector<Ball> balls;
  std::vector<Obstacle> obstacles;
  double age = 0.0;  ///< time since the state was true [s], at least 0
};

/// The message `worldstate` without its NUL byte, on one line. Bytes that are no UTF-8 are
/// replaced.
ORTUNG_API std::string toJson(const WorldState& state);

}  // namespace ortung::refbox
