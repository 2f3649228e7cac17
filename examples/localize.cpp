// Localizes a robot by the readings of any source: a simulator, a record, a foreign log, a server.
//
//   localize ROBOT_FILE TABLES KIND:PATH?key=value
//
// e.g. localize robot.toml tables.ortung record:run.rec
#include <cstdio>
#include <exception>

#include "ortung/run/Localization.hpp"

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::fprintf(stderr, "localize ROBOT_FILE TABLES KIND:PATH?key=value\n");
    return 2;
  }
  ortung::Localization localization({.robot = argv[1], .tables = argv[2], .source = argv[3]});
  while (const auto estimate = localization.next()) {
    const ortung::Pose2& pose = estimate->pose;
    std::printf("%.3f s: x %.3f m, y %.3f m, heading %.4f rad\n",
                ortung::toSeconds(estimate->stamp), pose.x, pose.y, pose.theta);
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "localize: %s\n", error.what());
  return 1;
}
