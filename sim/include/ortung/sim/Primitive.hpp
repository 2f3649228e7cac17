#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// A point in the plane.
struct Point2 {
  double x = 0.0;  ///< [m]
  double y = 0.0;  ///< [m]
};

/// An axis-aligned bounding box in the field frame [m].
struct Box2 {
  double xLow = 0.0, xHigh = 0.0, yLow = 0.0, yHigh = 0.0;
};

/// A shape on the floor, extruded in z. A line (kind "line") is flat: neither rays nor bodies meet
/// it.
struct Primitive {
  enum class Shape { kRectangle, kEllipse, kTriangle };

  Shape shape = Shape::kRectangle;
  Point2 centre;                    ///< its centre; a triangle's centroid
  double halfX = 0.0;               ///< half the size along its own x axis [m]; not of triangles
  double halfY = 0.0;               ///< half the size along its own y axis [m]; not of triangles
  double angle = 0.0;               ///< direction of its own x axis in the field frame [rad]
  std::array<Point2, 3> corners{};  ///< corners of a triangle
  double zLow = 0.0;                ///< height of its bottom [m]
  double zHigh = 1.0;               ///< height of its top [m]
  double stroke = 0.0;              ///< width of a line along an ellipse [m]; 0: a filled shape
  double arcFrom = 0.0;             ///< start of a line along an ellipse, from its own x axis [rad]
  double arcTo = 0.0;               ///< end of a line along an ellipse, from its own x axis [rad]
  std::string kind;                 ///< "wall", "post", ...
  std::string colour;               ///< "blue", "#0000ff" or empty
  std::string name;                 ///< any text, or empty
  std::optional<std::uint32_t> identity;  ///< its number if it is a landmark

  bool isNet = false;  ///< whether cameras see through it; rays and bodies meet it like a wall

  bool isMovable = false;             ///< whether it is a body of its own; otherwise it is fixed
  double mass = 0.0;                  ///< mass of a movable body [kg]
  std::optional<double> friction;     ///< coefficient against other bodies; none: the world's
  std::optional<double> restitution;  ///< restitution against other bodies; none: the world's

  bool isSolid() const { return kind != "line"; }
  bool isCircle() const { return shape == Shape::kEllipse && halfX == halfY; }
};

/// Returns the distance of a point from the filled shape [m]; 0 inside and on its edge.
ORTUNG_API double distanceTo(const Primitive& primitive, const Point2& point);

/// Returns the bounding box of a primitive.
ORTUNG_API Box2 boundsOf(const Primitive& primitive);

/// Returns an upper bound of the distance between the origin and any point of the shape [m], which
/// is tight or nearly so.
ORTUNG_API double reachOf(const Primitive& primitive);

/// Returns the height of the highest primitive [m]; 0 for none.
ORTUNG_API double topOf(std::span<const Primitive> primitives);

/// Returns the corners of a rectangle or triangle, in order.
ORTUNG_API std::vector<Point2> cornersOf(const Primitive& primitive);

/// Returns the primitive in its own frame, whose origin is its middle and whose x axis is its own x
/// axis.
ORTUNG_API Primitive inOwnFrame(Primitive primitive);

}  // namespace ortung
