// A robot that drives about and turns away from obstacles ahead, with the client library.
//
//   avoid HOST PORT ROBOT_FILE [SECONDS]
//
// The server: ortung sim maps/fields/arena.toml --listen 7777
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "ortung/client/RemoteRobot.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScanData.hpp"

/// Returns the least range in the middle third of the scan [m]. Invalid beams are NaN.
static float nearestAhead(const std::vector<float>& ranges) {
  float nearest = 8.0F;
  for (std::size_t i = ranges.size() / 3; i < ranges.size() - ranges.size() / 3; ++i)
    if (ranges[i] < nearest) nearest = ranges[i];
  return nearest;
}

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "avoid HOST PORT ROBOT_FILE [SECONDS]\n");
    return 2;
  }
  ortung::RemoteOptions options;
  options.session.host = argv[1];
  options.session.name = "avoid-cpp";
  options.onTrouble = [](const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); };
  try {
    options.session.port = static_cast<std::uint16_t>(std::stoi(argv[2]));
    const double seconds = argc > 4 ? std::stod(argv[4]) : 10.0;
    ortung::RemoteRobot robot(argv[3], options);
    for (int cycle = 0; cycle < seconds / options.cycle; ++cycle) {
      if (!robot.waitForUpdate(5.0)) throw std::runtime_error("no update: " + robot.trouble());
      // These are copies of readings, since the container is filled by another thread.
      const auto scan = robot.container().get<ortung::ScanData>({.type = "LRF"});
      const auto odometry = robot.container().get<ortung::OdometryData>({.type = "odometry"});
      if (!scan || !odometry) continue;
      const float ahead = nearestAhead(scan->ranges);
      robot.setTranslationalVelocity(ahead > 0.8F ? 0.5 : 0.0);
      robot.setRotationalVelocity(ahead > 0.8F ? 0.0 : 0.8);
      std::printf("%6.2f m %6.2f m %7.1f degrees, %.2f m ahead\n", odometry->pose.x,
                  odometry->pose.y, odometry->pose.theta * 57.29578, static_cast<double>(ahead));
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
