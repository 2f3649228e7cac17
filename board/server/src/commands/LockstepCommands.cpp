// Commands of lockstep: the world goes on only as far as clients have asked for.
#include "Caller.hpp"
#include "Request.hpp"
#include "RobotArguments.hpp"
#include "Rooms.hpp"
#include "SentReadings.hpp"

namespace ortung::server {
namespace {

constexpr std::int64_t kMostCycles = 1'000'000;

void lockstep(Caller& caller, Request& request) {
  const std::string word = request.takeWord("on or off");
  request.refuseRest();
  if (word != "on" && word != "off")
    throw ServeError("syntax", "LOCKSTEP is '" + printable(word) + "', expected on or off");
  const ClientState& client = caller.client();
  if (word == "on" && caller.host().config.pace != Pace::kLockstep &&
      client.role != Role::kOperator)
    throw ServeError("role",
                     "LOCKSTEP makes all others wait: it needs a server started with "
                     "--lockstep, or the role operator");
  caller.order(request.tag(), [id = client.id, word](WorldKeeper& keeper, WorldKeeper::Done&) {
    keeper.setLockstep(id, word == "on");
    return Reply("OK LOCKSTEP " + word);
  });
}

void next(Caller& caller, Request& request) {
  const std::int64_t cycles = request.takeInteger("cycles", 1, kMostCycles).value_or(1);
  const ClientState& client = caller.client();
  const RobotId robot = client.robots.first() == 0 ? 0 : takeRobot(caller, request);
  const Choice choice = takeChoice(caller, request, false);
  request.refuseRest();
  caller.order(
      request.tag(),
      [id = client.id, cycles](WorldKeeper& keeper, WorldKeeper::Done& done) {
        keeper.next(id, static_cast<std::uint64_t>(cycles), done);
        return Reply();  // sent when the cycles are done
      },
      [robot, choice](Caller& its, const std::string& tag, const std::string&) {
        if (robot != 0)
          sendReadings(its, tag, "NEXT", robot, choice);
        else
          its.reply(tag, "OK NEXT now=" + std::to_string(its.host().keeper.clock().at(wallTime())) +
                             " lines=0");
      },
      true);
}

}  // namespace

std::vector<Command> lockstepCommands() {
  return {{"LOCKSTEP", Role::kPlayer, "on|off, the world waits for every NEXT of this client",
           lockstep},
          {"NEXT", Role::kPlayer, "[cycles=N] and as UPDATE; answered when they are over", next}};
}

}  // namespace ortung::server
