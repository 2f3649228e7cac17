// Commands that describe the world, its field, its robots and players.
#include "Caller.hpp"
#include "Request.hpp"
#include "RobotArguments.hpp"
#include "Rooms.hpp"
#include "ortung/server/DescribeText.hpp"

namespace ortung::server {
namespace {

void addLine(std::string& lines, std::size_t& count, const std::string& line) {
  lines += line + '\n';
  ++count;
}

void describeWorld(Caller& caller, const std::string& tag) {
  std::string lines;
  std::size_t count = 0;
  for (const std::string& line : worldText(caller.host().description)) addLine(lines, count, line);
  caller.answer(tag, [tag, lines, count](Caller& its) {
    its.reply(tag, "OK DESCRIBE lines=" + std::to_string(count), lines);
  });
}

/// Describes the field. Large maps have many walls, so the text is made on the world's thread and
/// sent at once.
void describeField(Caller& caller, const std::string& tag) {
  orderBody(caller, tag, [](WorldKeeper& keeper, std::string& lines) {
    std::size_t count = 0;
    for (const std::string& line : keeper.world().field())
      addLine(lines, count, printable(line, kLongestDescription));
    return "OK DESCRIBE lines=" + std::to_string(count);
  });
}

void describeKinds(Caller& caller, const std::string& tag, const std::vector<std::string>& kinds) {
  std::string lines;
  std::size_t count = 0;
  for (const std::string& line : kinds) addLine(lines, count, printable(line, kLongestDescription));
  const std::string head =
      count == 0 ? "OK DESCRIBE" : "OK DESCRIBE lines=" + std::to_string(count);
  caller.answer(tag, [tag, lines, head](Caller& its) { its.reply(tag, head, lines); });
}

void describeRobot(Caller& caller, const std::string& tag, RobotId robot) {
  orderBody(caller, tag, [robot](WorldKeeper& keeper, std::string& lines) {
    std::size_t count = 0;
    const std::vector<std::string> abilities =
        robot == 0 ? std::vector<std::string>() : keeper.world().abilities(robot);
    for (const std::string& line : robotText(keeper.readings(robot)->features(), abilities))
      addLine(lines, count, line);
    return "OK DESCRIBE lines=" + std::to_string(count);
  });
}

void describe(Caller& caller, Request& request) {
  const std::string what = request.takeWord("world, field, robot, robots or players");
  if (what == "world" || what == "field" || what == "players" || what == "robots") {
    request.refuseRest();
    if (what == "world") describeWorld(caller, request.tag());
    if (what == "field") describeField(caller, request.tag());
    if (what == "players") describeKinds(caller, request.tag(), caller.host().players);
    if (what == "robots") describeKinds(caller, request.tag(), caller.host().robotKinds);
    return;
  }
  if (what != "robot")
    throw ServeError("syntax", "DESCRIBE knows world, field, robot, robots and players");
  const RobotId robot = takeRobot(caller, request, true);
  request.refuseRest();
  describeRobot(caller, request.tag(), robot);
}

}  // namespace

std::vector<Command> describeCommands() {
  return {{"DESCRIBE", Role::kViewer, "world|field|robot|robots|players [robot=N]", describe}};
}

}  // namespace ortung::server
