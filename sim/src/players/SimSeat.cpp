#include "SimSeat.hpp"

#include <utility>

namespace ortung {
namespace {

/// Greatest number of messages that wait for a player; older ones are lost.
constexpr std::size_t kMostHeard = 1000;

RobotAbilities abilitiesOf(const SimRobot& robot) {
  RobotAbilities abilities;
  abilities.radius = robot.config().radius;
  abilities.height = robot.shape().top();
  abilities.limits = robot.drive().limits();
  abilities.motionKind = robot.drive().kind();
  abilities.motionHelp = robot.drive().commandHelp();
  for (const Manipulator& manipulator : robot.shape().manipulators) {
    RobotAbilities::Manipulator one{manipulator.name, {}};
    for (const ManipulatorState& state : manipulator.states) one.states.push_back(state.name);
    abilities.manipulators.push_back(std::move(one));
  }
  return abilities;
}

}  // namespace

void keepHeard(std::vector<Heard>& waiting, const Heard& message) {
  if (waiting.size() == kMostHeard) waiting.erase(waiting.begin());
  waiting.push_back(message);
}

SimSeat::SimSeat(SimRobot& robot, std::string team, const FieldModel& field, Stage* stage,
                 std::shared_ptr<const FieldRegion> region, const Random& random,
                 std::function<void(std::string_view)> say)
    : robot_(robot),
      name_(robot.config().name),
      team_(std::move(team)),
      field_(field),
      stage_(stage),
      taught_{robot.config().mcl, robot.config().motion, std::move(region)},
      random_(random),
      say_(std::move(say)),
      abilities_(abilitiesOf(robot)) {}

}  // namespace ortung
