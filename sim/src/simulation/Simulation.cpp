#include "ortung/sim/Simulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "LateReadings.hpp"
#include "Physics.hpp"
#include "ortung/base/Workers.hpp"

namespace ortung {
namespace {

// Random streams of the simulation's seed: robots have the first half, random() the second.
constexpr std::uint64_t kRobots = std::uint64_t{1} << 32;
constexpr std::uint64_t kOthers = std::uint64_t{1} << 63;

/// Greatest number of parts of all robots together: the cost of a cycle in which all robots push
/// each other grows with it.
constexpr std::size_t kMostParts = 2048;

constexpr double kKickReach = 0.03;  ///< distance from a kicker within which a ball is kicked [m]

std::string toText(const Pose2& pose) {
  return "(" + std::to_string(pose.x) + ", " + std::to_string(pose.y) + ")";
}

std::string describe(const Simulation::Thing& thing) {
  return thing.kind + (thing.name.empty() ? "" : " '" + thing.name + "'") + " at " +
         toText(thing.pose);
}

/// Returns the pieces of a robot in its current state.
std::vector<Primitive> piecesOf(const SimRobot& robot) {
  return robot.shape().piecesWith(robot.manipulatorStates());
}

Pose2 poseOf(const Primitive& primitive) {
  const bool hasAngle = primitive.shape != Primitive::Shape::kTriangle;
  return {primitive.centre.x, primitive.centre.y, hasAngle ? wrapAngle(primitive.angle) : 0.0};
}

}  // namespace

NoRoom::~NoRoom() = default;

void Simulation::Config::check() const {
  if (cycle && !(*cycle >= 1e-4 && *cycle <= 1.0))
    throw std::invalid_argument("Simulation::Config::cycle is " + std::to_string(*cycle) +
                                ", must be in [0.0001, 1] s");
  if (threads < 1 || threads > 256)
    throw std::invalid_argument("Simulation::Config::threads is " + std::to_string(threads) +
                                ", must be in [1, 256]");
}

Simulation::Simulation(std::unique_ptr<SimWorld> world, const Config& config)
    : config_(config), world_(std::move(world)), field_(world_->field()) {
  config_.check();
  cycle_ = fromSeconds(config_.cycle.value_or(world_->physics().cycle));
  physics_ = std::make_unique<Physics>(world_->physics(), world_->solids(), config_.likeVersion02);
  workers_ = std::make_unique<Workers>(config_.threads);
  if (config_.sensesWhenRead) late_ = std::make_unique<LateReadings>(*this);
  addThings();
}

Simulation::~Simulation() = default;

Random Simulation::random(std::uint64_t stream) const {
  return Random(config_.seed, kOthers + stream);
}

void Simulation::addThings() {
  for (const Primitive& movable : world_->movables()) {
    const Thing thing{movable.name, movable.kind, poseOf(movable), {}, movable.mass};
    const std::vector<Primitive> pieces{inOwnFrame(movable)};
    if (!fits(pieces, thing.pose, Physics::kNobody))
      throw std::invalid_argument(describe(thing) + " overlaps something or is off the field");
    const bool rolls = thing.kind == "ball";
    thingBodies_.push_back(physics_->add(
        pieces, {thing.mass, rolls ? Physics::Floor::kRolls : Physics::Floor::kSlides},
        thing.pose));
    thingNumbers_.push_back(
        world_->addBody({thing.kind, thing.name, movable.colour, pieces}, thing.pose));
    thingPieces_.push_back(pieces);
    things_.push_back(thing);
  }
}

void Simulation::checkEntry(const RobotConfig& config, const RobotShape& shape) const {
  std::size_t parts = shape.parts();
  for (const std::unique_ptr<SimRobot>& other : robots_) {
    if (other->config().name == config.name)
      throw std::invalid_argument("robot " + config.name +
                                  ": another robot has this name, expected one of its own");
    parts += other->shape().parts();
  }
  if (parts > kMostParts)
    throw std::invalid_argument("robot " + config.name + ": with its " +
                                std::to_string(shape.parts()) + " pieces all robots have " +
                                std::to_string(parts) + ", expected at most " +
                                std::to_string(kMostParts) + " (an ellipse counts 8)");
}

SimRobot& Simulation::addRobot(const RobotConfig& config, PluginFactory& factory,
                               const Pose2& start) {
  const RobotShape shape = RobotShape::read(config);
  checkEntry(config, shape);
  const std::vector<Primitive> pieces =
      shape.piecesWith(std::vector<std::size_t>(shape.manipulators.size(), 0));
  // Tested before its plugins are made, which takes long, since many places may be tried.
  if (!fits(pieces, start, Physics::kNobody))
    throw NoRoom("robot " + config.name + ": start " + toText(start) + " has no room for it");
  if (late_) late_->readAll();
  const Random random(config_.seed, kRobots * (added_ + 1));
  auto robot = std::make_unique<SimRobot>(config, factory, start, random, config_.noise);
  robot->container_.setField(field_);
  robot->state_.number = world_->addBody({"robot", config.name, shape.colour, pieces}, start);
  robotBodies_.push_back(physics_->add(pieces, {shape.mass, Physics::Floor::kDrives}, start));
  robots_.push_back(std::move(robot));
  readings_.emplace_back();
  ++added_;
  if (late_) late_->watch(*robots_.back());
  return *robots_.back();
}

void Simulation::removeRobot(const SimRobot& robot) {
  const auto found = std::find_if(robots_.begin(), robots_.end(),
                                  [&](const auto& other) { return other.get() == &robot; });
  if (found == robots_.end()) return;
  if (late_) late_->readAll();
  const auto place = found - robots_.begin();
  world_->removeBody(robot.state().number);
  physics_->remove(robotBodies_[static_cast<std::size_t>(place)]);
  robotBodies_.erase(robotBodies_.begin() + place);
  readings_.erase(readings_.begin() + place);
  robots_.erase(found);
}

/// Robots are in the order in which they were added, and so are their numbers.
SimRobot* Simulation::find(RobotNumber robot) const {
  const auto found = std::lower_bound(
      robots_.begin(), robots_.end(), robot,
      [](const auto& one, RobotNumber number) { return one->state().number < number; });
  return found != robots_.end() && (*found)->state().number == robot ? found->get() : nullptr;
}

std::span<Message> Simulation::newest(std::size_t robot) const {
  if (late_) late_->read(robot);
  return readings_[robot];
}

std::span<const Message> Simulation::readings(std::size_t robot) const { return newest(robot); }

std::span<const Message> Simulation::readingsOf(RobotNumber robot) const {
  for (std::size_t i = 0; i < robots_.size(); ++i)
    if (robots_[i]->state().number == robot) return newest(i);
  return {};
}

std::span<Message> Simulation::readingsOf(RobotNumber robot) {
  for (std::size_t i = 0; i < robots_.size(); ++i)
    if (robots_[i]->state().number == robot) return newest(i);
  return {};
}

void Simulation::move() {
  if (late_) late_->leave();
  moveManipulators();
  moveBodies();
  now_ += cycle_;
  if (config_.onProblem) tellProblems();
}

void Simulation::tellProblems() {
  for (const std::unique_ptr<SimRobot>& robot : robots_)
    for (; robot->problemsTold_ < robot->problems_.size(); ++robot->problemsTold_)
      config_.onProblem(robot->problems_[robot->problemsTold_]);
}

void Simulation::sense() {
  workers_->run(robots_.size(), [this](std::size_t i) {
    SimRobot& robot = *robots_[i];
    readings_[i] = robot.isRead() ? robot.sense(*world_, now_) : robot.postpone(*world_, now_);
  });
  if (late_) late_->remember();
}

void Simulation::moveManipulators() {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    SimRobot& robot = *robots_[i];
    bool changed = false;
    for (std::size_t m = 0; m < robot.shape().manipulators.size(); ++m)
      if (const auto state = robot.nextState(m, now_))
        changed = moveManipulator(i, m, *state) || changed;
    if (changed) world_->reshapeBody(robot.state().number, piecesOf(robot));
  }
}

