#include "RobotArguments.hpp"

namespace ortung::server {

RobotId takeRobot(Caller& caller, Request& request, bool orWorld) {
  if (const auto robot = request.takeInteger("robot", orWorld ? 0 : 1, kLastRobot))
    return static_cast<RobotId>(*robot);
  const RobotId first = caller.client().robots.first();
  const RobotId robot = first != 0 ? first : caller.host().liveRobot;
  if (robot == 0) throw ServeError("no-robot", "this client has no robot; CREATE makes one");
  return robot;
}

Choice takeChoice(Caller& caller, Request& request, bool again) {
  Choice choice;
  choice.again = again;
  const std::string form = request.takeText("form").value_or("text");
  if (form != "text" && form != "binary")
    throw ServeError("syntax", "form is '" + printable(form) + "', expected text or binary");
  choice.binary = form == "binary";
  const std::vector<std::string> words = request.takeWords();
  const std::size_t most = caller.host().config.limits.queries;
  if (words.size() > most)
    throw ServeError("limit", "a request has at most " + std::to_string(most) + " queries");
  for (const std::string& word : words) choice.queries.emplace_back(word);
  return choice;
}

}  // namespace ortung::server
