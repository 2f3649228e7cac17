#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

struct Point2 {
  double x = 0.0;  ///< [m]
  double y = 0.0;  ///< [m]
};

/// An upright box around something, in the field frame [m].
struct Box2 {
  double xLow = 0.0, xHigh = 0.0, yLow = 0.0, yHigh = 0.0;
};

/// A shape on the floor, extruded in z. A line (kind "line") is flat: neither rays nor bodies meet
/// it.
struct Primitive {
  enum class Shape { rectangle, ellipse, triangle };

  Shape shape = Shape::rectangle;
  Point2 centre;                    ///< of a triangle: its centroid
  double halfX = 0.0;               ///< half the size along its own x axis [m]; not of triangles
  double halfY = 0.0;               ///< half the size along its own y axis [m]; not of triangles
  double angle = 0.0;               ///< of its own x axis in the field [rad]
  std::array<Point2, 3> corners{};  ///< of a triangle
  double zLow = 0.0;                ///< [m]
  double zHigh = 1.0;               ///< [m]
  double stroke = 0.0;   ///< of a line along an ellipse: its width [m]; 0: a filled shape
  double arcFrom = 0.0;  ///< of a line along an ellipse: where it begins, from its own x axis [rad]
  double arcTo = 0.0;    ///< of a line along an ellipse: where it ends, from its own x axis [rad]
  std::string kind;      ///< "wall", "post", ...
  std::string colour;    ///< "blue", "#0000ff" or empty
  std::string name;      ///< anything, or empty
  std::optional<std::uint32_t> identity;

  bool isNet = false;  ///< cameras look through it; rays and bodies meet a wall

  bool isMovable = false;             ///< a body of its own, or part of the world
  double mass = 0.0;                  ///< of what is movable [kg]
  std::optional<double> friction;     ///< against other bodies; none: the world's
  std::optional<double> restitution;  ///< against other bodies; none: the world's

  bool isSolid() const { return kind != "line"; }
  bool isCircle() const { return shape == Shape::ellipse && halfX == halfY; }
};

/// Distance of a point to the filled shape [m]; 0 inside and on its edge.
ORTUNG_API double distanceTo(const Primitive& primitive, const Point2& point);

ORTUNG_API Box2 boundsOf(const Primitive& primitive);

/// Greatest distance of the shape from the origin of its frame [m], or a little more.
ORTUNG_API double reachOf(const Primitive& primitive);

/// Height of the highest of them [m]; 0 for none.
ORTUNG_API double topOf(std::span<const Primitive> primitives);

/// The corners of a rectangle or triangle, in order.
ORTUNG_API std::vector<Point2> cornersOf(const Primitive& primitive);

/// The primitive in a frame of its own, whose origin is its middle and whose x axis is along its
/// own.
ORTUNG_API Primitive inOwnFrame(Primitive primitive);

}  // namespace ortung
