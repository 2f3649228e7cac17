// Commands by which operators control the simulation.
#include "Caller.hpp"
#include "Request.hpp"
#include "RobotArguments.hpp"
#include "Rooms.hpp"

namespace ortung::server {
namespace {

constexpr double kFastest = 1000.0;  // speed as a multiple of real time
constexpr std::int64_t kMostSteps = 1'000'000;

void pause(Caller& caller, Request& request) {
  request.refuseRest();
  caller.order(request.tag(), [](WorldKeeper& keeper, WorldKeeper::Done&) {
    keeper.pause();
    return Reply("OK PAUSE now=" + std::to_string(keeper.world().now()));
  });
}

void resume(Caller& caller, Request& request) {
  request.refuseRest();
  caller.order(request.tag(), [](WorldKeeper& keeper, WorldKeeper::Done&) {
    keeper.resume();
    return Reply("OK RESUME now=" + std::to_string(keeper.world().now()));
  });
}

void step(Caller& caller, Request& request) {
  const auto cycles =
      static_cast<std::uint64_t>(request.takeInteger("cycles", 1, kMostSteps).value_or(1));
  request.refuseRest();
  caller.order(
      request.tag(),
      [cycles](WorldKeeper& keeper, WorldKeeper::Done& done) {
        keeper.step(cycles, done);
        return Reply();  // sent when the steps are done
      },
      {}, true);
}

void speed(Caller& caller, Request& request) {
  const double factor =
      parseNumber(request.takeWord("a factor of real time"), "the speed", 0.0, kFastest);
  request.refuseRest();
  constexpr double kSlowest = 0.001;
  if (factor != 0.0 && factor < kSlowest)
    throw ServeError("number", "the speed is 0 (as fast as possible) or from 0.001 to 1000");
  caller.order(request.tag(), [factor](WorldKeeper& keeper, WorldKeeper::Done&) {
    keeper.setSpeed(factor);
    return Reply("OK SPEED");
  });
}

void seek(Caller& caller, Request& request) {
  constexpr double kLatest = 1e9;  // [s]
  const auto time = request.takeNumber("time_s", 0.0, kLatest);
  request.refuseRest();
  if (!time) throw ServeError("syntax", "SEEK needs time_s");
  const auto question = std::make_shared<Question>();
  caller.order(
      request.tag(),
      [time, question, client = caller.client().id](WorldKeeper& keeper, WorldKeeper::Done& done) {
        keeper.seek(client, fromSeconds(*time), question, std::move(done));
        return Reply();  // sent when it has had its turn
      },
      {}, true, question);
}

void reset(Caller& caller, Request& request) {
  const auto seed = request.takeSeed();
  request.refuseRest();
  caller.order(
      request.tag(),
      [seed](WorldKeeper& keeper, WorldKeeper::Done&) {
        keeper.reset(seed);
        return Reply("OK RESET now=" + std::to_string(keeper.world().now()));
      },
      [](Caller& its, const std::string& tag, const std::string& text) {
        its.host().broadcast(its.client().id, text.substr(3));  // "RESET now=..."
        its.reply(tag, text);
      });
}

void place(Caller& caller, Request& request) {
  const auto robot = request.takeInteger("robot", 1, kLastRobot);
  const auto object = request.takeText("object");
  const auto pose = request.takePose();
  request.refuseRest();
  if (!pose) throw ServeError("syntax", "PLACE needs x_m and y_m");
  if (robot.has_value() == object.has_value())
    throw ServeError("syntax", "PLACE needs robot= or object=");
  caller.order(request.tag(), [robot, object, pose](WorldKeeper& keeper, WorldKeeper::Done&) {
    if (robot) keeper.world().placeRobot(static_cast<RobotId>(*robot), *pose);
    if (object) keeper.world().placeObject(printable(*object), *pose);
    return Reply("OK PLACE");
  });
}

}  // namespace

std::vector<Command> controlCommands() {
  return {{"PAUSE", Role::kOperator, "", pause},
          {"RESUME", Role::kOperator, "", resume},
          {"STEP", Role::kOperator, "[cycles=N] of a paused world", step},
          {"SPEED", Role::kOperator, "FACTOR of real time, 0: as fast as possible", speed},
          {"RESET", Role::kOperator, "[seed=N], the world starts over", reset},
          {"SEEK", Role::kOperator, "time_s=T, of a record's time line", seek},
          {"PLACE", Role::kOperator, "robot=N|object=NAME x_m=X y_m=Y [theta_deg=T]", place}};
}

}  // namespace ortung::server
