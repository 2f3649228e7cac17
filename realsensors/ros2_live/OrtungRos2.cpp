/// ortung-ros2: localizes a robot of ROS 2 without an installation of ROS, in amcl's place. It
/// reads scan, odom, tf, tf_static and initialpose, tells map -> odom at tf, amcl_pose,
/// particle_cloud and diagnostics, and has amcl's parameters and services.

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "AmclParameters.hpp"
#include "FloorOptions.hpp"
#include "LiveLocalization.hpp"
#include "LiveNode.hpp"
#include "ParamsFile.hpp"
#include "RosArguments.hpp"
#include "StartPose.hpp"

namespace {

using ortung::LocalizationStart;
using ortung::ros2::AmclParameters;
using ortung::ros2::AmclSettings;
using ortung::ros2::LiveLocalization;
using ortung::ros2::LiveNode;
using ortung::ros2::readParamsFile;
using ortung::ros2::RosArguments;
using ortung::ros2::RosNames;

std::atomic<bool> isStopped = false;

void onSignal(int) { isStopped = true; }

/// What the command line says.
struct Arguments {
  LiveNode::Options node;
  std::vector<std::string> floors;           ///< floors of a building
  std::vector<std::string> lifts;            ///< lifts of a building
  std::vector<std::filesystem::path> files;  ///< files of parameters
  std::string start;                         ///< "": as parameters say
  std::string band;                          ///< heights of clouds
  std::string distro = ortung::ros2::releaseHere();
};

std::filesystem::path cacheFolder() {
  const char* const cache = std::getenv("XDG_CACHE_HOME");
  const char* const home = std::getenv("HOME");
  const std::filesystem::path base = cache != nullptr  ? std::filesystem::path(cache)
                                     : home != nullptr ? std::filesystem::path(home) / ".cache"
                                                       : std::filesystem::temp_directory_path();
  return base / "ortung" / "ros2";
}

LocalizationStart startOf(const std::string& text) {
  if (text == "global") return {};
  const auto pose = ortung::ros2::parseStartPose(text);
  if (!pose)
    throw CLI::ValidationError("--start", "is '" + text + "', expected global or x,y,degrees");
  LocalizationStart start{LocalizationStart::Kind::kPose};
  start.pose = *pose;
  return start;
}

/// Options of who has maps that nobody tells.
void addWorlds(CLI::App& app, Arguments& arguments) {
  CLI::Option* const world =
      app.add_option("--world", arguments.node.world,
                     "World file (TOML), e.g. of a building, in place of the map that is told");
  CLI::Option* const floor =
      app.add_option("--floor", arguments.floors,
                     "Floor of a building, NAME=MAP (e.g. a map_server YAML); may be given again")
          ->excludes(world);
  app.add_option("--lift", arguments.lifts,
                 "Lift that stops on all floors, NAME=X,Y[,RADIUS] [m]; may be given again")
      ->needs(floor);
}

void addOptions(CLI::App& app, Arguments& arguments) {
  LiveLocalization::Options& options = arguments.node.localization;
  options.localization.keepsTime = true;
  app.add_option("--robot", options.localization.robot,
                 "Robot file (TOML); default: made of the scans and the frames of their scanners");
  app.add_option("--tables", options.localization.tables,
                 "Table file of `ortung learn`; default: learned of the map")
      ->needs("--robot");
  app.add_option("--map", arguments.node.map,
                 "Topic of the map that is learned, or that is told if the map is its own")
      ->capture_default_str();
  addWorlds(app, arguments);
  app.add_option("--folder", arguments.node.folder,
                 "Folder for what is made of the map; default: in the user's cache");
  app.add_option("--scan", options.scans,
                 "Topic of a scanner, TOPIC or TOPIC=MODEL/TYPE/FEATURE; may be given again")
      ->capture_default_str();
  app.add_option(
      "--cloud", options.clouds,
      "Topic of a lidar (PointCloud2) that becomes a scanner, as for --scan, in its place");
  app.add_option("--band", arguments.band,
                 "Heights above the base at which points of clouds count [m]: LOW,HIGH or "
                 "TOPIC:LOW,HIGH, and ';' between two; default: 0.2,1.8");
  app.add_option(
         "--level", options.level,
         "What tells roll and pitch, for clouds: a topic of sensor_msgs/Imu, odometry, none")
      ->capture_default_str();
  app.add_option("--feature", options.features,
                 "Topic whose messages (Range, PoseWithCovarianceStamped, Image) fill a feature of "
                 "the robot file, TOPIC=MODEL/TYPE/FEATURE; may be given again")
      ->needs("--robot");
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
  app.add_option("--node", arguments.node.node.names.node, "Name of the node")
      ->capture_default_str();
  app.add_option("--params-file", arguments.files,
                 "Parameters of amcl, as nav2_params.yaml; may be given again");
  app.add_option("--start", arguments.start,
                 "global, or x,y,degrees; default: global, or where "
                 "parameters say");
  app.add_option("--distro", arguments.distro,
                 "Release of those it talks to; default: ROS_DISTRO, or humble")
      ->check(CLI::IsMember(ortung::ros2::kReleases))
      ->capture_default_str();
}

/// Takes the parameters of amcl where they stand in for options.
void useParameters(Arguments& arguments, const RosArguments& ros) {
  AmclParameters& parameters = arguments.node.parameters;
  const auto set = [&](const std::string& where, const std::string& name,
                       const std::string& value) {
    try {
      parameters.setText(name, value);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(where + ": " + error.what());
    }
  };
  std::vector<RosArguments::Parameters> places;
  for (const std::filesystem::path& file : arguments.files) places.push_back({file, "", ""});
  places.insert(places.end(), ros.parameters.begin(), ros.parameters.end());
  for (const auto& [file, name, value] : places) {
    if (file.empty()) {
      set("-p", name, value);
      continue;
    }
    for (const auto& [key, text, isForAll] : readParamsFile(file, arguments.node.node.names))
      if (!isForAll || AmclParameters::find(key) != nullptr) set(file.string(), key, text);
  }
  const AmclSettings settings = parameters.settings();
  LiveLocalization::Options& options = arguments.node.localization;
  options.base = settings.base;
  options.odom = settings.odom;
  options.map = settings.map;
  options.scans = {settings.scanTopic};
  options.transformTolerance = settings.transformTolerance;
  options.tellsTransform = settings.tellsTransform;
  options.saveSeconds = settings.saveSeconds;
  options.belief = settings.belief;
  options.startsAnew = settings.initialPose && settings.alwaysResets;
  if (settings.seed) options.localization.seed = *settings.seed;
  arguments.node.map = settings.mapTopic;
  if (!settings.initialPose) return;
  // As wide as amcl's own.
  options.localization.start = {LocalizationStart::Kind::kPose, *settings.initialPose, 0.5,
                                std::numbers::pi / 12.0};
}

/// Takes what clouds need. With clouds or features there are scans only where an option names
/// them.
void useClouds(const CLI::App& app, Arguments& arguments) {
  LiveLocalization::Options& options = arguments.node.localization;
  const bool hasOthers = !options.clouds.empty() || !options.features.empty();
  if (hasOthers && app.count("--scan") == 0) options.scans.clear();
  try {
    options.bands.takeHeights(arguments.band);
    options.bands.check();
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError("--band", error.what());
  }
}

/// Reads all that the command line says. @throws CLI::ParseError, std::runtime_error,
/// std::invalid_argument
void read(CLI::App& app, Arguments& arguments, const std::vector<std::string>& words) {
  const RosArguments ros = RosArguments::read(words, arguments.node.node.names.node);
  const auto parse = [&] {
    std::vector<std::string> others(ros.others.rbegin(), ros.others.rend());
    app.parse(others);
  };
  parse();  // for the files of parameters, and the node's name by which they are read
  RosNames& names = arguments.node.node.names;
  if (ros.namesNode) names.node = ros.names.node;
  names.space = ros.names.space;
  names.remaps = ros.names.remaps;
  names.check();
  useParameters(arguments, ros);
  const std::string node = names.node;
  parse();  // which counts more than they do
  if (ros.namesNode) names.node = node;
  if (arguments.node.folder.empty()) arguments.node.folder = cacheFolder();
  useClouds(app, arguments);
  if (!arguments.floors.empty())
    arguments.node.building = ortung::ros2::buildingToml(arguments.floors, arguments.lifts);
  if (!arguments.start.empty())
    arguments.node.localization.localization.start = startOf(arguments.start);
  LiveNode::Options& options = arguments.node;
  options.node.distro = ortung::ros2::distroOf(arguments.distro);
  options.node.readEnvironment();
  options.localization.name = names.node;
}

int start(const std::vector<std::string>& words) {
  CLI::App app("Localizes a robot of ROS 2, in the place of Nav2's amcl", "ortung-ros2");
  app.footer(
      "--ros-args -r FROM:=TO -p NAME:=VALUE --params-file FILE -- is understood as by any node.\n"
      "ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY and ROS_AUTOMATIC_DISCOVERY_RANGE are as in ROS.");
  Arguments arguments;
  arguments.node.localization.localization.publish = true;
  arguments.node.node.names.node = "amcl";
  addOptions(app, arguments);
  try {
    read(app, arguments, words);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::cerr << "ortung-ros2: " << error.what() << '\n';
    return 2;
  }
  try {
    std::signal(SIGINT, onSignal);
    std::signal(SIGTERM, onSignal);
    const bool hasRobotFile = !arguments.node.localization.localization.robot.empty();
    if (const std::string remark = arguments.node.parameters.remark(hasRobotFile); !remark.empty())
      std::cout << "ortung-ros2: " << remark << '\n';
    LiveNode node(std::move(arguments.node));
    node.run([] { return isStopped.load(); });
  } catch (const std::exception& error) {
    std::cerr << "ortung-ros2: " << error.what() << '\n';
    return 1;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return start({argv + 1, argv + argc});
  } catch (...) {  // what even an error could not be told of
    return 1;
  }
}
