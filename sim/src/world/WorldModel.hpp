#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "GridMap.hpp"
#include "ortung/sim/PhysicsConfig.hpp"
#include "ortung/sim/Primitive.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

/// Everything that a world file says.
struct WorldModel {
  std::string name;
  PhysicsConfig physics;
  Box2 bounds;                        ///< the field: robots stay within
  std::vector<Primitive> primitives;  ///< what does not move
  std::vector<Primitive> movables;    ///< where they are at the beginning
  std::vector<GridBody> grids;
  std::vector<Landmark> landmarks;  ///< of primitives with an identity, and marks without body
};

/// Reads a world file and the maps that it names. @throws ConfigError
WorldModel readWorldModel(const std::filesystem::path& file);

/// What sensors may see of lines painted on the floor.
std::vector<FieldLine> linesOf(const WorldModel& world);
/// What sensors may see of a body at its place in the world.
WorldObject objectOf(const Primitive& primitive);
/// What sensors may see of pieces in the frame of their body.
std::vector<WorldPiece> worldPiecesOf(std::span<const Primitive> pieces);

/// 16 hexadecimal digits over shapes, kinds, colours, heights, grids, landmarks and bounds,
/// whatever their order and names; of what
/// does not move alone, since tables know nothing else. Lengths count in micrometres, so that no
/// rounding shows.
std::string fingerprintOf(const WorldModel& world);

}  // namespace ortung
