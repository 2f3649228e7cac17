#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"

namespace ortung::refbox {

/// What a referee box says: `{"command": "KICKOFF", "targetTeam": "224.16.32.10"}`.
struct BoxCommand {
  std::string command;     ///< the box's word, e.g. "KICKOFF", without blanks around it
  std::string targetTeam;  ///< address of a team; "": both
  std::optional<std::int64_t> robot;
};

/// Reads one message, without its NUL byte. @param why gets the reason if it is none
ORTUNG_API std::optional<BoxCommand> readBoxCommand(std::string_view message, std::string& why);

/// How a referee calls the two teams, and the box the one of the client.
struct BoxTeams {
  std::string own = "blue";
  std::string other = "yellow";
  std::string address;  ///< address of the own team; "": not known yet
};

/// What a command means to a referee: an order (docs/referee.md), "" if there is nothing to do, or
/// nothing, and @p why says why, if it is unknown or nobody can tell for which team it is.
ORTUNG_API std::optional<std::string> orderOf(const BoxCommand& command, const BoxTeams& teams,
                                              std::string& why);

}  // namespace ortung::refbox
