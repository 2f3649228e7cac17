/// ortung-ros2: localizes a robot of ROS 2 without an installation of ROS, in amcl's place. It
/// reads scan, odom, tf, tf_static and initialpose, and tells map -> odom at tf, amcl_pose,
/// particle_cloud and diagnostics.

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <future>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>

#include "LiveLearning.hpp"
#include "LiveLocalization.hpp"
#include "LiveSetup.hpp"
#include "ortung/base/Angles.hpp"

namespace {

using ortung::LocalizationConfig;
using ortung::LocalizationStart;
using ortung::ros2::Distro;
using ortung::ros2::learnTables;
using ortung::ros2::LiveLocalization;
using ortung::ros2::LiveSetup;
using ortung::ros2::Participant;

std::atomic<bool> isStopped = false;

void onSignal(int) { isStopped = true; }

/// What the command line says.
struct Arguments {
  LiveLocalization::Options localization;
  Participant::Options node;
  std::string map = "map";
  std::filesystem::path folder;
  std::string start = "global";
  std::string distro = "humble";
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

void addOptions(CLI::App& app, Arguments& arguments) {
  LiveLocalization::Options& options = arguments.localization;
  app.add_option("--robot", options.localization.robot,
                 "Robot file (TOML); default: made of the scans and the frames of their scanners");
  app.add_option("--tables", options.localization.tables,
                 "Table file of `ortung learn`; default: learned of the map")
      ->needs("--robot");
  app.add_option("--map", arguments.map, "Topic of the map, if it is learned")
      ->capture_default_str();
  app.add_option("--folder", arguments.folder, "Folder for what is made of the map")
      ->capture_default_str();
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
  app.add_option("--node", arguments.node.node, "Name of the node")->capture_default_str();
  app.add_option("--start", arguments.start, "global, or x,y,degrees")->capture_default_str();
  app.add_option("--distro", arguments.distro, "Whom it talks to: humble, or jazzy and later")
      ->check(CLI::IsMember({"humble", "jazzy", "lyrical"}))
      ->capture_default_str();
}

/// Waits for what is told of robot and map, and learns; again whenever the map has changed.
class Learning {
 public:
  Learning(Arguments& arguments, std::optional<LiveSetup>& setup, Participant& node)
      : arguments_(arguments), setup_(setup) {
    LiveSetup::Options wanted;
    for (const std::string& scan : arguments.localization.scans)
      wanted.scans.push_back(scan.substr(0, scan.find('=')));
    wanted.base = arguments.localization.base;
    wanted.map = arguments.map;
    setup_.emplace(std::move(wanted), node);
    std::filesystem::create_directories(arguments.folder);
  }

  /// @return the tables; nothing if the program was told to stop
  std::optional<std::filesystem::path> next() {
    const auto goOn = [this] { return tellWhatIsMissing(); };
    missing_ = "the map at " + arguments_.map;
    if (!setup_->waitForMap(goOn)) return std::nullopt;
    const std::filesystem::path world = arguments_.folder / "map.toml";
    std::filesystem::path& robot = arguments_.localization.localization.robot;
    setup_->writeWorld(world);
    if (robot.empty()) {
      missing_ = "scans";
      if (!setup_->waitForScanners(goOn)) return std::nullopt;
      robot = arguments_.folder / "robot.toml";
      setup_->writeRobot(robot);
      for (std::string& scan : arguments_.localization.scans)
        if (scan.find('=') == scan.npos) scan += "=" + LiveSetup::featureOf(scan);
    }
    missing_ = "tables";
    auto tables = arguments_.folder / ("map" + std::to_string(++count_ % 2) + ".ortung");
    if (!learnTables(world, robot, tables, goOn)) return std::nullopt;
    return tables;
  }

 private:
  bool tellWhatIsMissing() {
    for (const std::string& complaint : setup_->complaints())
      std::cerr << "ortung-ros2: " << complaint << '\n';
    const auto now = std::chrono::steady_clock::now();
    constexpr std::chrono::seconds kBetween{5};
    if (now - told_ >= kBetween) {
      if (missing_ != "tables")
        std::cout << "ortung-ros2: waiting for " << missing_ << '\n' << std::flush;
      told_ = now;
    }
    return !isStopped;
  }

  Arguments& arguments_;
  std::optional<LiveSetup>& setup_;
  std::string missing_;
  std::chrono::steady_clock::time_point told_ = std::chrono::steady_clock::now();
  std::size_t count_ = 0;  ///< of maps that were learned
};

void run(Arguments& arguments) {
  // The node goes first, since its threads use the others.
  std::optional<LiveSetup> setup;
  std::optional<LiveLocalization> localization;
  Participant node(arguments.node);
  std::cout << "ortung-ros2: listening in domain " << arguments.node.domain << '\n' << std::flush;
  LocalizationConfig& config = arguments.localization.localization;
  std::optional<Learning> learning;
  if (config.tables.empty()) {
    learning.emplace(arguments, setup, node);
    const auto tables = learning->next();
    if (!tables) return;
    config.tables = *tables;
  }
  localization.emplace(arguments.localization);
  localization->listen(node);
  std::cout << "ortung-ros2: localizing" << '\n' << std::flush;
  std::future<std::optional<std::filesystem::path>>
      learned;  // in the background: the robot drives on
  const auto isLearned = [&] {
    return learned.valid() &&
           learned.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  };
  while (!isStopped) {
    localization->run([&] {
      return !isStopped && !isLearned() && (learned.valid() || !setup || !setup->hasNewMap());
    });
    if (isStopped) break;
    if (!isLearned()) {
      std::cout << "ortung-ros2: another map" << '\n' << std::flush;
      learned = std::async(std::launch::async, [&] { return learning->next(); });
      continue;
    }
    try {
      if (const auto tables = learned.get()) localization->changeTables(*tables);
    } catch (const std::exception& error) {
      std::cerr << "ortung-ros2: the map stays, since of the new one: " << error.what() << '\n';
    }
  }
}

int start(int argc, char** argv) {
  CLI::App app("Localizes a robot of ROS 2, in the place of Nav2's amcl", "ortung-ros2");
  app.footer("ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY and ROS_AUTOMATIC_DISCOVERY_RANGE are as in ROS.");
  Arguments arguments;
  arguments.folder = cacheFolder();
  arguments.localization.localization.publish = true;
  addOptions(app, arguments);
  try {
    app.parse(argc, argv);
    arguments.localization.localization.start = startOf(arguments.start);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    arguments.node.distro = arguments.distro == "humble" ? Distro::kHumble : Distro::kJazzy;
    arguments.node.readEnvironment();
    arguments.localization.name = arguments.node.node;
    std::signal(SIGINT, onSignal);
    std::signal(SIGTERM, onSignal);
    run(arguments);
  } catch (const std::exception& error) {
    std::cerr << "ortung-ros2: " << error.what() << '\n';
    return 1;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return start(argc, argv);
  } catch (...) {  // what even an error could not be told of
    return 1;
  }
}
