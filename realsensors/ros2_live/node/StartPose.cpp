#include "StartPose.hpp"

#include <sstream>

#include "ortung/base/Angles.hpp"

namespace ortung::ros2 {

std::optional<Pose2> parseStartPose(const std::string& text) {
  std::istringstream in(text);
  Pose2 pose;
  char comma = 0;
  char other = 0;
  double degrees = 0.0;
  if (!(in >> pose.x >> comma >> pose.y >> other >> degrees) || comma != ',' || other != ',' ||
      !(in >> std::ws).eof())
    return std::nullopt;
  pose.theta = wrapAngle(radians(degrees));
  return pose;
}

}  // namespace ortung::ros2
