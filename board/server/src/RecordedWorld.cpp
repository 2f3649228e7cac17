#include "ortung/server/RecordedWorld.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "Request.hpp"
#include "ortung/server/CallArguments.hpp"

namespace ortung {
namespace {

using Kind = Recordings::State::Kind;

std::vector<SensorId> idsOf(std::span<const ServedFeature> features) {
  std::vector<SensorId> ids;
  for (const ServedFeature& feature : features) ids.push_back(feature.id);
  return ids;
}

FeatureFormats formatsOf(std::span<const ServedFeature> features) {
  FeatureFormats formats;
  for (const ServedFeature& feature : features)
    if (!feature.format.empty()) formats.emplace_back(feature.id, parseFormat(feature.format));
  return formats;
}

std::string text(RobotId robot, const Recordings::State& state) {
  std::string line = "robot=" + std::to_string(robot) + " state=" + nameOf(state.kind);
  if (!state.file.empty())
    line += " file=" + state.file + " moments=" + std::to_string(state.moments);
  return line + (state.text.empty() ? "" : " " + state.text);
}

/// Returns the robot of the argument, or nothing if all are meant.
std::optional<RobotId> takeRobot(CallArguments& arguments, RecordedWorld& world) {
  const std::optional<std::string> said = arguments.takeText("robot");
  if (said == "all") return std::nullopt;
  if (said)
    return static_cast<RobotId>(
        server::parseNumber(*said, "robot", 1.0, std::numeric_limits<RobotId>::max()));
  const std::vector<RobotId> robots = world.robots();
  if (robots.size() != 1) throw ServeError("syntax", "RECORD needs robot=N or robot=all");
  return robots.front();
}

BoardCommand::Reply record(RecordedWorld& world, const BoardCommand::Call& call) {
  CallArguments arguments("RECORD", call);
  const std::optional<RobotId> robot = takeRobot(arguments, world);
  const std::vector<std::string> words = arguments.takeWords();
  arguments.refuseRest();
  if (words.size() > 1 || (words.size() == 1 && words[0] != "on" && words[0] != "off"))
    throw ServeError("syntax", "RECORD takes one of on and off");
  if (!words.empty() && call.role != BoardCommand::Role::kOperator)
    throw ServeError("role", "recording a robot needs the role operator");
  const auto obey = [&](RobotId one) {
    if (!words.empty() && words[0] == "on") world.begin(one);
    if (!words.empty() && words[0] == "off") world.end(one);
  };
  if (robot) {
    obey(*robot);
    return {text(*robot, world.state(*robot))};
  }
  BoardCommand::Reply reply{"robot=all"};
  const std::vector<RobotId> robots = world.robots();
  if (robots.empty()) throw ServeError("no-robot", "there is no robot");
  for (const RobotId one : robots) obey(one);
  for (const RobotId one : robots) reply.lines.push_back(text(one, world.state(one)));
  return reply;
}

}  // namespace

RecordedWorld::RecordedWorld(ServedWorld& world, Recordings& recordings, Config config)
    : ForwardedWorld(world), recordings_(recordings), config_(std::move(config)) {
  meetResidents();
}

RecordedWorld::~RecordedWorld() = default;

void RecordedWorld::meetResidents() {
  const std::uint64_t version = world().residentsVersion();
  if (version_ == version) return;
  version_ = version;
  const std::vector<Resident> residents = world().residents();
  std::erase_if(robots_, [&](const auto& entry) {
    const bool hasLeft = entry.second.isResident &&
                         std::none_of(residents.begin(), residents.end(), [&](const Resident& one) {
                           return one.robot == entry.first;
                         });
    if (hasLeft) recordings_.forget(entry.first);
    return hasLeft;
  });
  for (const Resident& resident : residents)
    robots_.try_emplace(resident.robot, Robot{resident.name, idsOf(resident.features),
                                              formatsOf(resident.features), true});
}

RecordedWorld::Robot& RecordedWorld::find(RobotId robot) {
  meetResidents();
  const auto found = robots_.find(robot);
  if (found == robots_.end())
    throw ServeError("no-robot", "there is no robot " + std::to_string(robot));
  return found->second;
}

// --- for the command

std::vector<RobotId> RecordedWorld::robots() {
  meetResidents();
  std::vector<RobotId> ids;
  for (const auto& [id, robot] : robots_) ids.push_back(id);
  return ids;
}

void RecordedWorld::begin(RobotId robot) {
  const Robot& its = find(robot);
  // The field of a running robot is unknown.
  recordings_.begin(robot, its.name, livePeriod() > 0 ? "" : describe().fingerprint, its.formats);
  if (config_.takesReadings) world().want(robot, its.features);
}

void RecordedWorld::end(RobotId robot) {
  const Robot& its = find(robot);
  const bool wasOn = recordings_.state(robot).kind != Kind::kOff;
  if (wasOn && config_.takesReadings) world().want(robot, its.wanted);
  recordings_.end(robot);
}

Recordings::State RecordedWorld::state(RobotId robot) {
  find(robot);
  return recordings_.state(robot);
}

// --- ServedWorld

void RecordedWorld::step() {
  world().step();
  meetResidents();
}

ServedRobot RecordedWorld::addRobot(RobotId robot, RobotWish wish) {
  std::string name = wish.name;
  ServedRobot served = world().addRobot(robot, std::move(wish));
  robots_[robot] = {std::move(name), idsOf(served.features), formatsOf(served.features)};
  return served;
}

void RecordedWorld::removeRobot(RobotId robot) {
  world().removeRobot(robot);
  robots_.erase(robot);
  recordings_.forget(robot);
}

std::string RecordedWorld::side(RobotId robot) const {
  const Recordings::State state = recordings_.state(robot);
  return world().side(robot) + (state.kind == Kind::kOff  ? ""
                                : state.kind == Kind::kOn ? " record=" + state.file
                                                          : " record=failed");
}

void RecordedWorld::want(RobotId robot, std::span<const SensorId> features) {
  const auto found = robots_.find(robot);
  if (found == robots_.end()) return world().want(robot, features);
  found->second.wanted.assign(features.begin(), features.end());
  if (!config_.takesReadings || recordings_.state(robot).kind != Kind::kOn)
    world().want(robot, features);
}

std::span<Message> RecordedWorld::readings(RobotId robot) {
  const std::span<Message> frame = world().readings(robot);
  if (!config_.takesReadings || frame.empty() || recordings_.state(robot).kind != Kind::kOn)
    return frame;
  recordings_.write(robot, frame, config_.also ? config_.also() : std::vector<Message>());
  return frame;
}

void RecordedWorld::seek(Timestamp stamp) {
  world().seek(stamp);
  recordings_.endAll();
}

void RecordedWorld::reset(std::optional<std::uint64_t> seed) {
  world().reset(seed);
  recordings_.endAll();
}

BoardCommand recordCommand(RecordedWorld& world) {
  return {.name = "RECORD",
          .help = "[robot=N|all] [on|off]: whether a robot's readings are written to a file",
          .handle = [&world](const BoardCommand::Call& call) { return record(world, call); }};
}

}  // namespace ortung
