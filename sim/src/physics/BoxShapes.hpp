#pragma once

#include <box2d/box2d.h>

#include <memory>
#include <span>
#include <vector>

#include "ortung/sim/Primitive.hpp"
#include "ortung/sim/Solids.hpp"

namespace ortung {

/// Returns shapes of the physics engine, in its units, that together fill a primitive. Polygons are
/// shrunk by the skin that the engine adds, so their faces are exact and only corners are slightly
/// rounded. Ellipses that are not circles become polygons of 48 corners. Any primitive whose sizes
/// (of a triangle: heights) are above 0 is allowed, however thin.
/// @param origin origin of their body [m]; the nearer it is, the more precise are the shapes
std::vector<std::unique_ptr<b2Shape>> boxShapesOf(const Primitive& primitive,
                                                  const Point2& origin = {});
/// Returns the shape of a wall.
std::unique_ptr<b2Shape> boxShapeOf(const WallSegment& wall, const Point2& origin);

/// Returns a primitive whose outline is shrunk by @p depth [m], but at most by half its size.
Primitive drawnIn(const Primitive& primitive, double depth);

/// Returns the pieces of a body without those that lie within another one and behave like it: they
/// have no effect.
std::vector<Primitive> withoutHidden(std::span<const Primitive> pieces);

/// Area, centre of mass and moment of inertia of shapes of uniform density.
struct Bulk {
  double area = 0.0;     ///< area [m^2]
  Point2 centre;         ///< centre of mass [m]
  double inertia = 0.0;  ///< moment of inertia around the centre of mass, per mass [m^2]
};
/// Returns the bulk of some pieces; overlaps count twice. @pre there are pieces
Bulk bulkOf(std::span<const Primitive> pieces);

}  // namespace ortung
