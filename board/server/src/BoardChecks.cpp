#include "BoardChecks.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "Command.hpp"
#include "Request.hpp"

namespace ortung::server {
namespace {

constexpr std::size_t kLongestName = 32;
constexpr std::size_t kLongestHelp = 200;

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

bool isCommandName(const std::string& name) {
  const auto isCapital = [](char c) { return c >= 'A' && c <= 'Z'; };
  return !name.empty() && name.size() <= kLongestName && isCapital(name.front()) &&
         std::all_of(name.begin(), name.end(),
                     [&](char c) { return isCapital(c) || (c >= '0' && c <= '9') || c == '_'; });
}

void checkCommands(const std::vector<BoardCommand>& commands) {
  const CommandTable protocol;
  std::set<std::string> names;
  for (const BoardCommand& command : commands) {
    const std::string which = "the command '" + printable(command.name) + "' ";
    if (!isCommandName(command.name))
      refuse(which + "must be of capitals, digits and '_', 1 to 32, beginning with a capital");
    if (protocol.find(command.name) != nullptr) refuse(which + "is one of the protocol's own");
    if (!names.insert(command.name).second) refuse(which + "is there twice");
    if (!command.handle) refuse(which + "has nobody who executes it");
    if (printable(command.help, kLongestHelp) != command.help)
      refuse(which + "has a help that is not one line of at most 200 printable characters");
  }
}

void checkTokens(const BoardConfig& config) {
  const auto& tokens = config.tokens;
  for (const BoardToken& token : tokens)
    if (token.token.size() < 8)
      refuse("the token of '" + token.name + "' has less than 8 characters");
  if (tokens.empty() || config.guests) return;
  for (const std::string& name : config.control)
    if (std::none_of(tokens.begin(), tokens.end(),
                     [&](const BoardToken& token) { return token.name == name; }) &&
        name != "*")
      refuse("'" + printable(name) +
             "' may control, but has no token of its own, and that of '*' does not let it in");
}

}  // namespace

void checkBoard(const BoardConfig& config, const ServedWorld& world) {
  checkTokens(config);
  if (!(config.speed >= 0.001 && config.speed <= 1000.0))
    refuse("the speed is " + std::to_string(config.speed) + ", must be in [0.001, 1000]");
  if (world.livePeriod() > 0 && (config.pace != Pace::kRealTime || config.speed != 1.0))
    refuse("a running robot is served in real time, at speed 1");
  for (const double share : {config.limits.slowShare, config.limits.seekShare})
    if (!(share > 0.0 && share <= 1.0))
      refuse("a share of the board's time is " + std::to_string(share) + ", must be in (0, 1]");
  checkCommands(config.commands);
}

}  // namespace ortung::server
