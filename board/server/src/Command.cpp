#include "Command.hpp"

#include <algorithm>
#include <array>

#include "Rooms.hpp"

namespace ortung::server {
namespace {

constexpr std::array<const char*, 3> kRoles = {"viewer", "player", "operator"};

}  // namespace

const char* nameOf(Role role) { return kRoles[static_cast<std::size_t>(role)]; }

std::optional<Role> roleOf(std::string_view name) {
  const auto found = std::find(kRoles.begin(), kRoles.end(), name);
  if (found == kRoles.end()) return std::nullopt;
  return static_cast<Role>(found - kRoles.begin());
}

CommandTable::CommandTable(const std::vector<BoardCommand>& added) {
  const auto enter = [&](std::vector<Command> room) {
    for (Command& command : room) commands_.push_back(std::move(command));
  };
  enter(helloCommands());
  enter(worldCommands());
  enter(describeCommands());
  enter(createCommands());
  enter(driveCommands());
  enter(readingCommands());
  enter(lockstepCommands());
  enter(talkCommands());
  enter(scoreCommands());
  enter(controlCommands());
  enter(sessionCommands());
  enter(addedCommands(added));
}

const Command* CommandTable::find(std::string_view name) const {
  const auto found = std::find_if(commands_.begin(), commands_.end(),
                                  [&](const Command& command) { return command.name == name; });
  return found == commands_.end() ? nullptr : &*found;
}

}  // namespace ortung::server
