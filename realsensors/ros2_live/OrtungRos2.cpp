/// ortung-ros2: localizes a robot of ROS 2 without an installation of ROS, in amcl's place. It
/// reads scan, odom, tf, tf_static and initialpose, and tells map -> odom at tf, amcl_pose,
/// particle_cloud and diagnostics.

#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <iostream>
#include <sstream>
#include <string>

#include "LiveLocalization.hpp"
#include "ortung/base/Angles.hpp"

namespace {

using ortung::LocalizationStart;
using ortung::ros2::Distro;
using ortung::ros2::LiveLocalization;

LiveLocalization* running = nullptr;

void onSignal(int) {
  if (running != nullptr) running->stop();
}

LocalizationStart startOf(const std::string& text) {
  if (text == "global") return {};
  LocalizationStart start{LocalizationStart::Kind::kPose};
  std::istringstream in(text);
  char comma = 0;
  char other = 0;
  double degrees = 0.0;
  if (!(in >> start.pose.x >> comma >> start.pose.y >> other >> degrees) || comma != ',' ||
      other != ',' || !in.eof())
    throw CLI::ValidationError("--start", "is '" + text + "', expected global or x,y,degrees");
  start.pose.theta = ortung::wrapAngle(ortung::radians(degrees));
  return start;
}

void addOptions(CLI::App& app, LiveLocalization::Options& options) {
  app.add_option("--robot", options.localization.robot, "Robot file (TOML)")->required();
  app.add_option("--tables", options.localization.tables, "Table file of `ortung learn`")
      ->required();
  app.add_option("--scan", options.scans,
                 "Topic of a scanner, TOPIC or TOPIC=MODEL/TYPE/FEATURE; may be given again")
      ->capture_default_str();
  app.add_option("--odometry", options.odometry, "Topic of nav_msgs/Odometry, or tf: odom -> base")
      ->capture_default_str();
  app.add_option("--base-frame", options.base, "Frame of the robot")->capture_default_str();
  app.add_option("--odom-frame", options.odom, "Frame of odometry")->capture_default_str();
  app.add_option("--map-frame", options.map, "Frame of the map")->capture_default_str();
  app.add_option("--transform-tolerance", options.transformTolerance,
                 "How far ahead map -> odom is valid [s]")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  app.add_option("--belief", options.belief, "File that keeps the belief over runs");
  app.add_option("--seed", options.localization.seed, "Seed of all random numbers")
      ->capture_default_str();
  app.add_option("--node", options.node.node, "Name of the node")->capture_default_str();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Localizes a robot of ROS 2, in the place of Nav2's amcl", "ortung-ros2");
  app.footer("ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY and ROS_AUTOMATIC_DISCOVERY_RANGE are as in ROS.");
  LiveLocalization::Options options;
  options.localization.publish = true;
  std::string start = "global";
  std::string distro = "humble";
  addOptions(app, options);
  app.add_option("--start", start, "global, or x,y,degrees")->capture_default_str();
  app.add_option("--distro", distro, "Whom it talks to: humble, or jazzy and later")
      ->check(CLI::IsMember({"humble", "jazzy", "lyrical"}))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
    options.localization.start = startOf(start);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    options.node.distro = distro == "humble" ? Distro::kHumble : Distro::kJazzy;
    options.node.readEnvironment();
    LiveLocalization localization(options);
    running = &localization;
    std::signal(SIGINT, onSignal);
    std::signal(SIGTERM, onSignal);
    std::cout << "ortung-ros2: listening in domain " << options.node.domain << std::endl;
    localization.run();
    running = nullptr;
  } catch (const std::exception& error) {
    std::cerr << "ortung-ros2: " << error.what() << std::endl;
    return 1;
  }
  return 0;
}
