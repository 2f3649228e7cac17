#pragma once

#include <filesystem>
#include <string>

#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {

/// Returns what is wrong with a map, of which a world could not be made; "" if nothing is.
std::string whyNoWorld(const OccupancyGrid& map);

/// Writes a map as map_server does, and a world that consists of it: FILE.toml, FILE.yaml,
/// FILE.pgm.
/// @param file name of the world @pre whyNoWorld() is "" @throws std::runtime_error
void writeWorldOf(const OccupancyGrid& map, const std::filesystem::path& file);

}  // namespace ortung::ros2
