#pragma once

#include <filesystem>

#include "ortung/base/NewFile.hpp"

namespace ortung::app {

/// Whether the file can be written later on, asked before long work begins.
/// @throws std::runtime_error naming the file if its folder is missing or closed to us
void checkOutput(const std::filesystem::path& file);

}  // namespace ortung::app
