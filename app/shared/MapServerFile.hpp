#pragma once

#include <filesystem>

#include "WorldGrid.hpp"

namespace ortung::app {

/// Writes a map as map_server has it: a description and, beside it, a grey picture of the same name
/// (.pgm). @throws std::runtime_error
void writeMapServer(const WorldGrid& grid, const std::filesystem::path& yaml);

}  // namespace ortung::app
