#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "GridMap.hpp"
#include "Primitive.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

/// Bodies that begin above this height do not hinder robots [m].
inline constexpr double kTallestRobot = 2.0;

/// Everything in a world that does not move.
struct WorldModel {
  std::string name;
  Box2 bounds;  ///< the field: robots stay within
  std::vector<Primitive> primitives;
  std::vector<GridBody> grids;
  std::vector<Landmark> landmarks;  ///< of primitives with an identity, and marks without body
};

/// Reads a world file and the maps that it names. @throws ConfigError
WorldModel readWorldModel(const std::filesystem::path& file);

/// 16 hexadecimal digits over shapes, kinds, colours, heights, grids, landmarks and bounds,
/// whatever their order and names. Lengths count in micrometres, so that no rounding shows.
std::string fingerprintOf(const WorldModel& world);

}  // namespace ortung
