#include "SimStage.hpp"

#include <stdexcept>

namespace ortung {

void SimStage::look() const {
  if (seen_ == simulation_.now()) return;
  seen_ = simulation_.now();
  robots_.resize(simulation_.robots().size());
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const SimRobot& robot = *simulation_.robots()[i];
    StagedRobot& staged = robots_[i];
    staged.name = robot.config().name;
    staged.team = teamOf_(staged.name);
    staged.pose = robot.state().pose;
    staged.velocity = robot.state().velocity;
    staged.radius = robot.config().radius;
  }
  things_.resize(simulation_.things().size());
  for (std::size_t i = 0; i < things_.size(); ++i) {
    const Simulation::Thing& thing = simulation_.things()[i];
    things_[i].name = thing.name;
    things_[i].kind = thing.kind;
    things_[i].pose = thing.pose;
    things_[i].velocity = thing.velocity;
  }
}

std::span<const StagedRobot> SimStage::robots() const {
  look();
  return robots_;
}

std::span<const StagedThing> SimStage::things() const {
  look();
  return things_;
}

void SimStage::placeRobot(std::string_view robot, const Pose2& pose) {
  forget();
  for (const auto& one : simulation_.robots())
    if (one->config().name == robot) return simulation_.place(*one, pose);
  throw std::invalid_argument("there is no robot '" + std::string(robot) + "' to be placed");
}

void SimStage::placeThing(std::string_view thing, const Pose2& pose, const Twist& velocity) {
  forget();
  for (std::size_t i = 0; i < simulation_.things().size(); ++i)
    if (simulation_.things()[i].name == thing) return simulation_.placeThing(i, pose, velocity);
  throw std::invalid_argument("the world has no movable thing named '" + std::string(thing) +
                              "' to be placed");
}

}  // namespace ortung
