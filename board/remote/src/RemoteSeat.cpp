#include "RemoteSeat.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "ortung/sim_api/PlayerGuard.hpp"

namespace ortung::remote {
namespace {

/// @throws std::invalid_argument
void checkNumber(const char* what, double value) {
  if (!std::isfinite(value))
    throw std::invalid_argument(std::string("commands ") + what + " of " + std::to_string(value) +
                                ", expected a finite number");
}

RobotAbilities abilitiesOf(const RobotDescription& description) {
  RobotAbilities abilities;
  abilities.radius = description.radius.value_or(0.0);
  abilities.height = description.height.value_or(0.0);
  abilities.limits.speed = description.maxTranslationalVelocity.value_or(0.0);
  abilities.limits.turn = description.maxRotationalVelocity.value_or(0.0);
  abilities.limits.acceleration = description.maxTranslationalAcceleration.value_or(0.0);
  abilities.limits.turnAcceleration = description.maxRotationalAcceleration.value_or(0.0);
  abilities.motionKind = description.motionKind;
  abilities.motionHelp = description.motion;
  for (const RobotDescription::Manipulator& manipulator : description.manipulators)
    abilities.manipulators.push_back({manipulator.name, manipulator.states});
  return abilities;
}

}  // namespace

template <class Command>
void Voice::tell(const Command& command) {
  try {
    command();
  } catch (const ConnectionLost&) {
    lost_ = std::current_exception();
    throw;
  }
}

void Voice::setTranslationalVelocity(double metresPerSecond) {
  checkNumber("a translational velocity", metresPerSecond);
  tell([&] { robot_.setTranslationalVelocity(metresPerSecond); });
}

void Voice::setRotationalVelocity(double radiansPerSecond) {
  checkNumber("a rotational velocity", radiansPerSecond);
  tell([&] { robot_.setRotationalVelocity(radiansPerSecond); });
}

void Voice::setMotion(std::span<const double> command) {
  for (const double number : command) checkNumber("a motion", number);
  tell([&] { robot_.setMotion(command); });
}

void Voice::setManipulator(std::string_view manipulator, std::string_view state) {
  tell([&] { robot_.setManipulator(manipulator, state); });
}

void Voice::say(std::string_view text) {
  tell([&] { robot_.tellTeam(std::string(text)); });
}

void Voice::rethrow() const {
  if (lost_) std::rethrow_exception(lost_);
}

RemoteSeat::RemoteSeat(RemoteRobot& robot, std::string name, std::string team, FieldModel field,
                       Taught taught, const Random& random)
    : robot_(robot),
      voice_(robot),
      name_(std::move(name)),
      team_(std::move(team)),
      field_(std::move(field)),
      taught_(std::move(taught)),
      random_(random),
      abilities_(abilitiesOf(robot.description())) {
  look();
}

void RemoteSeat::say(std::string_view text) {
  checkSaid(text);
  voice_.say(text);
}

void RemoteSeat::listen() {
  for (TeamWords& words : robot_.hearTeam())
    heard_.push_back({std::move(words.from), words.stamp, std::move(words.text)});
}

void RemoteSeat::watchGame() {
  if (!hasGame_) return;
  const std::string text = robot_.game();
  hasGame_ = !text.empty();
  if (!hasGame_) return;
  try {
    game_ = gameIn(text);
  } catch (const std::invalid_argument& error) {
    throw ConnectionLost(std::string("the server: ") + error.what());
  }
}

void RemoteSeat::look() { now_ = robot_.newest(); }

}  // namespace ortung::remote