/// Sets a manipulator to a state if there is room. @returns whether there was
bool Simulation::moveManipulator(std::size_t place, std::size_t manipulator, std::size_t state) {
  SimRobot& robot = *robots_[place];
  const std::size_t body = robotBodies_[place];
  const ManipulatorState& entered = robot.shape().manipulators[manipulator].states[state];
  std::vector<std::size_t> states(robot.manipulatorStates().begin(),
                                  robot.manipulatorStates().end());
  states[manipulator] = state;
  if (!physics_->reshape(body, robot.shape().piecesWith(states), entered.pieces)) return false;
  robot.enterState(manipulator, state, now_);
  if (entered.ballSpeed > 0.0) kick(robot, body, entered);
  return true;
}

/// Kicks balls in reach: they get the speed of the state, relative to the robot, in its direction,
/// and keep their speed across it. The robot gets the recoil.
void Simulation::kick(const SimRobot& robot, std::size_t body, const ManipulatorState& state) {
  const double angle = robot.state().pose.theta + state.direction;
  const Point2 towards{std::cos(angle), std::sin(angle)};
  for (std::size_t i = 0; i < things_.size(); ++i) {
    if (things_[i].kind != "ball") continue;
    if (!physics_->reaches(body, state.pieces, thingBodies_[i], kKickReach)) continue;
    const Pose2& ball = physics_->pose(thingBodies_[i]);
    const Twist is = physics_->velocity(thingBodies_[i]);
    const Twist own = physics_->velocity(body);
    const double dx = ball.x - robot.state().pose.x;
    const double dy = ball.y - robot.state().pose.y;
    const double seen =
        (is.x - own.x + own.theta * dy) * towards.x + (is.y - own.y - own.theta * dx) * towards.y;
    const double missing = state.ballSpeed - seen;
    if (missing <= 0.0) continue;
    const double impulse = missing * physics_->mass(thingBodies_[i]);
    physics_->hit(thingBodies_[i], {impulse * towards.x, impulse * towards.y}, {ball.x, ball.y});
    physics_->hit(body, {-impulse * towards.x, -impulse * towards.y}, {ball.x, ball.y});
  }
}

