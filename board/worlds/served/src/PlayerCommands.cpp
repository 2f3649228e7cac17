#include "ortung/served/PlayerCommands.hpp"

#include <cmath>
#include <cstdint>
#include <string>

#include "ortung/base/Time.hpp"
#include "ortung/server/CallArguments.hpp"
#include "ortung/sim/PlayerWish.hpp"

namespace ortung {
namespace {

using Role = BoardCommand::Role;

constexpr std::int64_t kLastRobot = 0xFFFFFFFF;

/// What a client wants, as the text of a player. It names shipped robot files only, never a path.
PlayerWish wishOf(ServedSimulation& simulation, const BoardCommand::Call& call) {
  if (call.words.size() != 1)
    throw ServeError("argument", "PLAY names one plugin; HELP shows its arguments");
  if (const auto help = simulation.helpOf(call.words.front()))
    for (const PlayerOption& option : help->options())
      if (option.unit == "file" && call.keys.contains(option.key))
        throw ServeError("argument", option.key + " is a file, which clients can't name");
  std::string text = call.words.front();
  std::string team;
  char mark = ':';
  for (const auto& [key, value] : call.keys) {
    if (key == "robot" && value.find('/') != std::string::npos)
      throw ServeError("argument", "robot is '" + value + "', expected a name of a shipped file");
    if (key == "tables")
      throw ServeError("argument", "tables is a file of the server's, which no client names");
    if ((key + value).find_first_of("&@:") != std::string::npos)
      throw ServeError("argument", key + " is '" + value + "', which must not have &, @ or :");
    if (key == "team") {
      team = "@" + value;
      continue;
    }
    // Shipped robots are known by their names (DESCRIBE robots), with or without the file's ending.
    const bool isName = key == "robot" && !value.empty() && !value.ends_with(".toml");
    text += mark + key + "=" + value + (isName ? ".toml" : "");
    mark = '&';
  }
  return parsePlayer(text + team);
}

/// @throws ServeError if one more player would be too many
void checkRoom(ServedSimulation& simulation, const PlayLimits& limits) {
  const std::size_t robots = simulation.run().simulation().robots().size();
  if (robots >= limits.robots)
    throw ServeError("limit", "there are " + std::to_string(robots) +
                                  " robots on the field, at most " + std::to_string(limits.robots) +
                                  " are permitted with players that clients start");
  if (simulation.load() > limits.load)
    throw ServeError("limit", "a cycle takes " +
                                  std::to_string(std::lround(100.0 * simulation.load())) +
                                  " % of its time already, at most " +
                                  std::to_string(std::lround(100.0 * limits.load)) +
                                  " % are permitted when a player comes; STOP another one first");
}

BoardCommand::Reply eventsSince(const ServedSimulation& simulation, std::uint64_t since) {
  BoardCommand::Reply reply;
  for (const ServedSimulation::Event& event : simulation.events())
    if (event.number >= since)
      reply.lines.push_back(std::to_string(event.number) + " " + std::to_string(event.event.stamp) +
                            " " + toText(event.event));
  reply.words = "next=" + std::to_string(simulation.eventsSoFar());
  return reply;
}

}  // namespace

std::vector<BoardCommand> playerCommands(ServedSimulation& simulation, const PlayLimits& limits) {
  std::vector<BoardCommand> commands(7);
  commands[0] = {
      "PLAY", "PLUGIN [team=T] [name=N] [start=x,y,deg] [option=value ...]: starts a player",
      Role::kOperator, [&simulation, limits](const BoardCommand::Call& call) {
        checkRoom(simulation, limits);
        return BoardCommand::Reply{"robot=" + simulation.startPlayer(wishOf(simulation, call)), {}};
      }};
  commands[1] = {"STOP", "ROBOT: ends the player that plays it", Role::kOperator,
                 [&simulation](const BoardCommand::Call& call) {
                   if (call.words.size() != 1)
                     throw ServeError("argument", "STOP names one robot; PLAYERS lists them");
                   simulation.stopPlayer(call.words.front());
                   return BoardCommand::Reply{};
                 }};
  commands[2] = {"PLAYERS", "who plays", Role::kViewer, [&simulation](const BoardCommand::Call&) {
                   BoardCommand::Reply reply;
                   for (const PlayerControl::Seated& one : simulation.seated())
                     reply.lines.push_back("robot=" + one.robot + " player=" + one.plugin +
                                           (one.team.empty() ? "" : " team=" + one.team) +
                                           " since=" + std::to_string(one.since));
                   return reply;
                 }};
  commands[3] = {"REFEREE", "ORDER: e.g. start, stop, kick-off blue", Role::kOperator,
                 [&simulation](const BoardCommand::Call& call) {
                   std::string order;
                   for (const std::string& word : call.words)
                     order += (order.empty() ? "" : " ") + word;
                   simulation.orderReferee(order);
                   return BoardCommand::Reply{};
                 }};
  commands[4] = {"GAME", "how the game stands", Role::kViewer,
                 [&simulation](const BoardCommand::Call&) {
                   return BoardCommand::Reply{toText(simulation.game()), {}};
                 }};
  commands[5] = {"EVENTS", "[since=N]: what the referee has seen and decided", Role::kViewer,
                 [&simulation](const BoardCommand::Call& call) {
                   return eventsSince(simulation, sinceOf(call));
                 }};
  commands[6] = {"RETURN", "robot=N: gives a robot that was commanded back to its player",
                 Role::kOperator, [&simulation](const BoardCommand::Call& call) {
                   CallArguments arguments("RETURN", call);
                   const auto robot = arguments.takeInteger("robot", 1, kLastRobot);
                   arguments.refuseRest();
                   if (!robot) throw ServeError("no-robot", "robot=N is missing");
                   simulation.giveBack(static_cast<RobotId>(*robot));
                   return BoardCommand::Reply{"robot=" + std::to_string(*robot)};
                 }};
  return commands;
}

}  // namespace ortung
