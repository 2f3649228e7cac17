// Makes the lines and bodies that sensors see from a world's primitives.
#include <algorithm>
#include <cmath>

#include "WorldModel.hpp"

namespace ortung {
namespace {

FieldLine straight(const Point2& from, const Point2& to, double width, const std::string& colour) {
  FieldLine line;
  line.x0 = from.x;
  line.y0 = from.y;
  line.x1 = to.x;
  line.y1 = to.y;
  line.width = width;
  line.colour = colour;
  return line;
}

/// Returns the line of a rectangle, along its longer sides.
FieldLine lineOf(const Primitive& rectangle) {
  const bool isAlongX = rectangle.halfX >= rectangle.halfY;
  const double half = isAlongX ? rectangle.halfX : rectangle.halfY;
  const double angle = rectangle.angle + (isAlongX ? 0.0 : std::acos(0.0));
  const double dx = half * std::cos(angle);
  const double dy = half * std::sin(angle);
  return straight({rectangle.centre.x - dx, rectangle.centre.y - dy},
                  {rectangle.centre.x + dx, rectangle.centre.y + dy},
                  2.0 * (isAlongX ? rectangle.halfY : rectangle.halfX), rectangle.colour);
}

/// Returns the line of an ellipse. Its stroke lies within its size; a filled ellipse is all stroke.
FieldLine arcOf(const Primitive& ellipse) {
  const double smaller = std::min(ellipse.halfX, ellipse.halfY);
  const double width = ellipse.stroke > 0.0 ? std::min(ellipse.stroke, smaller) : smaller;
  FieldLine arc;
  arc.shape = FieldLine::Shape::kArc;
  arc.x = ellipse.centre.x;
  arc.y = ellipse.centre.y;
  arc.radiusX = ellipse.halfX - width / 2.0;
  arc.radiusY = ellipse.halfY - width / 2.0;
  arc.angle = ellipse.angle;
  arc.from = ellipse.arcFrom;
  arc.to = ellipse.arcTo;
  arc.width = width;
  arc.colour = ellipse.colour;
  return arc;
}

}  // namespace

std::vector<FieldLine> linesOf(const WorldModel& world) {
  std::vector<FieldLine> lines;
  for (const Primitive& primitive : world.primitives) {
    if (primitive.isSolid()) continue;
    if (primitive.shape == Primitive::Shape::kRectangle) lines.push_back(lineOf(primitive));
    if (primitive.shape == Primitive::Shape::kEllipse) lines.push_back(arcOf(primitive));
    if (primitive.shape != Primitive::Shape::kTriangle) continue;
    for (std::size_t i = 0; i < 3; ++i)
      lines.push_back(
          straight(primitive.corners[i], primitive.corners[(i + 1) % 3], 0.0, primitive.colour));
  }
  return lines;
}

std::vector<WorldPiece> worldPiecesOf(std::span<const Primitive> pieces) {
  std::vector<WorldPiece> seen;
  for (const Primitive& primitive : pieces) {
    WorldPiece& piece = seen.emplace_back();
    piece.colour = primitive.colour;
    piece.zLow = primitive.zLow;
    piece.zHigh = primitive.zHigh;
    piece.pose = {primitive.centre.x, primitive.centre.y, 0.0};
    if (primitive.shape == Primitive::Shape::kTriangle) {
      piece.shape = WorldPiece::Shape::kTriangle;
      for (std::size_t i = 0; i < 3; ++i)
        piece.corners[i] = {primitive.corners[i].x, primitive.corners[i].y};
      continue;
    }
    const bool isRound = primitive.shape == Primitive::Shape::kEllipse;
    piece.shape = isRound ? WorldPiece::Shape::kEllipse : WorldPiece::Shape::kRectangle;
    piece.pose.theta = wrapAngle(primitive.angle);
    piece.halfX = primitive.halfX;
    piece.halfY = primitive.halfY;
  }
  return seen;
}

WorldObject objectOf(const Primitive& primitive) {
  WorldObject object;
  object.kind = primitive.kind;
  object.name = primitive.name;
  object.colour = primitive.colour;
  object.pose = {primitive.centre.x, primitive.centre.y, wrapAngle(primitive.angle)};
  object.isRound = primitive.shape == Primitive::Shape::kEllipse;
  object.isMovable = primitive.isMovable;
  object.isNet = primitive.isNet;
  object.zLow = primitive.zLow;
  object.zHigh = primitive.zHigh;
  object.halfX = primitive.halfX;
  object.halfY = primitive.halfY;
  object.radius = object.isRound ? std::max(primitive.halfX, primitive.halfY)
                                 : std::hypot(primitive.halfX, primitive.halfY);
  const Primitive own = inOwnFrame(primitive);
  object.pieces = worldPiecesOf({&own, 1});
  object.pieces.front().colour.clear();
  if (primitive.shape != Primitive::Shape::kTriangle) return object;
  object.pose.theta = 0.0;
  for (const Point2& corner : own.corners) {
    object.radius = std::max(object.radius, std::hypot(corner.x, corner.y));
    object.halfX = std::max(object.halfX, std::abs(corner.x));
    object.halfY = std::max(object.halfY, std::abs(corner.y));
  }
  return object;
}

}  // namespace ortung