void Simulation::moveBodies() {
  const double dt = toSeconds(cycle_);
  for (std::size_t i = 0; i < robots_.size(); ++i)
    physics_->want(robotBodies_[i], robots_[i]->plan(now_, dt));
  physics_->step(dt);
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const std::size_t body = robotBodies_[i];
    robots_[i]->move(physics_->pose(body), physics_->velocity(body), physics_->wasDisturbed(body));
    const RobotState& state = robots_[i]->state();
    world_->moveBody(state.number, state.pose, state.velocity);
  }
  for (std::size_t i = 0; i < things_.size(); ++i) {
    things_[i].pose = physics_->pose(thingBodies_[i]);
    things_[i].velocity = physics_->velocity(thingBodies_[i]);
    world_->moveBody(thingNumbers_[i], things_[i].pose, things_[i].velocity);
  }
}

void Simulation::place(SimRobot& robot, const Pose2& pose) {
  const auto found = std::find_if(robots_.begin(), robots_.end(),
                                  [&](const auto& other) { return other.get() == &robot; });
  const std::size_t body = robotBodies_[static_cast<std::size_t>(found - robots_.begin())];
  const std::vector<Primitive> pieces = piecesOf(robot);
  if (!fits(pieces, pose, body))
    throw NoRoom("robot " + robot.config().name + ": there is no room at " + toText(pose));
  if (late_) late_->leave();
  robot.place(pose);
  physics_->place(body, pose);
  world_->moveBody(robot.state().number, pose);
}

void Simulation::setTeam(const SimRobot& robot, const std::string& team) {
  if (late_) late_->readAll();
  world_->markBody(robot.state().number, team);
}

void Simulation::placeThing(std::size_t thing, const Pose2& pose, const Twist& velocity) {
  Thing& moved = things_.at(thing);
  for (const double v : {velocity.x, velocity.y, velocity.theta})
    if (!(std::abs(v) <= 1000.0))
      throw std::invalid_argument(describe(moved) + ": its velocity is " + std::to_string(v) +
                                  ", expected at most 1000 m/s or rad/s");
  if (!fits(thingPieces_[thing], pose, thingBodies_[thing]))
    throw std::invalid_argument(describe(moved) + ": there is no room at " + toText(pose));
  if (late_) late_->leave();
  physics_->place(thingBodies_[thing], pose, velocity);
  moved.pose = pose;
  moved.velocity = velocity;
  world_->moveBody(thingNumbers_[thing], pose, velocity);
}

bool Simulation::fits(std::span<const Primitive> pieces, const Pose2& pose,
                      std::size_t self) const {
  // The physics tests collisions with bodies, but not whether the place is in the field.
  return isFinite(pose) && world_->isFree(pose.x, pose.y, {0.0, topOf(pieces)}) &&
         physics_->isFree(pieces, pose, self);
}

}  // namespace ortung
