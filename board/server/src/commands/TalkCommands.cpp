// Messages between clients, and between robots of a team.
#include <algorithm>
#include <cmath>

#include "Caller.hpp"
#include "Request.hpp"
#include "RobotArguments.hpp"
#include "Rooms.hpp"

namespace ortung::server {
namespace {

void tellTeam(Caller& caller, Request& request) {
  std::string text = request.rest();
  RobotId teller = caller.client().robots.first();
  if (text.starts_with("robot=")) {
    const std::string number = text.substr(6, text.find(' ') - 6);
    teller =
        static_cast<RobotId>(parseNumber(number, "robot", 1.0, static_cast<double>(kLastRobot)));
    text = text.substr(std::min(text.size(), 6 + number.size() + 1));
  }
  if (teller == 0) throw ServeError("no-robot", "this client has no robot; CREATE makes one");
  caller.order(request.tag(),
               [id = caller.client().id, teller, text](WorldKeeper& keeper, WorldKeeper::Done&) {
                 keeper.checkOwner(id, teller);
                 keeper.world().tell(teller, text);
                 return Reply("OK TELL");
               });
}

void hearTeam(Caller& caller, Request& request) {
  const RobotId robot = takeRobot(caller, request);
  request.refuseRest();
  orderBody(
      caller, request.tag(),
      [id = caller.client().id, robot](WorldKeeper& keeper, std::string& lines) {
        keeper.checkOwner(id, robot);
        const std::vector<ServedTalk> talk = keeper.world().takeHeard(robot);
        for (const ServedTalk& one : talk)
          lines += std::to_string(one.stamp) + " " + oneWord(one.from) + " " + one.text + "\n";
        return "OK HEAR robot=" + std::to_string(robot) + " lines=" + std::to_string(talk.size());
      });
}

void sayToAll(Caller& caller, const std::string& tag, const std::string& text) {
  ClientState& client = caller.client();
  Host& host = caller.host();
  const Timestamp now = wallTime();
  const double wait = std::max(client.talk.wait(now), host.talk.wait(now));
  if (wait > 0.0) {
    caller.error(tag, "ERR limit that is too much talk for all who hear it; say it again in " +
                          std::to_string(std::lround(std::ceil(wait * 1e3))) + " ms");
    return;
  }
  const std::string line =
      "SAY client=" + std::to_string(client.id) + " name=" + client.name + " " + text;
  const auto listeners = static_cast<double>(host.listeners(client.id));
  const auto bytes = static_cast<double>(line.size());
  client.talk.spend(std::max(1.0, listeners), bytes * std::max(1.0, listeners));
  host.talk.spend(listeners, bytes * listeners);
  host.spread(client.id, line);
  caller.reply(tag, "OK SAY");
}

void say(Caller& caller, Request& request) {
  const std::string& text = request.rest();
  const std::size_t most = caller.host().config.limits.say;
  if (text.size() > most)
    throw ServeError("limit", "a text to SAY has at most " + std::to_string(most) + " bytes");
  caller.answer(request.tag(),
                [tag = request.tag(), text](Caller& its) { sayToAll(its, tag, text); });
}

}  // namespace

std::vector<Command> talkCommands() {
  return {{"TELL", Role::kPlayer, "[robot=N] TEXT to all others of the robot's team", tellTeam},
          {"HEAR", Role::kPlayer, "[robot=N], what others of its team have told", hearTeam},
          {"SAY", Role::kViewer, "TEXT to all other clients", say}};
}

}  // namespace ortung::server
