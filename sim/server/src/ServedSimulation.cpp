#include "ortung/server/ServedSimulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "RobotPlugins.hpp"

namespace ortung {
namespace {

constexpr int kAttempts = 200;            // to find room for a robot on a crowded field
constexpr std::size_t kMostPlanners = 8;  // each keeps a plan of the floor for one radius

}  // namespace

struct ServedSimulation::Guest {
  RobotWish wish;
  SimRobot* robot = nullptr;  ///< the simulation's
  bool wanders = false;       ///< nobody has commanded it yet
};

ServedSimulation::ServedSimulation(std::filesystem::path worldFile,
                                   const Simulation::Config& config)
    : worldFile_(std::move(worldFile)),
      config_(config),
      factory_(PluginFactory::standardFolders()),
      plugins_(robotPlugins(factory_)),
      simulation_(std::make_unique<Simulation>(readWorld(worldFile_), config_)) {}

ServedSimulation::~ServedSimulation() = default;

WorldDescription ServedSimulation::describe() const {
  const SimWorld& world = simulation_->world();
  return {world.name(), world.fingerprint(), "simulation"};
}

const RoutePlanner& ServedSimulation::planner(double radius) {
  const auto known = planners_.find(radius);
  if (known != planners_.end()) return *known->second;
  if (planners_.size() >= kMostPlanners)
    throw ServeError("limit", "robots of " + std::to_string(kMostPlanners) +
                                  " different radii are here already; give a start, and do not "
                                  "ask for wandering");
  try {
    auto planner = std::make_unique<RoutePlanner>(simulation_->world(), radius);
    return *planners_.emplace(radius, std::move(planner)).first->second;
  } catch (const std::invalid_argument& error) {
    throw ServeError("no-room", error.what());
  }
}

/// Clients name their robots as they like, so two of them may like the same.
bool ServedSimulation::isTaken(const std::string& name) const {
  const auto robots = simulation_->robots();
  return std::any_of(robots.begin(), robots.end(),
                     [&](const auto& robot) { return robot->config().name == name; });
}

SimRobot& ServedSimulation::enter(RobotId robot, Guest& guest) {
  RobotConfig config = guest.wish.config;
  if (isTaken(config.name)) config.name += "-" + std::to_string(robot);
  // Two streams a robot: where it begins, and where it wanders.
  const std::uint64_t stream = 2 * entered_;
  Random placing = simulation_->random(stream);
  for (int attempt = 1; guest.robot == nullptr; ++attempt) {
    const bool anywhere = !guest.wish.start || attempt > 1;
    const Pose2 start = anywhere ? planner(config.radius).randomPose(placing) : *guest.wish.start;
    try {
      guest.robot = &simulation_->addRobot(config, factory_, start);
    } catch (const std::invalid_argument& error) {
      const bool isRestart = guests_.contains(robot);  // its old start may be taken now
      if ((!anywhere && !isRestart) || attempt == kAttempts)
        throw ServeError("no-room", error.what());
    }
  }
  ++entered_;
  guest.wanders = guest.wish.wanders;
  if (guest.wanders)
    guest.robot->setDriver(makeWanderer(planner(config.radius), guest.robot->drive().limits(),
                                        simulation_->random(stream + 1)));
  return *guest.robot;
}

std::vector<ServedFeature> ServedSimulation::addRobot(RobotId robot, RobotWish wish) {
  auto guest = std::make_unique<Guest>();
  guest->wish = std::move(wish);
  if (guest->wish.wanders) planner(guest->wish.config.radius);  // before the robot is there
  SimRobot& entered = enter(robot, *guest);
  guests_[robot] = std::move(guest);
  std::vector<ServedFeature> features;
  for (const std::unique_ptr<SensorData>& data : entered.container().all())
    features.push_back({data->id(), data->wordsHelp()});
  return features;
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

SimRobot& ServedSimulation::commanded(RobotId robot) {
  SimRobot& found = find(robot);
  Guest& its = guest(robot);
  if (its.wanders) found.setDriver(nullptr);
  its.wanders = false;
  return found;
}

void ServedSimulation::removeRobot(RobotId robot) {
  const Guest& leaving = guest(robot);
  if (leaving.robot != nullptr) simulation_->removeRobot(*leaving.robot);
  guests_.erase(robot);
}

std::span<const Message> ServedSimulation::readings(RobotId robot) const {
  const SimRobot* wanted = guest(robot).robot;
  const auto robots = simulation_->robots();
  for (std::size_t i = 0; i < robots.size(); ++i)
    if (robots[i].get() == wanted) return simulation_->readings(i);
  return {};
}

void ServedSimulation::setTranslationalVelocity(RobotId robot, double metresPerSecond) {
  commanded(robot).drive().setTranslationalVelocity(metresPerSecond);
}

void ServedSimulation::setRotationalVelocity(RobotId robot, double radiansPerSecond) {
  commanded(robot).drive().setRotationalVelocity(radiansPerSecond);
}

void ServedSimulation::setMotion(RobotId robot, std::span<const double> command) {
  const Drive& drive = find(robot).drive();
  if (command.size() != drive.commandSize())
    throw ServeError("number",
                     "found " + std::to_string(command.size()) + " numbers, this drive expects " +
                         std::to_string(drive.commandSize()) + ": " + drive.commandHelp());
  commanded(robot).drive().setCommand(command);
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

void ServedSimulation::setManipulator(RobotId robot, const std::string& manipulator,
                                      const std::string& state) {
  SimRobot& found = find(robot);
  for (const Manipulator& one : found.shape().manipulators) {
    if (one.name != manipulator) continue;
    for (std::size_t i = 0; i < one.states.size(); ++i) {
      if (state != one.states[i].name && state != std::to_string(i)) continue;
      commanded(robot).setManipulator(manipulator, one.states[i].name);
      return;
    }
    std::string names;
    for (const ManipulatorState& known : one.states) names += " " + known.name;
    throw ServeError("no-manipulator", "manipulator " + manipulator + " has the states" + names +
                                           " (0 to " + std::to_string(one.states.size() - 1) + ")");
  }
  throw ServeError("no-manipulator", "robot " + std::to_string(robot) + " (" +
                                         guest(robot).wish.name + ") has no manipulator '" +
                                         manipulator + "'");
}

void ServedSimulation::reset(std::optional<std::uint64_t> seed) {
  Simulation::Config config = config_;
  if (seed) config.seed = *seed;
  auto fresh = std::make_unique<Simulation>(readWorld(worldFile_), config);
  planners_.clear();  // they know the old world
  simulation_ = std::move(fresh);
  config_ = config;
  entered_ = 0;
  for (auto& [id, guest] : guests_) guest->robot = nullptr;
  for (auto& [robot, guest] : guests_) enter(robot, *guest);
}

void ServedSimulation::placeRobot(RobotId robot, const Pose2& pose) {
  try {
    simulation_->place(find(robot), pose);
  } catch (const std::invalid_argument& error) {
    throw ServeError("no-room", error.what());
  }
}

void ServedSimulation::placeObject(const std::string& object, const Pose2& pose) {
  const std::span<const Simulation::Thing> things = simulation_->things();
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (things[i].name != object) continue;
    try {
      return simulation_->placeThing(i, pose);
    } catch (const std::invalid_argument& error) {
      throw ServeError("no-room", error.what());
    }
  }
  throw ServeError("no-object", "this world has no movable object '" + object + "'");
}

}  // namespace ortung
