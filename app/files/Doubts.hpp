#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ortung/base/FileKind.hpp"

namespace ortung::app {

/// Returns what is permitted in a robot, world or scene file, but was most likely meant in another
/// unit: a sentence each, with file and line. Such values are no errors: there are large robots.
/// @param kind kRobot, kWorld or kScene; there are no doubts about other kinds
/// @throws ConfigError for what is no TOML
std::vector<std::string> doubtsOf(const std::filesystem::path& file, FileKind kind);

}  // namespace ortung::app
