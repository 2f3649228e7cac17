// The state of the world, and the lists of what is in it.
#include "Caller.hpp"
#include "Request.hpp"
#include "Rooms.hpp"

namespace ortung::server {
namespace {

void time(Caller& caller, Request& request) {
  request.refuseRest();
  const std::string received = std::to_string(caller.host().keeper.clock().at(caller.received()));
  caller.answer(request.tag(), [tag = request.tag(), received](Caller& its) {
    const Timestamp sent = its.host().keeper.clock().at(wallTime());
    its.reply(tag, "OK TIME received=" + received + " sent=" + std::to_string(sent));
  });
}

void status(Caller& caller, Request& request) {
  request.refuseRest();
  caller.order(request.tag(), [](WorldKeeper& keeper, WorldKeeper::Done&) {
    const BoardStatistics statistics = keeper.statistics();
    return Reply("OK STATUS state=" + keeper.stateText() +
                 " now=" + std::to_string(keeper.clock().at(wallTime())) +
                 " cycles=" + std::to_string(statistics.cycles) +
                 " missed=" + std::to_string(statistics.missedCycles) +
                 " clients=" + std::to_string(statistics.clients) +
                 " robots=" + std::to_string(statistics.robots) + keeper.paceText());
  });
}

using Lines = std::vector<std::string>;

Lines clientLines(const WorldKeeper& keeper) {
  Lines lines;
  for (const auto& [id, client] : keeper.clients())
    lines.push_back("client=" + std::to_string(id) + " name=" + client.name +
                    " robots=" + std::to_string(client.robots.size()) +
                    " lockstep=" + (client.isLockstep ? "on" : "off"));
  return lines;
}

Lines robotLines(WorldKeeper& keeper) {
  Lines lines;
  for (const auto& [id, robot] : keeper.robots())
    lines.push_back("robot=" + std::to_string(id) + " name=" + robot.readings->name() +
                    " client=" + std::to_string(robot.owner) + keeper.world().side(id));
  return lines;
}

Lines linesOf(const std::string& what, WorldKeeper& keeper, const Host& host) {
  if (what == "worlds") return {"world=" + oneWord(host.description.name)};
  if (what == "clients") return clientLines(keeper);
  if (what == "robots") return robotLines(keeper);
  Lines lines;
  for (const std::string& plugin : host.plugins) lines.push_back("plugin=" + plugin);
  return lines;
}

void list(Caller& caller, Request& request) {
  const std::string what = request.takeWord("worlds, plugins, clients or robots");
  request.refuseRest();
  if (what != "worlds" && what != "plugins" && what != "clients" && what != "robots")
    throw ServeError("syntax", "LIST knows worlds, plugins, clients and robots");
  orderBody(caller, request.tag(),
            [what, host = &caller.host()](WorldKeeper& keeper, std::string& body) {
              const Lines lines = linesOf(what, keeper, *host);
              for (const std::string& line : lines) body += line + '\n';
              return "OK LIST lines=" + std::to_string(lines.size());
            });
}

}  // namespace

std::vector<Command> worldCommands() {
  return {{"TIME", Role::kViewer, "the clock of the stamps when this came and when the reply left",
           time},
          {"STATUS", Role::kViewer, "how the world is doing", status},
          {"LIST", Role::kViewer, "worlds|plugins|clients|robots", list}};
}

}  // namespace ortung::server
