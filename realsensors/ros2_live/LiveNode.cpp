#include "LiveNode.hpp"

#include <chrono>
#include <future>
#include <iomanip>
#include <iostream>
#include <utility>
#include <vector>

#include "LiveLearning.hpp"
#include "ortung/base/NewFile.hpp"
#include "ortung/robot/TableInfo.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung::ros2 {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace

LiveNode::LiveNode(Options options)
    : options_(std::move(options)),
      makesRobot_(options_.localization.localization.robot.empty()),
      settings_(options_.parameters.settings()),
      requests_(options_.localization.map),
      tables_(options_.folder),
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

/// Reads the world that the node has itself, and tells its maps.
void LiveNode::openWorld() {
  std::filesystem::path file = options_.world;
  if (!options_.building.empty()) {
    std::filesystem::create_directories(options_.folder);
    file = options_.folder / "building.toml";
    writeFile(file, options_.building);
  }
  if (file.empty()) return;
  maps_.emplace(readOwnWorld(file),
                LiveMaps::Options{options_.map, options_.localization.map, options_.folder},
                requests_);
  maps_->serve(node_);
}

/// Tells the map of the robot's floor if that is another one now.
void LiveNode::tellMap() {
  if (!maps_ || !isActive_) return;
  std::string floor;
  {
    const std::lock_guard lock(localizationMutex_);
    if (localization_) floor = localization_->floor();
  }
  maps_->tell(floor);
}

void LiveNode::listenForMap() {
  LiveSetup::Options wanted;
  for (const std::string& scan : options_.localization.scans) wanted.scans.push_back(topicOf(scan));
  for (const std::string& cloud : options_.localization.clouds)
    wanted.clouds.push_back(topicOf(cloud));
  wanted.bands = options_.localization.bands;
  wanted.base = options_.localization.base;
  wanted.map = maps_ ? "" : options_.map;
  wanted.maxRange = settings_.maxRange;
  setup_.emplace(std::move(wanted), node_);
  std::filesystem::create_directories(options_.folder);
}

/// Tells now and then what a start waits for. @return whether it goes on
bool LiveNode::goOnWaiting() {
  bond_.tick();
  if (!next_) tellMap();
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

/// What the tables of a world are known by.
std::uint64_t LiveNode::keyOf(const std::filesystem::path& world) const {
  if (maps_) return learned_;  // it may be made of any files, and is learned anew
  std::vector<std::filesystem::path> sources = {world, world, world};
  sources[1].replace_extension(".yaml");
  sources[2].replace_extension(".pgm");
  // Of a robot file that is made, filter and motion change, of which tables are not made.
  if (!makesRobot_) sources.push_back(options_.localization.localization.robot);
  return LearnedMaps::keyOf(sources);
}

/// Waits for what is told of robot and map, and learns.
/// @return the tables; nothing if the program was told to stop
std::optional<std::filesystem::path> LiveNode::learn() {
  const auto goOn = [this] { return goOnWaiting(); };
  std::filesystem::path world = options_.folder / "map.toml";
  std::filesystem::path& robot = options_.localization.localization.robot;
  if (maps_) {
    world = next_ ? next_->world.file : maps_->world().file;
  } else {
    if (!setup_->waitForMap(goOn)) return std::nullopt;
    setup_->writeWorld(world);
  }
  if (robot.empty()) {
    if (!setup_->waitForScanners(goOn)) return std::nullopt;
    robot = options_.folder / "robot.toml";
    writeRobot();
    for (std::string& scan : options_.localization.scans)
      if (scan.find('=') == scan.npos) scan += "=" + LiveSetup::featureOf(scan);
    for (std::string& cloud : options_.localization.clouds)
      if (cloud.find('=') == cloud.npos) cloud += "=" + LiveSetup::featureOf(cloud);
  }
  ++learned_;
  const std::uint64_t key = keyOf(world);
  if (auto known = tables_.find(key)) return known;
  auto tables = tables_.fileForNext();
  if (!learnTables(world, robot, tables, goOn)) return std::nullopt;
  tables_.keep(key, tables);
  return tables;
}

/// Learns another map beside the localization, which uses the tables of before meanwhile.
/// @return nothing if the program was told to stop
std::optional<LiveNode::Learned> LiveNode::learnAnother() {
  const Clock::time_point begin = Clock::now();
  const auto tables = learn();
  if (!tables) return std::nullopt;
  auto opened = localization_->open(*tables);
  return Learned{*tables, std::move(opened), secondsSince(begin)};
}

/// Goes on with what was learned, and tells how long readings have waited for that.
void LiveNode::use(Learned learned) {
  const Clock::time_point begin = Clock::now();
  localization_->changeTables(std::move(learned.opened), learned.tables, next_ ? next_->floor : "");
  if (next_) maps_->use(next_->world);
  std::cout << "ortung-ros2: the map is learned, in " << std::fixed << std::setprecision(2)
            << learned.seconds << " s; readings have waited for " << std::setprecision(1)
            << 1000.0 * secondsSince(begin) << std::defaultfloat << " ms" << '\n'
            << std::flush;
  options_.localization.localization.tables = std::move(learned.tables);
}

bool LiveNode::hasNewMap() const {
  if (maps_) return maps_->isAnotherWanted();
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
    const std::filesystem::path& tables = options_.localization.localization.tables;
    localization_->changeTables(localization_->open(tables), tables);
  } catch (const std::exception& error) {
    std::cerr << "ortung-ros2: parameters: " << error.what() << '\n';
  }
}

void LiveNode::run(const std::function<bool()>& isStopped) {
  isStopped_ = isStopped;
  LocalizationConfig& config = options_.localization.localization;
  openWorld();
  if (config.tables.empty()) {
    listenForMap();
    const auto tables = learn();
    if (!tables) return;
    config.tables = *tables;
  } else if (maps_) {
    maps_->world().checkFloors(readTableInfo(TableFile(config.tables)).region.building);
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
  std::future<std::optional<Learned>> learning;
  const auto isLearned = [&] {
    return learning.valid() &&
           learning.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  };
  while (!isStopped_()) {
    localization_->run([&] {
      bond_.tick();
      tellMap();
      return !isStopped_() && !isLearned() &&
             (learning.valid() || (!hasNewMap() && !hasChangedSettings()));
    });
    if (isStopped_()) break;
    // The robot file is not changed while it is learned from.
    if (hasChangedSettings() && !learning.valid()) applySettings();
    if (!isLearned()) {
      if (learning.valid() || !hasNewMap()) continue;
      std::cout << "ortung-ros2: another map" << '\n' << std::flush;
      if (!setup_) listenForMap();
      if (maps_) next_ = maps_->takeWanted();
      learning = std::async(std::launch::async, [this] { return learnAnother(); });
      continue;
    }
    try {
      if (auto learned = learning.get()) use(std::move(*learned));
    } catch (const std::exception& error) {
      std::cerr << "ortung-ros2: the map stays, since of the new one: " << error.what() << '\n';
    }
    next_.reset();
  }
}

}  // namespace ortung::ros2
