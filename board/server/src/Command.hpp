#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/server/BoardCommand.hpp"

namespace ortung::server {

class Caller;
class Request;

using Role = BoardCommand::Role;

const char* nameOf(Role role);
std::optional<Role> roleOf(std::string_view name);

/// A command of the protocol.
struct Command {
  std::string name;
  std::optional<Role> least;  ///< least role that may use it; nothing: all, also before HELLO
  std::string help;           ///< its arguments and what it does; may be empty
  /// Called on the thread that talks to clients, so it must not wait: what the world has to do is
  /// for Caller::order(), what takes long for Caller::aside(). Throws ServeErrors to refuse it,
  /// before it has said or ordered anything.
  std::function<void(Caller& caller, Request& request)> handle;
  /// Whether a text follows, also behind a line that is refused, see Caller::awaitText().
  bool hasText = false;
};

/// All commands that a board knows, in the order of HELP.
class CommandTable {
 public:
  /// Those of the protocol, and behind them @p added ones of whoever hosts the board.
  explicit CommandTable(const std::vector<BoardCommand>& added = {});
  /// @returns null if there is none of this name
  const Command* find(std::string_view name) const;
  const std::vector<Command>& all() const { return commands_; }

 private:
  std::vector<Command> commands_;
};

}  // namespace ortung::server
