#include "ortung/served/ServedSimulation.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "OutlineText.hpp"
#include "ShippedRobots.hpp"
#include "Truth.hpp"
#include "ortung/motion/MotionModel.hpp"
#include "ortung/served/OpenFloor.hpp"
#include "ortung/server/FieldText.hpp"
#include "ortung/server/ProcessorTime.hpp"
#include "ortung/server/RobotPlugins.hpp"

namespace ortung {
namespace {

// What a robot of a client may be made of. Sources and players are for whoever runs the server.
constexpr std::string_view kInterfaces[] = {SensorData::kInterface, Sensor::kInterface,
                                            Drive::kInterface, MotionModel::kInterface};
constexpr std::size_t kMostPlanners = 8;  // each keeps a plan of the floor for one size

/// "player NAME WHAT", and for each of its options "option NAME KEY [unit=U] TEXT; default: D".
std::vector<std::string> helpOfPlayers(PluginFactory& factory) {
  constexpr std::string_view kPlayers[] = {Player::kInterface};
  std::vector<std::string> lines;
  for (const std::string& name : pluginsOf(factory, kPlayers)) {
    const auto help = factory.makeIfThere<PlayerHelp>(name, Parameters());
    lines.push_back("player " + name + (help ? " " + help->what() : ""));
    if (!help) continue;
    for (const PlayerOption& option : help->options())
      lines.push_back("option " + name + " " + option.key +
                      (option.unit.empty() ? "" : " unit=" + option.unit) + " " + option.meaning +
                      (option.fallback.empty() ? "" : "; default: " + option.fallback));
  }
  return lines;
}

}  // namespace

struct ServedSimulation::Guest {
  RobotWish wish;
  RobotNumber robot = 0;    ///< the simulation's; 0: it is not there
  bool isResident = false;  ///< whether it belongs to the scene
  RobotSize size;           ///< size of a client's robot
};

ServedSimulation::ServedSimulation(const std::filesystem::path& file,
                                   const Simulation::Config& config,
                                   const PlayerControl::Config& players)
    : ServedSimulation(Scene::open(file), config, players) {}

ServedSimulation::ServedSimulation(Scene scene, const Simulation::Config& config,
                                   const PlayerControl::Config& players)
    : scene_(std::move(scene)),
      config_(config),
      playerConfig_(players),
      factory_(PluginFactory::standardFolders()),
      plugins_(robotPlugins(factory_, kInterfaces)),
      playersHelp_(helpOfPlayers(factory_)),
      run_(std::make_unique<SceneRun>(scene_, config_, factory_, playerConfig_)),
      truth_(std::make_unique<Truth>()),
      entered_(run_->entrants()) {
  nameObjects();
  enterResidents();
}

ServedSimulation::~ServedSimulation() = default;

WorldDescription ServedSimulation::describe() const {
  const SimWorld& world = simulation().world();
  const Box2 bounds = world.solids().bounds;
  return {world.name(), world.fingerprint(), "simulation",
          FieldBounds{bounds.xLow, bounds.yLow, bounds.xHigh, bounds.yHigh}, objects_};
}

/// Things may have any name, also none or another's; clients need one word for each.
void ServedSimulation::nameObjects() {
  std::set<std::string> taken;
  for (const Simulation::Thing& thing : simulation().things()) {
    std::string word = thing.name.empty() ? thing.kind : thing.name;
    std::replace(word.begin(), word.end(), ' ', '_');
    std::string name = word;
    for (int number = 2; !taken.insert(name).second; ++number)
      name = word + "-" + std::to_string(number);
    objects_.push_back({name, thing.kind});
  }
  std::size_t place = 0;  // the world tells of them in the same order
  for (const WorldObject& object : simulation().world().objects()) {
    if (!object.isMovable || object.robot != 0 || place == objects_.size()) continue;
    ServedObject& named = objects_[place++];
    named.colour = object.colour;
    named.radius = object.radius;
    named.height = object.zHigh;
  }
}

std::vector<Resident> ServedSimulation::residents() const {
  std::vector<Resident> residents;
  for (const auto& [id, guest] : guests_)
    if (guest->isResident)
      residents.push_back({id, guest->wish.name, servedFeatures(find(id).container())});
  return residents;
}

/// The scene's robots, which it has let in. After a reset they are who they were.
void ServedSimulation::enterResidents() {
  std::erase_if(guests_, [&](const auto& entry) {
    const Guest& guest = *entry.second;
    return guest.isResident && !run_->find(guest.wish.name);
  });
  for (const auto& robot : simulation().robots()) addResident(*robot);
  ++version_;
}

void ServedSimulation::addResident(SimRobot& robot) {
  ++version_;
  const std::string& name = robot.config().name;
  for (const auto& [id, guest] : guests_)
    if (guest->isResident && guest->wish.name == name) {
      guest->robot = robot.state().number;
      return;
    }
  auto guest = std::make_unique<Guest>();
  guest->wish.name = name;
  guest->isResident = true;
  guest->robot = robot.state().number;
  guests_[++lastId_] = std::move(guest);
}

/// Residents whose players have ended.
void ServedSimulation::dropLeavers() {
  const std::size_t gone = std::erase_if(guests_, [&](const auto& entry) {
    return entry.second->isResident && simulation().find(entry.second->robot) == nullptr;
  });
  if (gone > 0) ++version_;
}

std::vector<std::string> ServedSimulation::robotKinds() const { return shippedRobots(); }

Timestamp ServedSimulation::now() const {
  return simulation().now() + (isMovePending_ ? fromSeconds(simulation().cycle()) : 0);
}

/// Clients command by what they have sensed in a cycle, as players in the simulator do. So robots
/// move only when those have had their say: before the next cycle, or whatever else is done.
void ServedSimulation::step() {
  constexpr double kNewest = 0.1;  // share of the newest cycle in the mean
  const double before = processorTime();
  finishCycle();
  run_->act();
  noteEvents();
  isMovePending_ = true;
  load_ += kNewest * ((processorTime() - before) / simulation().cycle() - load_);
}

void ServedSimulation::noteEvents() {
  if (run_->referee() == nullptr) return;
  constexpr std::size_t kMost = 1000;
  for (RefereeEvent& event : run_->referee()->takeEvents()) {
    if (events_.size() == kMost) events_.pop_front();
    events_.push_back({eventsSoFar_++, std::move(event)});
  }
}

void ServedSimulation::finishCycle() {
  if (!std::exchange(isMovePending_, false)) return;
  run_->move();
  dropLeavers();
}

std::string ServedSimulation::startPlayer(const PlayerWish& wish) {
  finishCycle();
  try {
    SimRobot& robot = run_->addPlayer(wish, entered_++);
    const std::string name = robot.config().name;
    addResident(robot);
    run_->players().clear();
    dropLeavers();
    if (!run_->find(name))
      throw ServeError(
          "player", "the player '" + wish.plugin + "' failed when it began; the server says why");
    return name;
  } catch (const NoRoom& error) {
    throw ServeError("no-room", error.what());
  }
}

std::unique_ptr<PlayerHelp> ServedSimulation::helpOf(const std::string& player) {
  return factory_.makeIfThere<PlayerHelp>(player, Parameters());
}

void ServedSimulation::stopPlayer(const std::string& robot) {
  finishCycle();
  if (!run_->players().stop(robot))
    throw ServeError("no-player", "no player plays robot '" + robot + "'; PLAYERS lists them");
  run_->players().clear();
  dropLeavers();
}

void ServedSimulation::orderReferee(const std::string& order) {
  if (run_->referee() == nullptr) throw ServeError("no-referee", "nobody referees here");
  run_->referee()->order(order);
}

bool ServedSimulation::hasWanderer(const RobotSize& size) const {
  return std::any_of(guests_.begin(), guests_.end(), [&](const auto& entry) {
    const Guest& guest = *entry.second;
    return guest.wish.wanders && guest.robot != 0 && guest.size == size;
  });
}

/// Gives plans back that nobody wanders by, the oldest first, until there are at most @p most.
void ServedSimulation::dropPlanners(std::size_t most) {
  for (auto plan = planned_.begin(); plan != planned_.end() && planned_.size() > most;) {
    if (hasWanderer(*plan)) {
      ++plan;
      continue;
    }
    run_->plans().forget(*plan);
    plan = planned_.erase(plan);
  }
}

/// A plan costs memory, so those of clients' robots are few. Who wanders needs his for as long as
/// he is there; who is only placed needs it once.
void ServedSimulation::preparePlanner(const RobotSize& size, bool wanders) {
  const auto known = std::find(planned_.begin(), planned_.end(), size);
  if (known != planned_.end()) {
    std::rotate(known, known + 1, planned_.end());
    return;
  }
  if (run_->plans().has(size)) return;  // the scene's
  dropPlanners(kMostPlanners - 1);
  if (wanders && planned_.size() >= kMostPlanners)
    throw ServeError("limit", "robots of " + std::to_string(kMostPlanners) +
                                  " different sizes wander here already; do not ask for wandering");
  try {
    run_->plans().of(size);
  } catch (const std::invalid_argument& error) {
    throw ServeError("no-room", error.what());
  }
  planned_.push_back(size);
}

/// Brings a robot onto the field, where it wants to be; if that place is taken at a reset,
/// anywhere.
void ServedSimulation::enter(RobotId robot, Guest& guest) {
  RobotConfig config = guest.wish.config;
  // Clients name their robots as they like, so two of them may like the same.
  while (run_->find(config.name)) config.name += "-" + std::to_string(robot);
  const bool isRestart = guests_.contains(robot);
  guest.robot = 0;
  guest.size = sizeOf(config);
  if (guest.wish.wanders || !guest.wish.start) preparePlanner(guest.size, guest.wish.wanders);
  const std::uint64_t number = entered_;
  const auto add = [&](const std::optional<Pose2>& start) {
    guest.robot = run_->addRobot(config, factory_, start, number).state().number;
    run_->players().join(config.name, guest.wish.team);
  };
  try {
    add(guest.wish.start);
  } catch (const NoRoom& error) {
    if (!guest.wish.start || !isRestart) throw ServeError("no-room", error.what());
    preparePlanner(guest.size, guest.wish.wanders);
    add(std::nullopt);
  } catch (const std::invalid_argument& error) {  // all robots have too many pieces
    throw ServeError("limit", error.what());
  }
  ++entered_;
  if (guest.wish.wanders) run_->letWander(*simulation().find(guest.robot), number);
}

ServedRobot ServedSimulation::addRobot(RobotId robot, RobotWish wish) {
  finishCycle();
  lastId_ = std::max(lastId_, robot);
  auto guest = std::make_unique<Guest>();
  guest->wish = std::move(wish);
  ServedRobot served;
  try {
    enter(robot, *guest);
    SimRobot& entered = *simulation().find(guest->robot);
    served = {servedFeatures(entered.container()), entered.raysPerSecond(simulation().cycle()),
              entered.raysAtOnce()};
  } catch (...) {  // its plugins may fail when they are asked, too
    takeOff(*guest);
    throw;
  }
  guests_[robot] = std::move(guest);
  dropPlanners(kMostPlanners);
  return served;
}

/// Nothing of a robot stays on the field, if it is there.
void ServedSimulation::takeOff(Guest& guest) {
  if (const SimRobot* robot = simulation().find(guest.robot)) {
    run_->players().leave(robot->config().name);
    simulation().removeRobot(*robot);
  }
  guest.robot = 0;
}

ServedSimulation::Guest& ServedSimulation::guest(RobotId robot) const {
  const auto found = guests_.find(robot);
  if (found == guests_.end())
    throw ServeError("no-robot", "there is no robot " + std::to_string(robot));
  return *found->second;
}

SimRobot& ServedSimulation::find(RobotId robot) const {
  SimRobot* found = simulation().find(guest(robot).robot);
  if (found == nullptr)
    throw ServeError("no-room", "robot " + std::to_string(robot) + " found no room at the reset");
  return *found;
}

RobotCommands& ServedSimulation::commands(RobotId robot) { return find(robot); }

void ServedSimulation::tell(RobotId robot, std::string_view text) {
  const std::string& name = find(robot).config().name;
  try {
    run_->players().say(name, text);
  } catch (const std::invalid_argument& error) {
    throw ServeError("limit", "robot " + name + " " + error.what());
  }
}

std::vector<ServedTalk> ServedSimulation::takeHeard(RobotId robot) {
  std::vector<ServedTalk> talk;
  for (Heard& heard : run_->players().takeHeard(find(robot).config().name))
    talk.push_back({heard.stamp, std::move(heard.from), std::move(heard.text)});
  return talk;
}

void ServedSimulation::removeRobot(RobotId robot) {
  finishCycle();
  takeOff(guest(robot));
  guests_.erase(robot);
}

void ServedSimulation::want(RobotId robot, std::span<const SensorId> features) {
  SimRobot* found = simulation().find(guest(robot).robot);
  if (found == nullptr) return;  // it found no room at a reset
  found->setWanted({}, false);
  for (const SensorId& id : features) found->setWanted({id.model, id.type, id.feature}, true);
}

std::span<Message> ServedSimulation::readings(RobotId robot) {
  return simulation().readingsOf(guest(robot).robot);
}

std::vector<std::string> ServedSimulation::abilities(RobotId robot) const {
  SimRobot& found = find(robot);
  const DriveLimits limits = found.drive().limits();
  const RobotConfig& config = found.config();
  std::vector<std::string> lines = {
      "drive " + found.drive().commandHelp(),
      "motion kind=" + found.drive().kind() +
          " numbers=" + std::to_string(found.drive().commandSize()),
      "limits" + keyValue("v_m_s", limits.speed) + keyValue("w_rad_s", limits.turn) +
          keyValue("a_m_s2", limits.acceleration) +
          keyValue("alpha_rad_s2", limits.turnAcceleration),
      "body" + keyValue("radius_m", config.radius) + keyValue("height_m", found.shape().top()) +
          keyValue("mass_kg", config.mass)};
  for (const Manipulator& manipulator : found.shape().manipulators) {
    std::string line = "manipulator " + manipulator.name;
    for (const ManipulatorState& state : manipulator.states) line += " " + state.name;
    lines.push_back(line);
  }
  for (std::string& outline : outlineText(found.shape())) lines.push_back(std::move(outline));
  return lines;
}

const std::vector<std::string>& ServedSimulation::floor() const {
  if (floor_.empty()) {
    const FieldRegion region = openFloor(simulation().world());
    floor_ = floorText(region.grid, region.open);
  }
  return floor_;
}

std::vector<std::string> ServedSimulation::field() const {
  const SimWorld& world = simulation().world();
  const FieldModel model = fieldModelOf(world);
  std::vector<std::string> lines = fieldText(model);
  for (std::string& solid : solidText(world.solids())) lines.push_back(std::move(solid));
  if (isFloor(model)) lines.insert(lines.end(), floor().begin(), floor().end());
  return lines;
}

std::vector<ServedFeature> ServedSimulation::truthFeatures() const { return Truth::features(); }

std::span<Message> ServedSimulation::truth() {
  std::map<RobotNumber, RobotId> numbers;
  for (const auto& [id, guest] : guests_)
    if (guest->robot != 0) numbers[guest->robot] = id;
  return truth_->look(simulation(), numbers);
}

std::string ServedSimulation::side(RobotId robot) const {
  const auto found = guests_.find(robot);
  if (found == guests_.end() || found->second->robot == 0) return {};
  const std::string& name = find(robot).config().name;
  for (const PlayerControl::Seated& seated : run_->players().players())
    if (seated.robot == name)
      return (seated.team.empty() ? "" : " team=" + seated.team) + " player=" + seated.plugin;
  const std::string& team = found->second->wish.team;
  const std::string plugin = run_->players().takenFrom(find(robot));
  return (team.empty() ? "" : " team=" + team) + (plugin.empty() ? "" : " taken_from=" + plugin);
}

void ServedSimulation::giveBack(RobotId robot) {
  SimRobot& its = find(robot);
  if (!run_->players().giveBack(its, simulation().random(2 * robot + 1)))
    throw ServeError("no-player",
                     "robot " + std::to_string(robot) +
                         " was not taken from a player; LIST robots tells taken_from=");
}

void ServedSimulation::reset(std::optional<std::uint64_t> seed) {
  Simulation::Config config = config_;
  if (seed) config.seed = *seed;
  auto fresh = std::make_unique<SceneRun>(scene_, config, factory_, playerConfig_);
  run_ = std::move(fresh);
  isMovePending_ = false;
  events_.clear();
  eventsSoFar_ = 0;
  planned_.clear();
  config_ = config;
  entered_ = run_->entrants();
  enterResidents();
  for (auto& [id, guest] : guests_) {
    if (guest->isResident) continue;
    try {
      enter(id, *guest);
    } catch (const std::exception&) {
      takeOff(*guest);  // no room for it this time: whoever commands it is told so
    }
  }
}

void ServedSimulation::placeRobot(RobotId robot, const Pose2& pose) {
  finishCycle();
  try {
    simulation().place(find(robot), pose);
  } catch (const std::invalid_argument& error) {
    throw ServeError("no-room", error.what());
  }
}

void ServedSimulation::placeObject(const std::string& object, const Pose2& pose) {
  finishCycle();
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (objects_[i].name != object) continue;
    try {
      return simulation().placeThing(i, pose);
    } catch (const std::invalid_argument& error) {
      throw ServeError("no-room", error.what());
    }
  }
  throw ServeError("no-object",
                   "this world has no movable object '" + object + "'; DESCRIBE world lists them");
}

}  // namespace ortung
