#include "ortung/served/ServedSimulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ortung/motion/MotionModel.hpp"
#include "ortung/server/RobotPlugins.hpp"

namespace ortung {
namespace {

// What a robot of a client may be made of. Sources and players are for whoever runs the server.
constexpr std::string_view kInterfaces[] = {SensorData::kInterface, Sensor::kInterface,
                                            Drive::kInterface, MotionModel::kInterface};
constexpr std::size_t kMostPlanners = 8;  // each keeps a plan of the floor for one size

}  // namespace

struct ServedSimulation::Guest {
  RobotWish wish;
  SimRobot* robot = nullptr;  ///< the simulation's
  bool isResident = false;    ///< of the scene, which has let it in
};

ServedSimulation::ServedSimulation(const std::filesystem::path& file,
                                   const Simulation::Config& config)
    : ServedSimulation(Scene::open(file), config) {}

ServedSimulation::ServedSimulation(Scene scene, const Simulation::Config& config)
    : scene_(std::move(scene)),
      config_(config),
      factory_(PluginFactory::standardFolders()),
      plugins_(robotPlugins(factory_, kInterfaces)),
      run_(std::make_unique<SceneRun>(scene_, config_, factory_)),
      entered_(scene_.robots.size()) {
  for (const SceneRobot& robot : scene_.robots) {
    auto guest = std::make_unique<Guest>();
    guest->wish.name = robot.name;
    guest->isResident = true;
    const auto id = static_cast<RobotId>(guests_.size() + 1);
    enter(id, *guest);
    guests_[id] = std::move(guest);
  }
}

ServedSimulation::~ServedSimulation() = default;

WorldDescription ServedSimulation::describe() const {
  const SimWorld& world = simulation().world();
  return {world.name(), world.fingerprint(), "simulation"};
}

std::vector<Resident> ServedSimulation::residents() const {
  std::vector<Resident> residents;
  for (const auto& [id, guest] : guests_)
    if (guest->isResident)
      residents.push_back({id, guest->wish.name, servedFeatures(guest->robot->container())});
  return residents;
}

/// A planner costs time and memory, so clients can't have as many as they like.
void ServedSimulation::preparePlanner(const RobotSize& size) {
  if (!run_->hasPlanner(size) && run_->planners() >= kMostPlanners)
    throw ServeError("limit", "robots of " + std::to_string(kMostPlanners) +
                                  " different sizes are here already; give a start, and do not "
                                  "ask for wandering");
  try {
    run_->planner(size);
  } catch (const std::invalid_argument& error) {
    throw ServeError("no-room", error.what());
  }
}

/// Brings a robot onto the field, where it wants to be; if that place is taken at a reset,
/// anywhere.
void ServedSimulation::enter(RobotId robot, Guest& guest) {
  if (guest.isResident) {
    guest.robot = simulation().robots()[*run_->find(guest.wish.name)].get();
    return;
  }
  RobotConfig config = guest.wish.config;
  // Clients name their robots as they like, so two of them may like the same.
  if (run_->find(config.name)) config.name += "-" + std::to_string(robot);
  const bool isRestart = guests_.contains(robot);
  if (guest.wish.wanders || !guest.wish.start) preparePlanner(sizeOf(config));
  const std::uint64_t number = entered_;
  const auto add = [&](const std::optional<Pose2>& start) {
    guest.robot = &run_->addRobot(config, factory_, start, number);
  };
  try {
    add(guest.wish.start);
  } catch (const std::invalid_argument& error) {
    if (!guest.wish.start || !isRestart) throw ServeError("no-room", error.what());
    preparePlanner(sizeOf(config));
    add(std::nullopt);
  }
  ++entered_;
  if (guest.wish.wanders) run_->letWander(*guest.robot, number);
}

ServedRobot ServedSimulation::addRobot(RobotId robot, RobotWish wish) {
  auto guest = std::make_unique<Guest>();
  guest->wish = std::move(wish);
  enter(robot, *guest);
  SimRobot& entered = *guest->robot;
  guests_[robot] = std::move(guest);
  return {servedFeatures(entered.container()), entered.raysPerSecond(simulation().cycle())};
}

ServedSimulation::Guest& ServedSimulation::guest(RobotId robot) const {
  const auto found = guests_.find(robot);
  if (found == guests_.end())
    throw ServeError("no-robot", "there is no robot " + std::to_string(robot));
  return *found->second;
}

SimRobot& ServedSimulation::find(RobotId robot) const {
  SimRobot* found = guest(robot).robot;
  if (found == nullptr)
    throw ServeError("no-room", "robot " + std::to_string(robot) + " found no room at the reset");
  return *found;
}

RobotCommands& ServedSimulation::commands(RobotId robot) { return find(robot); }

void ServedSimulation::removeRobot(RobotId robot) {
  const Guest& leaving = guest(robot);
  if (leaving.robot != nullptr) simulation().removeRobot(*leaving.robot);
  guests_.erase(robot);
}

std::span<const Message> ServedSimulation::readings(RobotId robot) const {
  const SimRobot* wanted = guest(robot).robot;
  const auto robots = simulation().robots();
  for (std::size_t i = 0; i < robots.size(); ++i)
    if (robots[i].get() == wanted) return simulation().readings(i);
  return {};
}

std::vector<std::string> ServedSimulation::abilities(RobotId robot) const {
  SimRobot& found = find(robot);
  std::vector<std::string> lines = {"drive " + found.drive().commandHelp()};
  for (const Manipulator& manipulator : found.shape().manipulators) {
    std::string line = "manipulator " + manipulator.name;
    for (const ManipulatorState& state : manipulator.states) line += " " + state.name;
    lines.push_back(line);
  }
  return lines;
}

void ServedSimulation::reset(std::optional<std::uint64_t> seed) {
  Simulation::Config config = config_;
  if (seed) config.seed = *seed;
  auto fresh = std::make_unique<SceneRun>(scene_, config, factory_);
  run_ = std::move(fresh);
  config_ = config;
  entered_ = scene_.robots.size();
  for (auto& [id, guest] : guests_) {
    try {
      enter(id, *guest);
    } catch (const std::exception&) {
      guest->robot = nullptr;  // no room for it this time: whoever commands it is told so
    }
  }
}

void ServedSimulation::placeRobot(RobotId robot, const Pose2& pose) {
  try {
    simulation().place(find(robot), pose);
  } catch (const std::invalid_argument& error) {
    throw ServeError("no-room", error.what());
  }
}

void ServedSimulation::placeObject(const std::string& object, const Pose2& pose) {
  const std::span<const Simulation::Thing> things = simulation().things();
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (things[i].name != object) continue;
    try {
      return simulation().placeThing(i, pose);
    } catch (const std::invalid_argument& error) {
      throw ServeError("no-room", error.what());
    }
  }
  throw ServeError("no-object", "this world has no movable object '" + object + "'");
}

}  // namespace ortung
