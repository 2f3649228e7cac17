// Clients, their robots, and which client may command which robot.
#include <algorithm>
#include <cmath>

#include "WorldKeeper.hpp"

namespace ortung::server {

WorldKeeper::Client& WorldKeeper::client(ClientId id) {
  const auto found = clients_.find(id);
  if (found == clients_.end()) throw ServeError("internal", "the client has left");
  return found->second;
}

void WorldKeeper::join(ClientId client, const std::string& name, bool isOperator) {
  clients_[client].name = name;
  clients_[client].isOperator = isOperator;
  clientCount_ = clients_.size();
}

void WorldKeeper::leave(ClientId client) {
  std::erase_if(seeks_, [&](const Seek& one) { return one.client == client; });
  const auto found = clients_.find(client);
  if (found == clients_.end()) return;
  for (const RobotId robot : found->second.robots) remove(robot);
  for (const auto& [robot, commander] : commanders_)
    if (commander == client) halt(robot);
  std::erase_if(commanders_, [&](const auto& entry) { return entry.second == client; });
  clients_.erase(found);
  clientCount_ = clients_.size();
  robotCount_ = robots_.size();
}

std::shared_ptr<RobotReadings> WorldKeeper::createRobot(ClientId owner, RobotWish wish) {
  Client& its = client(owner);
  if (its.robots.size() >= config_.limits.robots)
    throw ServeError("limit",
                     "a client has at most " + std::to_string(config_.limits.robots) + " robots");
  const RobotId robot = lastRobot_ + 1;
  const std::string name = wish.name;
  ServedRobot served = world_.addRobot(robot, std::move(wish));
  lastRobot_ = robot;
  try {
    checkLimits(served);
  } catch (...) {
    world_.removeRobot(robot);
    throw;
  }
  auto readings = std::make_shared<RobotReadings>(robot, name, std::move(served.features));
  its.robots.insert(robot);
  robots_[robot] = {owner, readings, served.raysPerSecond, served.raysAtOnce};
  robotCount_ = robots_.size();
  return readings;
}

void WorldKeeper::checkLimits(const ServedRobot& robot) const {
  const BoardLimits& limits = config_.limits;
  if (robot.features.size() > limits.features)
    throw ServeError("limit", "the robot has " + std::to_string(robot.features.size()) +
                                  " features, at most " + std::to_string(limits.features) +
                                  " are permitted");
  if (robot.raysPerSecond > limits.rays)
    throw ServeError(
        "limit", "the robot's sensors need " + std::to_string(std::llround(robot.raysPerSecond)) +
                     " rays a second, at most " + std::to_string(std::llround(limits.rays)) +
                     " are permitted: fewer beams, or longer periods");
  double perSecond = robot.raysPerSecond;
  double atOnce = robot.raysAtOnce;
  for (const auto& [id, other] : robots_) {
    perSecond += other.raysPerSecond;
    atOnce += other.raysAtOnce;
  }
  if (perSecond > limits.allRays || atOnce > limits.allRaysAtOnce)
    throw ServeError(
        "limit", "the sensors of all robots would need " + std::to_string(std::llround(perSecond)) +
                     " rays a second and " + std::to_string(std::llround(atOnce)) +
                     " at once, at most " + std::to_string(std::llround(limits.allRays)) + " and " +
                     std::to_string(std::llround(limits.allRaysAtOnce)) +
                     " are permitted: fewer beams, or come back when others have left");
}

void WorldKeeper::removeRobot(ClientId owner, RobotId robot) {
  checkOwner(owner, robot);
  remove(robot);
  client(owner).robots.erase(robot);
  robotCount_ = robots_.size();
}

void WorldKeeper::remove(RobotId robot) {
  world_.removeRobot(robot);
  const auto found = robots_.find(robot);
  found->second.readings->retire();
  robots_.erase(found);
}

/// Learns which robots the world has added or removed by itself.
void WorldKeeper::meetResidents() {
  const std::uint64_t version = world_.residentsVersion();
  if (residentsVersion_ == version) return;
  residentsVersion_ = version;
  std::set<RobotId> there;
  for (Resident& resident : world_.residents()) {
    there.insert(resident.robot);
    if (robots_.contains(resident.robot)) continue;
    lastRobot_ = std::max(lastRobot_, resident.robot);
    robots_[resident.robot] = {
        kNobody,
        std::make_shared<RobotReadings>(resident.robot, std::move(resident.name),
                                        std::move(resident.features)),
        0.0, 0.0};
  }
  std::erase_if(robots_, [&](const auto& entry) {
    const bool hasLeft = entry.second.owner == kNobody && !there.contains(entry.first);
    if (hasLeft) entry.second.readings->retire();
    return hasLeft;
  });
  robotCount_ = robots_.size();
}

void WorldKeeper::checkOwner(ClientId client, RobotId robot) const {
  const auto found = robots_.find(robot);
  if (found == robots_.end())
    throw ServeError("no-robot", "there is no robot " + std::to_string(robot));
  if (found->second.owner == kNobody)
    throw ServeError("not-yours", "robot " + std::to_string(robot) + " belongs to the world");
  if (found->second.owner != client)
    throw ServeError("not-yours", "robot " + std::to_string(robot) + " belongs to another client");
}

RobotCommands& WorldKeeper::commands(ClientId id, RobotId robot) {
  const auto found = robots_.find(robot);
  const bool isResident = found != robots_.end() && found->second.owner == kNobody;
  if (!isLive() && !(isResident && client(id).isOperator)) {
    checkOwner(id, robot);
    return world_.commands(robot);
  }
  if (!client(id).isOperator)
    throw ServeError("role", "commanding a running robot needs the role operator");
  RobotCommands& commands = world_.commands(robot);
  commanders_[robot] = id;
  return commands;
}

void WorldKeeper::haltCommanded() {
  for (const auto& [robot, commander] : commanders_) halt(robot);
  commanders_.clear();
}

/// Stops a robot. A simulated one leaves the field with its client; a live one must not drive on
/// without it.
void WorldKeeper::halt(RobotId robot) {
  try {
    RobotCommands& commands = world_.commands(robot);
    commands.setTranslationalVelocity(0.0);
    commands.setRotationalVelocity(0.0);
  } catch (const std::exception& error) {
    if (config_.log)
      config_.log("robot " + std::to_string(robot) +
                  " could not be stopped when its commander left: " + error.what());
  }
}

std::shared_ptr<RobotReadings> WorldKeeper::readings(RobotId robot) const {
  if (robot == 0 && truth_) return truth_;
  const auto found = robots_.find(robot);
  if (found == robots_.end())
    throw ServeError("no-robot", "there is no robot " + std::to_string(robot));
  return found->second.readings;
}

}  // namespace ortung::server
