#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "WorldModel.hpp"
#include "ortung/sim_api/Drawing.hpp"

namespace ortung {

/// The shapes of which all bodies are drawn, stretched and turned.
enum class UnitShape : std::uint8_t { kBox, kCylinder, kPrism, kBall };
inline constexpr std::size_t kUnitShapes = 4;

using Rgba = std::array<std::uint8_t, 4>;

/// A stretched unit shape: points p of the unit shape are moved to matrix * p + (x, y).
struct Instance {
  UnitShape shape = UnitShape::kBox;
  std::array<double, 4> matrix{1, 0, 0, 1};  ///< matrix, row by row
  double x = 0.0, y = 0.0;                   ///< position in the field frame [m]
  double zLow = 0.0, zHigh = 0.0;            ///< heights of bottom and top [m]
  double reach = 0.0;  ///< greatest distance of its points from (x, y, middle of z) [m]
  Rgba colour{};
  Rgba band{};  ///< colour of its upper part; alpha is that part's share of the height, of 255
  std::uint32_t thing = 0;  ///< its word in Traced::things
  bool isNet = false;       ///< whether cameras see through it
};

/// A corner of a piece of a line: drawn a little larger than the line, so that its edges can be
/// smooth at every distance. Relative to the scene's middle [m].
struct LineVertex {
  float x, y;              ///< point on the line's centre
  float acrossX, acrossY;  ///< direction to the left, with a length of about 1
  float endX, endY;        ///< direction out of the line at its ends; otherwise 0
  float side;              ///< side of the centre line, -1 or 1
  float half;              ///< half the line's width; below 0: the radius of a spot
  float along, length;     ///< distance from the line's beginning, and the line's length
  Rgba colour;
};

/// A vertex of a wall: position relative to the scene's middle, and normal.
struct WallVertex {
  std::array<float, 3> place;
  std::array<float, 3> normal;
};

/// A group of neighbouring pieces, which is left out if a camera does not see it.
struct Chunk {
  std::uint32_t first = 0;  ///< index of its first vertex
  std::uint32_t count = 0;
  double x = 0.0, y = 0.0, z = 0.0;  ///< its centre relative to the scene's middle [m]
  double reach = 0.0;                ///< greatest distance of its points from its centre [m]
};

/// Everything fixed in a world, ready to be drawn. Immutable.
struct StandingScene {
  Point2 middle;
  Box2 field;                     ///< bounds of the field relative to the middle
  bool isPitch = false;           ///< whether the floor has lines and is drawn as turf
  std::vector<LineVertex> lines;  ///< vertices of the lines, four per piece, in order around it
  std::vector<Chunk> lineChunks;  ///< one chunk per piece of a line
  std::vector<WallVertex> walls;  ///< triangles of the maps' walls
  std::vector<Chunk> wallChunks;
  std::vector<Instance> instances;
};

/// Prepares a world for drawing. @param objects the fixed objects, in the order of World::objects()
StandingScene standingScene(const WorldModel& world, std::span<const WorldObject> objects);

/// Adds the pieces of an object. @param place index of the object in World::objects()
void addInstances(const WorldObject& object, std::size_t place, std::vector<Instance>& instances);

/// Returns a colour as bytes; the fallback for an unknown colour.
Rgba rgbaOf(const std::string& colour, Rgba fallback);

/// The triangles of all unit shapes in a row, with x and y in [-1, 1] and z in [0, 1].
struct UnitMesh {
  std::vector<WallVertex> vertices;
  std::vector<std::uint16_t> corners;  ///< vertices of the triangles, three for each
  /// The corners of a shape are [first, first + count).
  std::array<std::uint32_t, kUnitShapes> first{};
  std::array<std::uint32_t, kUnitShapes> count{};
};
UnitMesh unitMesh();

}  // namespace ortung
