#pragma once

#include <filesystem>
#include <string>

#include "ortung/sim/SimWorld.hpp"

namespace ortung::app {

/// Returns the text of a world file in which one grid map stands in place of everything solid that
/// stays where it is. Painted lines, landmarks and what is movable stay as they are.
/// @param file the world's file @param map name of the map beside the new file
std::string mendedWorld(const std::filesystem::path& file, const SimWorld& world,
                        const std::string& map);

}  // namespace ortung::app
