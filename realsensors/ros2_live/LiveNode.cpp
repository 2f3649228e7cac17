#include "LiveNode.hpp"

#include <chrono>
#include <future>
#include <iostream>
#include <utility>

#include "LiveLearning.hpp"

namespace ortung::ros2 {

LiveNode::LiveNode(Options options)
    : options_(std::move(options)),
      makesRobot_(options_.localization.localization.robot.empty()),
      settings_(options_.parameters.settings()),
      requests_(options_.localization.map),
      isActive_(settings_.startsItself),
      bond_(options_.node.names.node, settings_.heartbeatSeconds),
      node_(options_.node) {
  lifecycle_.emplace(settings_.startsItself,
                     [this](auto transition, auto state) { onTransition(transition, state); });
  services_.emplace(options_.parameters, options_.node.names.full(),
                    [this](const AmclSettings& settings) {
                      const std::lock_guard lock(mutex_);
                      wanted_ = settings;
                    });
  requests_.serve(node_);
  bond_.connect(node_);
  services_->serve(node_);
  lifecycle_->serve(node_);
  std::cout << "ortung-ros2: listening in domain " << options_.node.domain << '\n' << std::flush;
}

/// On the thread of services.
void LiveNode::onTransition(Lifecycle::Transition transition, Lifecycle::State state) {
  isActive_ = state == Lifecycle::State::kActive;
  if (transition == Lifecycle::Transition::kConfigure) requests_.configure();
  if (isActive_)
    bond_.start();
  else
    bond_.stop();
  const std::lock_guard lock(localizationMutex_);
  if (localization_) localization_->setActive(isActive_);
}

void LiveNode::listenForMap() {
  LiveSetup::Options wanted;
  for (const std::string& scan : options_.localization.scans) wanted.scans.push_back(topicOf(scan));
  for (const std::string& cloud : options_.localization.clouds)
    wanted.clouds.push_back(topicOf(cloud));
  wanted.bands = options_.localization.bands;
  wanted.base = options_.localization.base;
  wanted.map = options_.map;
  wanted.maxRange = settings_.maxRange;
  setup_.emplace(std::move(wanted), node_);
  std::filesystem::create_directories(options_.folder);
}

/// Tells now and then what a start waits for. @return whether it goes on
bool LiveNode::goOnWaiting() {
  bond_.tick();
  for (const std::string& complaint : setup_->complaints())
    std::cerr << "ortung-ros2: " << complaint << '\n';
  const auto now = std::chrono::steady_clock::now();
  constexpr std::chrono::seconds kBetween{5};
  if (now - told_ >= kBetween) {
    if (const std::string missing = setup_->missing(); !missing.empty())
      std::cout << "ortung-ros2: waiting for " << missing << '\n' << std::flush;
    told_ = now;
  }
  return !isStopped_();
}

void LiveNode::writeRobot() {
  setup_->writeRobot(options_.localization.localization.robot, settings_.robotToml);
}

/// Waits for what is told of robot and map, and learns.
/// @return the tables; nothing if the program was told to stop
std::optional<std::filesystem::path> LiveNode::learn() {
  const auto goOn = [this] { return goOnWaiting(); };
  if (!setup_->waitForMap(goOn)) return std::nullopt;
  const std::filesystem::path world = options_.folder / "map.toml";
  std::filesystem::path& robot = options_.localization.localization.robot;
  setup_->writeWorld(world);
  if (robot.empty()) {
    if (!setup_->waitForScanners(goOn)) return std::nullopt;
    robot = options_.folder / "robot.toml";
    writeRobot();
    for (std::string& scan : options_.localization.scans)
      if (scan.find('=') == scan.npos) scan += "=" + LiveSetup::featureOf(scan);
    for (std::string& cloud : options_.localization.clouds)
      if (cloud.find('=') == cloud.npos) cloud += "=" + LiveSetup::featureOf(cloud);
  }
  auto tables = options_.folder / ("map" + std::to_string(++learned_ % 2) + ".ortung");
  if (!learnTables(world, robot, tables, goOn)) return std::nullopt;
  return tables;
}

bool LiveNode::hasNewMap() const {
  return setup_ && !(settings_.isFirstMapOnly && learned_ > 0) && setup_->hasNewMap();
}

bool LiveNode::hasChangedSettings() const {
  const std::lock_guard lock(mutex_);
  return wanted_.has_value();
}

void LiveNode::applySettings() {
  AmclSettings changed;
  {
    const std::lock_guard lock(mutex_);
    changed = *std::exchange(wanted_, {});
  }
  const bool isOtherRobot = makesRobot_ && changed.robotToml != settings_.robotToml;
  settings_ = std::move(changed);
  localization_->change(settings_.transformTolerance, settings_.tellsTransform,
                        settings_.saveSeconds);
  if (!isOtherRobot) return;
  try {
    writeRobot();
    localization_->changeTables(options_.localization.localization.tables);
  } catch (const std::exception& error) {
    std::cerr << "ortung-ros2: parameters: " << error.what() << '\n';
  }
}

void LiveNode::run(const std::function<bool()>& isStopped) {
  isStopped_ = isStopped;
  LocalizationConfig& config = options_.localization.localization;
  if (config.tables.empty()) {
    listenForMap();
    const auto tables = learn();
    if (!tables) return;
    config.tables = *tables;
  }
  auto localization = std::make_unique<LiveLocalization>(options_.localization, requests_);
  {
    const std::lock_guard lock(localizationMutex_);
    localization_ = std::move(localization);
    localization_->setActive(isActive_);
  }
  localization_->listen(node_);
  std::cout << "ortung-ros2: localizing" << '\n' << std::flush;
  localize();
}

/// Localizes until the program is stopped; a new map is learned meanwhile, since the robot drives
/// on.
void LiveNode::localize() {
  std::future<std::optional<std::filesystem::path>> learning;
  const auto isLearned = [&] {
    return learning.valid() &&
           learning.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  };
  while (!isStopped_()) {
    localization_->run([&] {
      bond_.tick();
      return !isStopped_() && !isLearned() &&
             (learning.valid() || (!hasNewMap() && !hasChangedSettings()));
    });
    if (isStopped_()) break;
    // The robot file is not changed while it is learned from.
    if (hasChangedSettings() && !learning.valid()) applySettings();
    if (!isLearned()) {
      if (learning.valid() || !hasNewMap()) continue;
      std::cout << "ortung-ros2: another map" << '\n' << std::flush;
      learning = std::async(std::launch::async, [this] { return learn(); });
      continue;
    }
    try {
      if (const auto tables = learning.get()) {
        localization_->changeTables(*tables);
        options_.localization.localization.tables = *tables;
      }
    } catch (const std::exception& error) {
      std::cerr << "ortung-ros2: the map stays, since of the new one: " << error.what() << '\n';
    }
  }
}

}  // namespace ortung::ros2
