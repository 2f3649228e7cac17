#include "Trace.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ortung/base/Angles.hpp"

namespace ortung::app {
namespace {

constexpr Timestamp kPeriod = 50'000;  // [us]

}  // namespace

void Trace::add(const Simulation& simulation) {
  if (simulation.now() + kPeriod < next_) next_ = simulation.now();  // it has started over
  if (simulation.now() < next_) return;
  next_ += kPeriod;
  for (const auto& robot : simulation.robots()) {
    std::string states;
    const auto& manipulators = robot->shape().manipulators;
    for (std::size_t i = 0; i < manipulators.size(); ++i)
      states += fmt::format("{}{}={}", i == 0 ? "" : ";", manipulators[i].name,
                            manipulators[i].states[robot->manipulatorStates()[i]].name);
    line(simulation.now(), "robot", robot->config().name, robot->state().pose,
         robot->state().velocity, states);
  }
  for (const Simulation::Thing& thing : simulation.things())
    line(simulation.now(), thing.kind, thing.name, thing.pose, thing.velocity, "");
  file_.write(text_);
  file_.publish();
  text_.clear();
}

void Trace::commit() {
  file_.write(text_);
  file_.commit();
}

void Trace::line(Timestamp now, const std::string& kind, std::string name, const Pose2& pose,
                 const Twist& velocity, const std::string& states) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ',' || c == '"' || c == '\n'; }, '_');
  text_ += fmt::format("{:.3f},{},{},{:.4f},{:.4f},{:.3f},{:.4f},{:.4f},{:.3f},{}\n",
                       toSeconds(now), kind, name, pose.x, pose.y, degrees(pose.theta), velocity.x,
                       velocity.y, degrees(velocity.theta), states);
}

}  // namespace ortung::app
