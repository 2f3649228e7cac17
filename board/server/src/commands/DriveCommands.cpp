// Commands that drive robots.
#include <stdexcept>

#include "Caller.hpp"
#include "Request.hpp"
#include "RobotArguments.hpp"
#include "Rooms.hpp"

namespace ortung::server {
namespace {

constexpr double kMostSpeed = 1e3;  ///< limit of commands [m/s, rad/s]; drives have their own

/// Executes an order; if the robot refuses it, the error has the given code.
template <class Order>
void refusedAs(const char* code, const Order& order) {
  try {
    order();
  } catch (const std::invalid_argument& error) {
    throw ServeError(code, error.what());
  }
}

void velocity(Caller& caller, Request& request) {
  const auto v = request.takeNumber("v_m_s", -kMostSpeed, kMostSpeed);
  const auto w = request.takeNumber("w_rad_s", -kMostSpeed, kMostSpeed);
  const RobotId robot = takeRobot(caller, request);
  request.refuseRest();
  if (!v && !w) throw ServeError("syntax", "VELOCITY needs v_m_s or w_rad_s");
  caller.order(request.tag(),
               [id = caller.client().id, robot, v, w](WorldKeeper& keeper, WorldKeeper::Done&) {
                 RobotCommands& commands = keeper.commands(id, robot);
                 if (v) commands.setTranslationalVelocity(*v);
                 if (w) commands.setRotationalVelocity(*w);
                 return Reply("OK VELOCITY");
               });
}

void motion(Caller& caller, Request& request) {
  const RobotId robot = takeRobot(caller, request);
  std::vector<double> command;
  for (const std::string& word : request.takeWords())
    command.push_back(parseNumber(word, "a number of the command", -kMostSpeed, kMostSpeed));
  request.refuseRest();
  if (command.empty()) throw ServeError("syntax", "MOTION needs numbers");
  caller.order(request.tag(),
               [id = caller.client().id, robot, command](WorldKeeper& keeper, WorldKeeper::Done&) {
                 RobotCommands& commands = keeper.commands(id, robot);
                 refusedAs("number", [&] { commands.setMotion(command); });
                 return Reply("OK MOTION");
               });
}

void manipulator(Caller& caller, Request& request) {
  const RobotId robot = takeRobot(caller, request);
  const std::string name = request.takeWord("the manipulator's name");
  const std::string state = request.takeWord("a state");
  request.refuseRest();
  if (!isName(name) || !isName(state))
    throw ServeError("syntax", "a manipulator and its state are 1 to 32 of [A-Za-z0-9_-]");
  caller.order(request.tag(), [id = caller.client().id, robot, name, state](WorldKeeper& keeper,
                                                                            WorldKeeper::Done&) {
    RobotCommands& commands = keeper.commands(id, robot);
    refusedAs("no-manipulator", [&] { commands.setManipulator(name, state); });
    return Reply("OK MANIPULATOR");
  });
}

}  // namespace

std::vector<Command> driveCommands() {
  return {
      {"VELOCITY", Role::kPlayer, "[v_m_s=V] [w_rad_s=W] [robot=N]", velocity},
      {"MOTION", Role::kPlayer, "NUMBER ... [robot=N], the motion plugin's own command", motion},
      {"MANIPULATOR", Role::kPlayer, "NAME STATE [robot=N]", manipulator}};
}

}  // namespace ortung::server
