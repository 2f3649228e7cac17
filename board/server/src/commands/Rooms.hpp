#pragma once

#include <vector>

#include "Command.hpp"

/// The commands of the protocol by what they are about: a room is a source of this folder. A new
/// command stands in one of them, and in the table of docs/protocol.md.
namespace ortung::server {

std::vector<Command> helloCommands();
std::vector<Command> worldCommands();
std::vector<Command> describeCommands();
std::vector<Command> createCommands();
std::vector<Command> driveCommands();
std::vector<Command> readingCommands();
std::vector<Command> lockstepCommands();
std::vector<Command> talkCommands();
std::vector<Command> scoreCommands();
std::vector<Command> controlCommands();
std::vector<Command> sessionCommands();
/// Those of whoever hosts the board.
std::vector<Command> addedCommands(const std::vector<BoardCommand>& commands);

}  // namespace ortung::server
