// Commands that send readings of robots: once, or whenever they come.
#include "Caller.hpp"
#include "Request.hpp"
#include "RobotArguments.hpp"
#include "Rooms.hpp"
#include "SentReadings.hpp"

namespace ortung::server {
namespace {

constexpr double kLongestPeriod = 3600.0;  // [s]
constexpr std::int64_t kMostAhead = 1000;
constexpr std::size_t kMostSubscriptions = 64;

/// Refuses to show players the readings of opponents; a live robot has no opponents.
void checkMayWatch(Caller& caller, RobotId robot) {
  const ClientState& client = caller.client();
  if (client.role == Role::kPlayer && !client.robots.owns(robot) && caller.host().liveRobot == 0)
    throw ServeError("not-yours", "players see the readings of their own robots only");
}

/// Has the world's thread find a robot's readings, and passes them to @p then.
void orderReadings(
    Caller& caller, const std::string& tag, RobotId robot,
    std::function<void(Caller&, const std::string&, const std::shared_ptr<RobotReadings>&)> then) {
  auto found = std::make_shared<std::shared_ptr<RobotReadings>>();
  caller.order(
      tag,
      [robot, found](WorldKeeper& keeper, WorldKeeper::Done&) {
        *found = keeper.readings(robot);
        return Reply("");
      },
      [found, then = std::move(then)](Caller& its, const std::string& itsTag, const std::string&) {
        then(its, itsTag, *found);
      });
}

/// Sends the readings of another client's robot, which operators and viewers may see.
void foreignReadings(Caller& caller, const std::string& tag, const char* command, RobotId robot,
                     const Choice& choice) {
  checkMayWatch(caller, robot);
  orderReadings(caller, tag, robot,
                [robot, choice, command](Caller& its, const std::string& itsTag,
                                         const std::shared_ptr<RobotReadings>& readings) {
                  ClientState& client = its.client();
                  client.robots.watch(robot, readings);
                  sendReadings(its, itsTag, command, robot, choice);
                  if (!client.subscriptions.contains(robot))
                    client.robots.forget(robot);  // it may leave the field at any time
                });
}

void fetch(Caller& caller, Request& request, const char* command, bool again) {
  const RobotId robot = takeRobot(caller, request, true);
  const Choice choice = takeChoice(caller, request, again);
  request.refuseRest();
  if (!caller.client().robots.owns(robot)) {
    foreignReadings(caller, request.tag(), command, robot, choice);
    return;
  }
  caller.answer(request.tag(), [tag = request.tag(), command, robot, choice](Caller& its) {
    sendReadings(its, tag, command, robot, choice);
  });
}

void update(Caller& caller, Request& request) { fetch(caller, request, "UPDATE", false); }
void read(Caller& caller, Request& request) { fetch(caller, request, "READ", true); }

void subscribe(Caller& caller, Request& request) {
  Subscriptions::Wish wish;
  wish.period = fromSeconds(request.takeNumber("period_s", 0.0, kLongestPeriod).value_or(0.0));
  wish.ahead = request.takeInteger("ahead", 1, kMostAhead).value_or(0);
  const RobotId robot = takeRobot(caller, request, true);
  wish.choice = takeChoice(caller, request, false);
  request.refuseRest();
  checkMayWatch(caller, robot);
  orderReadings(
      caller, request.tag(), robot,
      [robot, wish](Caller& its, const std::string& tag,
                    const std::shared_ptr<RobotReadings>& readings) {
        Subscriptions& subscriptions = its.client().subscriptions;
        if (subscriptions.size() >= kMostSubscriptions && !subscriptions.contains(robot)) {
          its.error(tag, "ERR limit a client has at most " + std::to_string(kMostSubscriptions) +
                             " subscriptions");
          return;
        }
        its.client().robots.watch(robot, readings);
        subscriptions.begin(its, robot, wish);
        its.reply(tag, "OK SUBSCRIBE robot=" + std::to_string(robot));
      });
}

void unsubscribe(Caller& caller, Request& request) {
  const auto robot = request.takeInteger("robot", 0, kLastRobot);
  request.refuseRest();
  caller.answer(request.tag(), [tag = request.tag(), robot](Caller& its) {
    Subscriptions& subscriptions = its.client().subscriptions;
    if (robot)
      subscriptions.end(its, static_cast<RobotId>(*robot));
    else
      subscriptions.endAll(its);
    its.reply(tag, "OK UNSUBSCRIBE");
  });
}

/// Notes that the client has read an update, so that another one may be sent to it.
void got(Caller& caller, Request& request) {
  const RobotId robot = takeRobot(caller, request, true);
  request.refuseRest();
  caller.answer(request.tag(), [tag = request.tag(), robot](Caller& its) {
    its.reply(tag, "OK GOT");
    its.client().subscriptions.got(its, robot);
  });
}

}  // namespace

std::vector<Command> readingCommands() {
  return {{"UPDATE", Role::kViewer, "[MODEL/TYPE/FEATURE ...] [robot=N] [form=binary], what is new",
           update},
          {"READ", Role::kViewer, "the same, also what was sent before", read},
          {"SUBSCRIBE", Role::kViewer,
           "[period_s=S] [ahead=N] [MODEL/TYPE/FEATURE ...] [robot=N] [form=binary]", subscribe},
          {"UNSUBSCRIBE", Role::kViewer, "[robot=N]", unsubscribe},
          {"GOT", Role::kViewer, "[robot=N], an update was read: for SUBSCRIBE with ahead=N", got}};
}

}  // namespace ortung::server
