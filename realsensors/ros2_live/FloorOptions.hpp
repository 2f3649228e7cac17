#pragma once

#include <string>
#include <vector>

namespace ortung::ros2 {

/// Returns the world file (TOML) of a building whose floors are maps that share their frame's
/// coordinates, with lifts that stop on all floors.
/// @param floors NAME=MAP, the first one first; maps are named by their absolute paths
/// @param lifts NAME=X,Y or NAME=X,Y,RADIUS [m]
/// @throws std::invalid_argument naming the text that was not understood, and what was expected
std::string buildingToml(const std::vector<std::string>& floors,
                         const std::vector<std::string>& lifts);

}  // namespace ortung::ros2
