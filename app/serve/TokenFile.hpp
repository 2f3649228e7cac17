#pragma once

#include <filesystem>
#include <vector>

#include "ortung/server/MessageBoard.hpp"

namespace ortung::app {

/// Reads lines 'NAME TOKEN' of a file; nothing if @p file is "". @throws std::runtime_error
std::vector<BoardToken> readTokens(const std::filesystem::path& file);

}  // namespace ortung::app
