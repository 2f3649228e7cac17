#pragma once

#include <box2d/box2d.h>

#include <memory>
#include <span>
#include <vector>

#include "ortung/sim/Primitive.hpp"
#include "ortung/sim/Solids.hpp"

namespace ortung {

/// Shapes of the physics engine, in its units, that together fill a primitive. Faces are where they
/// should be: polygons are drawn in by the skin that the engine gives them, so only corners are a
/// little round. Ellipses that are no circles become polygons of 48 corners. Any primitive whose
/// sizes (of a triangle: heights) are above 0 will do, however thin.
/// @param origin of the body that they are for [m]; the nearer the more precise
std::vector<std::unique_ptr<b2Shape>> boxShapesOf(const Primitive& primitive,
                                                  const Point2& origin = {});
std::unique_ptr<b2Shape> boxShapeOf(const WallSegment& wall, const Point2& origin);

/// A primitive with its outline drawn in by @p depth [m], but at most by half its size.
Primitive drawnIn(const Primitive& primitive, double depth);

/// Pieces of one body without those that lie within another one of them and behave like it: they
/// change nothing.
std::vector<Primitive> withoutHidden(std::span<const Primitive> pieces);

/// Area, centre of mass and moment of inertia around it of shapes of even density.
struct Bulk {
  double area = 0.0;     ///< [m^2]
  Point2 centre;         ///< [m]
  double inertia = 0.0;  ///< over the mass, around the centre [m^2]
};
/// @pre there are pieces; what overlaps counts twice
Bulk bulkOf(std::span<const Primitive> pieces);

}  // namespace ortung
