// What operators may do with the simulation.
#include "Conversation.hpp"

namespace ortung::server {
namespace {

using Reply = std::optional<std::string>;

constexpr double kFastest = 1000.0;  // times real time
constexpr std::int64_t kMostSteps = 1'000'000;
constexpr std::int64_t kLastRobot = 0xFFFFFFFF;

}  // namespace

void Conversation::pause(Request& request) {
  request.refuseRest();
  order(request.tag(), [](WorldKeeper& keeper, WorldKeeper::Done&) {
    keeper.pause();
    return Reply("OK PAUSE now=" + std::to_string(keeper.world().now()));
  });
}

void Conversation::resume(Request& request) {
  request.refuseRest();
  order(request.tag(), [](WorldKeeper& keeper, WorldKeeper::Done&) {
    keeper.resume();
    return Reply("OK RESUME now=" + std::to_string(keeper.world().now()));
  });
}

void Conversation::step(Request& request) {
  const auto cycles =
      static_cast<std::uint64_t>(request.takeInteger("cycles", 1, kMostSteps).value_or(1));
  request.refuseRest();
  order(
      request.tag(),
      [cycles](WorldKeeper& keeper, WorldKeeper::Done& done) {
        keeper.step(cycles, done);
        return Reply();  // when they are over
      },
      {}, true);
}

void Conversation::speed(Request& request) {
  const double factor =
      parseNumber(request.takeWord("a factor of real time"), "the speed", 0.0, kFastest);
  request.refuseRest();
  constexpr double kSlowest = 0.001;
  if (factor != 0.0 && factor < kSlowest)
    throw ServeError("number", "the speed is 0 (as fast as possible) or from 0.001 to 1000");
  order(request.tag(), [factor](WorldKeeper& keeper, WorldKeeper::Done&) {
    keeper.setSpeed(factor);
    return Reply("OK SPEED");
  });
}

void Conversation::seek(Request& request) {
  constexpr double kLatest = 1e9;  // [s]
  const auto time = request.takeNumber("time_s", 0.0, kLatest);
  request.refuseRest();
  if (!time) throw ServeError("syntax", "SEEK needs time_s");
  order(request.tag(), [time](WorldKeeper& keeper, WorldKeeper::Done&) {
    keeper.seek(fromSeconds(*time));
    return Reply("OK SEEK now=" + std::to_string(keeper.world().now()));
  });
}

void Conversation::reset(Request& request) {
  const auto seed = request.takeSeed();
  request.refuseRest();
  order(
      request.tag(),
      [seed](WorldKeeper& keeper, WorldKeeper::Done&) {
        keeper.reset(seed);
        return Reply("OK RESET now=" + std::to_string(keeper.world().now()));
      },
      [](Conversation& self, const std::string& tag, const std::string& text) {
        self.host_.broadcast(self.id_, text.substr(3));  // "RESET now=..."
        self.reply(tag, text);
      });
}

void Conversation::place(Request& request) {
  const auto robot = request.takeInteger("robot", 1, kLastRobot);
  const auto object = request.takeText("object");
  const auto pose = request.takePose();
  request.refuseRest();
  if (!pose) throw ServeError("syntax", "PLACE needs x_m and y_m");
  if (robot.has_value() == object.has_value())
    throw ServeError("syntax", "PLACE needs robot= or object=");
  order(request.tag(), [robot, object, pose](WorldKeeper& keeper, WorldKeeper::Done&) {
    if (robot) keeper.world().placeRobot(static_cast<RobotId>(*robot), *pose);
    if (object) keeper.world().placeObject(printable(*object), *pose);
    return Reply("OK PLACE");
  });
}

}  // namespace ortung::server
