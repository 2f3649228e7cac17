#pragma once

#include <filesystem>
#include <vector>

#include "ortung/server/MessageBoard.hpp"

namespace ortung::app {

/// Lines 'NAME TOKEN' of a file; nothing if it is "". @throws std::runtime_error
std::vector<BoardToken> readTokens(const std::filesystem::path& file);

}  // namespace ortung::app
