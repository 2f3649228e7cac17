// The greeting, and which clients are let in.
#include "Caller.hpp"
#include "Request.hpp"
#include "Rooms.hpp"

namespace ortung::server {
namespace {

constexpr const char* kWrongToken = "ERR token it is missing or wrong";

struct Greeting {
  std::string tag;
  std::string name;
  std::string token;
  std::optional<Role> role;  ///< role that the client asks for; nothing: the greatest it may have
};

void join(Caller& caller, const Greeting& greeting) {
  Host& host = caller.host();
  const Role most = host.door.mayControl(greeting.name) ? Role::kOperator : Role::kPlayer;
  const Role role = greeting.role.value_or(most);
  if (role > most)
    throw ServeError("role", "'" + greeting.name + "' may not control; see --allow-control");
  ClientState& client = caller.client();
  client.name = greeting.name;
  client.role = role;
  client.hasJoined = true;
  caller.order(greeting.tag, [id = client.id, name = client.name, role, host = &host](
                                 WorldKeeper& keeper, WorldKeeper::Done&) {
    keeper.join(id, name, role == Role::kOperator);
    return Reply("OK HELLO ortung/1 client=" + std::to_string(id) + " role=" + nameOf(role) +
                 " kind=" + host->description.kind + " world=" + oneWord(host->description.name) +
                 " now=" + std::to_string(keeper.clock().at(wallTime())) +
                 " state=" + keeper.stateText());
  });
}

/// @param hasWaited whether the client was delayed already: then a wrong token is refused at once
void checkToken(Caller& caller, const Greeting& greeting, bool hasWaited) {
  Doorkeeper& door = caller.host().door;
  const std::string& peer = caller.outlet().peer();
  if (door.isRight(greeting.name, greeting.token)) {
    join(caller, greeting);
    return;
  }
  const Timestamp now = wallTime();
  door.refuse(peer, greeting.name, now);
  if (hasWaited) {
    caller.dismiss(kWrongToken);
    return;
  }
  caller.holdUntil(greeting.tag, now + door.pause(peer, now),
                   [](Caller& its) { its.dismiss(kWrongToken); });
}

Role parseRole(const std::string& text) {
  if (const auto role = roleOf(text)) return *role;
  throw ServeError("syntax", "a role is viewer, player or operator");
}

void hello(Caller& caller, Request& request) {
  if (caller.client().hasJoined) throw ServeError("state", "HELLO was said already");
  const std::string version = request.takeWord("the version of the protocol: HELLO ortung/1");
  if (version != "ortung/1")
    throw ServeError("version", "found '" + printable(version) + "', this server speaks ortung/1");
  Greeting greeting{.tag = request.tag(),
                    .name = request.takeText("name").value_or("guest"),
                    .token = request.takeText("token").value_or(""),
                    .role = {}};
  if (const auto role = request.takeText("role")) greeting.role = parseRole(*role);
  request.refuseRest();
  if (!isName(greeting.name))
    throw ServeError("syntax", "a client's name is 1 to 32 of [A-Za-z0-9_-]");
  const Timestamp pause = caller.host().door.pause(caller.outlet().peer(), caller.received());
  if (pause == 0) {
    checkToken(caller, greeting, false);
    return;
  }
  caller.holdUntil(greeting.tag, caller.received() + pause,
                   [greeting](Caller& its) { checkToken(its, greeting, true); });
}

}  // namespace

std::vector<Command> helloCommands() {
  return {{"HELLO", std::nullopt,
           "ortung/1 [name=NAME] [token=TOKEN] [role=viewer|player|operator]", hello}};
}

}  // namespace ortung::server
