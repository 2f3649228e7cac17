#include "ortung/sim/Simulation.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace ortung {
namespace {

// Streams of the simulation's seed: robots have the first half, random() the second.
constexpr std::uint64_t kRobots = std::uint64_t{1} << 32;
constexpr std::uint64_t kOthers = std::uint64_t{1} << 63;

std::string toText(const Pose2& pose) {
  return "(" + std::to_string(pose.x) + ", " + std::to_string(pose.y) + ")";
}

}  // namespace

void Simulation::Config::check() const {
  if (!(cycle >= 1e-4 && cycle <= 1.0))
    throw std::invalid_argument("Simulation::Config::cycle is " + std::to_string(cycle) +
                                ", must be in [0.0001, 1] s");
}

Simulation::Simulation(std::unique_ptr<SimWorld> world, const Config& config)
    : config_(config), world_(std::move(world)) {
  config_.check();
  cycle_ = fromSeconds(config_.cycle);
}

Simulation::~Simulation() = default;

Random Simulation::random(std::uint64_t stream) const {
  return Random(config_.seed, kOthers + stream);
}

SimRobot& Simulation::addRobot(const RobotConfig& config, PluginFactory& factory,
                               const Pose2& start) {
  if (!isFinite(start) || !fits(start, config.radius, nullptr))
    throw std::invalid_argument("robot " + config.name + ": start " + toText(start) +
                                " has no room for a robot of radius " +
                                std::to_string(config.radius) + " m");
  const Random random(config_.seed, kRobots * (added_ + 1));
  auto robot = std::make_unique<SimRobot>(config, factory, start, random, config_.noise);
  robot->setNumber(world_->addRobot(config.radius, robot->bodyHeight()));
  world_->moveRobot(robot->state().number, start);
  robots_.push_back(std::move(robot));
  readings_.emplace_back();
  ++added_;
  return *robots_.back();
}

void Simulation::removeRobot(const SimRobot& robot) {
  const auto found = std::find_if(robots_.begin(), robots_.end(),
                                  [&](const auto& other) { return other.get() == &robot; });
  if (found == robots_.end()) return;
  world_->removeRobot(robot.state().number);
  readings_.erase(readings_.begin() + (found - robots_.begin()));
  robots_.erase(found);
}

void Simulation::step() {
  for (std::size_t i = 0; i < robots_.size(); ++i) readings_[i] = robots_[i]->sense(*world_, now_);
  const double dt = toSeconds(cycle_);
  for (const std::unique_ptr<SimRobot>& robot : robots_) {
    const Pose2 planned = robot->plan(now_, dt);
    if (fits(planned, robot->config().radius, robot.get()))
      robot->move();
    else
      robot->block();
    world_->moveRobot(robot->state().number, robot->state().pose);
  }
  now_ += cycle_;
}

void Simulation::place(SimRobot& robot, const Pose2& pose) {
  if (!isFinite(pose) || !fits(pose, robot.config().radius, &robot))
    throw std::invalid_argument("robot " + robot.config().name + ": there is no room at " +
                                toText(pose));
  robot.place(pose);
  world_->moveRobot(robot.state().number, pose);
}

bool Simulation::fits(const Pose2& pose, double radius, const SimRobot* self) const {
  if (!world_->isFree(pose.x, pose.y, radius)) return false;
  for (const std::unique_ptr<SimRobot>& other : robots_)
    if (other.get() != self &&
        distance(pose, other->state().pose) < radius + other->config().radius)
      return false;
  return true;
}

}  // namespace ortung
