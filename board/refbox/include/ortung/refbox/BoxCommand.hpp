#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"

namespace ortung::refbox {

/// A message of a referee box: `{"command": "KICKOFF", "targetTeam": "224.16.32.10"}`.
struct BoxCommand {
  std::string command;     ///< the box's word, e.g. "KICKOFF", without blanks around it
  std::string targetTeam;  ///< address of a team; "": both
  /// Number of the robot that is meant; nothing: the whole team.
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

/// Translates a command for a referee: into an order (docs/referee.md), or "" if there is nothing
/// to do. Returns nothing, and @p why gets the reason, if the command is unknown or does not say
/// for which team it is.
ORTUNG_API std::optional<std::string> orderOf(const BoxCommand& command, const BoxTeams& teams,
                                              std::string& why);

}  // namespace ortung::refbox
