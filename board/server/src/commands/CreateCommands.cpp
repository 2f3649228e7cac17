// Commands that add and remove robots of clients.
#include "Caller.hpp"
#include "Request.hpp"
#include "RobotArguments.hpp"
#include "Rooms.hpp"
#include "ortung/robot/NetworkRobot.hpp"

namespace ortung::server {
namespace {

using SharedWish = std::shared_ptr<RobotWish>;

RobotWish takeWish(Request& request) {
  RobotWish wish;
  wish.name = request.takeWord("a name for the robot");
  if (!isName(wish.name)) throw ServeError("syntax", "a robot's name is 1 to 32 of [A-Za-z0-9_-]");
  wish.start = request.takePose();
  const std::string drive = request.takeText("drive").value_or("commands");
  if (drive != "commands" && drive != "wander")
    throw ServeError("syntax", "drive is '" + printable(drive) + "', expected commands or wander");
  wish.wanders = drive == "wander";
  wish.team = request.takeText("team").value_or("");
  if (!wish.team.empty() && !isName(wish.team))
    throw ServeError("syntax", "a team is 1 to 32 of [A-Za-z0-9_-]");
  request.refuseRest();
  return wish;
}

void readRobotFile(RobotWish& wish, const std::string& text, const Host& host) {
  RobotConfig& config = wish.config;
  config = readNetworkRobot(text, "robot file", host.plugins);
  const std::size_t most = host.config.limits.sensors;
  if (config.sensors.size() > most)
    throw ServeError("limit", "the robot has " + std::to_string(config.sensors.size()) +
                                  " sensors, at most " + std::to_string(most) + " are permitted");
  config.name = wish.name;
}

void orderRobot(Caller& caller, const std::string& tag, const SharedWish& wish) {
  auto created = std::make_shared<std::shared_ptr<RobotReadings>>();
  caller.order(
      tag,
      [id = caller.client().id, wish, created](WorldKeeper& keeper, WorldKeeper::Done&) {
        *created = keeper.createRobot(id, std::move(*wish));
        return Reply("");
      },
      [created](Caller& its, const std::string& itsTag, const std::string&) {
        const RobotReadings& robot = **created;
        its.client().robots.add(*created);
        its.reply(itsTag, "OK CREATE robot=" + std::to_string(robot.robot()) +
                              " features=" + std::to_string(robot.features().size()));
      },
      true);
}

/// Adds a robot. A malicious robot file takes long to read, so another thread does that.
void create(Caller& caller, Request& request) {
  if (caller.host().liveRobot != 0)
    throw ServeError("live", "this is a running robot: no other can join it");
  auto wish = std::make_shared<RobotWish>(takeWish(request));
  caller.awaitText(request.tag(), [tag = request.tag(), wish](Caller& its, std::string text) {
    its.aside(
        tag,
        [wish, text = std::move(text), host = &its.host()] { readRobotFile(*wish, text, *host); },
        [tag, wish](Caller& self) { orderRobot(self, tag, wish); }, false);
  });
}

void remove(Caller& caller, Request& request) {
  const RobotId robot = takeRobot(caller, request);
  request.refuseRest();
  caller.order(
      request.tag(),
      [id = caller.client().id, robot](WorldKeeper& keeper, WorldKeeper::Done&) {
        keeper.removeRobot(id, robot);
        return Reply("");
      },
      [robot](Caller& its, const std::string& tag, const std::string&) {
        its.client().robots.remove(robot);
        its.client().subscriptions.end(its, robot);
        its.reply(tag, "OK REMOVE");
      },
      true);
}

}  // namespace

std::vector<Command> createCommands() {
  return {{"CREATE", Role::kPlayer,
           "NAME [x_m=X y_m=Y theta_deg=T] [drive=wander], then a robot file, then a line with a "
           "dot",
           create, true},
          {"REMOVE", Role::kPlayer, "[robot=N]", remove}};
}

}  // namespace ortung::server
