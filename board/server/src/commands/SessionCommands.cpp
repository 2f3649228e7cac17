// The list of commands, and the end of a session.
#include "Caller.hpp"
#include "Request.hpp"
#include "Rooms.hpp"

namespace ortung::server {
namespace {

void help(Caller& caller, Request& request) {
  request.refuseRest();
  std::string lines;
  const std::vector<Command>& all = caller.host().commands.all();
  for (const Command& command : all)
    lines += command.name + (command.help.empty() ? "" : " ") + command.help + '\n';
  caller.answer(request.tag(), [tag = request.tag(), lines, count = all.size()](Caller& its) {
    its.reply(tag, "OK HELP lines=" + std::to_string(count), lines);
  });
}

void bye(Caller& caller, Request& request) {
  request.refuseRest();
  caller.answer(request.tag(), [tag = request.tag()](Caller& its) {
    its.reply(tag, "OK BYE");
    its.leave();
  });
}

}  // namespace

std::vector<Command> sessionCommands() {
  return {{"HELP", std::nullopt, "this list", help}, {"BYE", std::nullopt, "", bye}};
}

}  // namespace ortung::server
