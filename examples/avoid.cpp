// A robot that drives about and turns away from what is in front of it, for the client library.
//
//   avoid HOST PORT ROBOT_FILE [SECONDS]
//
// The server: ortung sim maps/fields/arena.toml --listen 7777
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "ortung/client/RemoteRobot.hpp"
#include "ortung/container/Formats.hpp"

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "avoid HOST PORT ROBOT_FILE [SECONDS]\n");
    return 2;
  }
  const double seconds = argc > 4 ? std::atof(argv[4]) : 10.0;
  ortung::RemoteOptions options;
  options.session.host = argv[1];
  options.session.port = static_cast<std::uint16_t>(std::atoi(argv[2]));
  options.session.name = "avoid-cpp";
  options.onTrouble = [](const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); };
  try {
    ortung::RemoteRobot robot(argv[3], options);
    for (int cycle = 0; cycle < seconds / options.cycle; ++cycle) {
      robot.waitForUpdate(1.0);
      // Readings copied out of the container, which goes on filling itself.
      const auto scan = robot.container().get<ortung::ScanData>({.type = "LRF"});
      const auto odometry = robot.container().get<ortung::OdometryData>({.type = "odometry"});
      if (!scan || !odometry) continue;
      const auto middle =
          scan->ranges.begin() + static_cast<std::ptrdiff_t>(scan->ranges.size() / 2);
      const float ahead = *std::min_element(middle - 30, middle + 30);  // [m], within 30 degrees
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
