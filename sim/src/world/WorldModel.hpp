#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "GridMap.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/sim/PhysicsConfig.hpp"
#include "ortung/sim/Primitive.hpp"
#include "ortung/sim_api/World.hpp"
#include "ortung/tables/Building.hpp"

namespace ortung {

/// The content of a world file.
struct WorldModel {
  std::string name;
  PhysicsConfig physics;
  Box2 bounds;                        ///< bounds of the field, which robots can't leave
  std::vector<Primitive> primitives;  ///< the fixed primitives
  std::vector<Primitive> movables;    ///< the movable primitives at their initial poses
  std::vector<GridBody> grids;
  std::vector<Landmark> landmarks;  ///< primitives with an identity, and marks without a body
  Building building;                ///< its floors, if it has any
  std::vector<Box2> floorBounds;    ///< bounds of each floor, which robots can't leave
};

/// Reads a world file and the maps that it names, or a grid map as a world. @throws ConfigError
WorldModel readWorldModel(const std::filesystem::path& file);
/// Reads a world file that was parsed before. @param folder folder of its maps @throws ConfigError
WorldModel readWorldModel(const Parameters& toml, const std::string& name,
                          const std::filesystem::path& folder);

/// Returns the lines painted on the floor, as sensors see them.
std::vector<FieldLine> linesOf(const WorldModel& world);
/// Returns a body at its place in the world, as sensors see it.
WorldObject objectOf(const Primitive& primitive);
/// Returns pieces in the frame of their body, as sensors see them.
std::vector<WorldPiece> worldPiecesOf(std::span<const Primitive> pieces);

/// Returns a digest of 16 hexadecimal digits over shapes, kinds, colours, heights, grids, landmarks
/// and bounds of everything fixed, independent of order and names; of floors with their names and
/// of lifts, which tables hold, too. Moving bodies are left out, since tables do not contain them.
/// Lengths are rounded to micrometres, so that rounding errors do not matter.
std::string fingerprintOf(const WorldModel& world);

}  // namespace ortung
