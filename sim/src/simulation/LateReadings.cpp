#include "LateReadings.hpp"

#include <algorithm>

namespace ortung {

void LateReadings::watch(SimRobot& robot) {
  robot.noiseByTime_ = true;
  robot.whenRead_ = [this, &robot] { catchUp(robot); };
}

void LateReadings::remember() {
  sensedAt_ = simulation_.now_;
  isThere_ = true;
  const auto& robots = simulation_.robots_;
  if (std::any_of(robots.begin(), robots.end(),
                  [&](const auto& robot) { return robot->hasPostponed(sensedAt_); }))
    fill(unusedMoment());
}

bool LateReadings::isNeeded(const Moment& moment) const {
  const auto& robots = simulation_.robots_;
  return std::any_of(robots.begin(), robots.end(),
                     [&](const auto& robot) { return robot->hasPostponed(moment.time); });
}

LateReadings::Moment& LateReadings::unusedMoment() {
  const auto unused = std::find_if(moments_.begin(), moments_.end(),
                                   [&](const auto& moment) { return !isNeeded(*moment); });
  if (unused != moments_.end()) return **unused;
  return *moments_.emplace_back(std::make_unique<Moment>());
}

void LateReadings::fill(Moment& moment) const {
  moment.time = simulation_.now_;
  moment.robots.resize(simulation_.robots_.size());
  for (std::size_t i = 0; i < moment.robots.size(); ++i) {
    const SimRobot& robot = *simulation_.robots_[i];
    Moment::Robot& one = moment.robots[i];
    one.state = robot.state_;
    one.motionData.assign(robot.state_.motionData.begin(), robot.state_.motionData.end());
    one.manipulators = robot.manipulatorStates_;
  }
  moment.things.resize(simulation_.things_.size());
  for (std::size_t i = 0; i < moment.things.size(); ++i)
    moment.things[i] = {simulation_.things_[i].pose, simulation_.things_[i].velocity};
}

/// Puts everything where it was at a moment.
/// @param isPresent whether drives still have the data of their states
void LateReadings::show(const Moment& moment, bool isPresent) {
  SimWorld& world = *simulation_.world_;
  for (std::size_t i = 0; i < moment.robots.size(); ++i) {
    SimRobot& robot = *simulation_.robots_[i];
    const Moment::Robot& one = moment.robots[i];
    robot.state_ = one.state;
    if (!isPresent) robot.state_.motionData = one.motionData;
    world.moveBody(one.state.number, one.state.pose, one.state.velocity);
    if (robot.manipulatorStates_ == one.manipulators) continue;
    robot.manipulatorStates_ = one.manipulators;
    world.reshapeBody(one.state.number, robot.shape().piecesWith(one.manipulators));
  }
  for (std::size_t i = 0; i < moment.things.size(); ++i)
    world.moveBody(simulation_.thingNumbers_[i], moment.things[i].pose, moment.things[i].velocity);
}

std::span<Message> LateReadings::senseAt(SimRobot& robot, Timestamp time) {
  SimWorld& world = *simulation_.world_;
  if (isThere_ && time == sensedAt_) return robot.sensePostponed(world, time);
  const auto then = std::find_if(moments_.begin(), moments_.end(),
                                 [&](const auto& moment) { return moment->time == time; });
  fill(present_);
  show(**then, false);
  const std::span<Message> readings = robot.sensePostponed(world, time);
  show(present_, true);
  return readings;
}

void LateReadings::read(std::size_t place) {
  SimRobot& robot = *simulation_.robots_[place];
  if (robot.hasPostponed(sensedAt_)) simulation_.readings_[place] = senseAt(robot, sensedAt_);
}

void LateReadings::catchUp(SimRobot& robot) {
  const auto& robots = simulation_.robots_;
  const auto found = std::find_if(robots.begin(), robots.end(),
                                  [&](const auto& one) { return one.get() == &robot; });
  // Older readings go into the container alone.
  std::vector<Message> older;
  std::swap(robot.frame_, older);
  for (auto time = robot.firstPostponed(); time && *time < sensedAt_; time = robot.firstPostponed())
    senseAt(robot, *time);
  std::swap(robot.frame_, older);
  if (found != robots.end()) read(static_cast<std::size_t>(found - robots.begin()));
}

void LateReadings::readAll() {
  for (const auto& robot : simulation_.robots_)
    if (!robot->isRead()) catchUp(*robot);
}

}  // namespace ortung
