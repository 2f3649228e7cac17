#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "WorldModel.hpp"
#include "ortung/sim_api/Drawing.hpp"

namespace ortung {

/// Shapes that are drawn again and again, stretched and turned.
enum class UnitShape : std::uint8_t { box, cylinder, prism, ball };
inline constexpr std::size_t kUnitShapes = 4;

using Rgba = std::array<std::uint8_t, 4>;

/// One stretched unit shape: (x, y) of the unit shape go to matrix * (x, y) + (x, y).
struct Instance {
  UnitShape shape = UnitShape::box;
  std::array<double, 4> matrix{1, 0, 0, 1};  ///< row by row
  double x = 0.0, y = 0.0;                   ///< in the field frame [m]
  double zLow = 0.0, zHigh = 0.0;            ///< [m]
  double reach = 0.0;                        ///< of all of it from (x, y, middle of z) [m]
  Rgba colour{};
  Rgba band{};              ///< of its upper part; alpha: the share of its height, of 255
  std::uint32_t thing = 0;  ///< as Sheet::things
  bool isNet = false;       ///< one looks through it
};

/// A corner of a piece of a line: drawn a little larger than the line, so that its edges can be
/// smooth at every distance. Relative to the scene's middle [m].
struct LineVertex {
  float x, y;              ///< of the line's middle
  float acrossX, acrossY;  ///< to the left, about of length 1
  float endX, endY;        ///< out of the line, at its ends; else 0
  float side;              ///< -1 or 1
  float half;              ///< half the line's width; below 0: the radius of a spot
  float along, length;     ///< of the way from the line's beginning
  Rgba colour;
};

/// What is drawn of a wall: its corner and normal, relative to the scene's middle.
struct WallVertex {
  std::array<float, 3> place;
  std::array<float, 3> normal;
};

/// Some pieces that lie together, for leaving out what a camera does not see.
struct Chunk {
  std::uint32_t first = 0;  ///< of vertices
  std::uint32_t count = 0;
  double x = 0.0, y = 0.0, z = 0.0;  ///< relative to the scene's middle [m]
  double reach = 0.0;                ///< of all of it from there [m]
};

/// All that stands in a world, as it is drawn. Immutable.
struct StandingScene {
  Point2 middle;
  Box2 field;                     ///< relative to the middle
  bool isPitch = false;           ///< it has lines: it is a field to play on
  std::vector<LineVertex> lines;  ///< four to a piece, in order around it
  std::vector<Chunk> lineChunks;  ///< the pieces
  std::vector<WallVertex> walls;  ///< triangles of maps
  std::vector<Chunk> wallChunks;
  std::vector<Instance> instances;
};

/// @param objects what stands, in the order of World::objects()
StandingScene standingScene(const WorldModel& world, std::span<const WorldObject> objects);

/// Adds what an object is made of. @param place of the object among World::objects()
void addInstances(const WorldObject& object, std::size_t place, std::vector<Instance>& instances);

/// Colours as bytes; the fallback for a colour that is none.
Rgba rgbaOf(const std::string& colour, Rgba fallback);

/// The unit shapes as triangles, one behind the other. x and y in [-1, 1], z in [0, 1]; normals
/// are those of the unit shape.
struct UnitMesh {
  std::vector<WallVertex> vertices;
  std::array<std::uint32_t, kUnitShapes> first{};
  std::array<std::uint32_t, kUnitShapes> count{};
};
UnitMesh unitMesh();

}  // namespace ortung
