#include <cstdio>
#include <string>

#include "FormatTools.hpp"

namespace ortung {

std::string keyNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

std::string mountKey(const Pose2& mount) {
  return "mount=" + keyNumber(mount.x) + "," + keyNumber(mount.y) + "," + keyNumber(mount.theta);
}

}  // namespace ortung
