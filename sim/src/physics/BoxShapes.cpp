#include "BoxShapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr double kSkin = 0.01;  ///< the engine's own for polygons [m]
constexpr int kEllipseCorners = 48;
constexpr int kWedgeCorners = 6;  ///< of the ellipse in one wedge; the engine takes 8 corners

b2Vec2 vec(const Point2& p) { return {static_cast<float>(p.x), static_cast<float>(p.y)}; }

Point2 add(const Point2& p, const Point2& q, double factor) {
  return {p.x + factor * q.x, p.y + factor * q.y};
}

std::unique_ptr<b2Shape> polygon(const std::vector<Point2>& corners, double skin) {
  std::vector<b2Vec2> points;
  for (const Point2& corner : corners) points.push_back(vec(corner));
  auto shape = std::make_unique<b2PolygonShape>();
  shape->Set(points.data(), static_cast<int32>(points.size()));
  shape->m_radius = static_cast<float>(skin);
  return shape;
}

/// Draws a triangle in towards the centre of its inscribed circle.
std::unique_ptr<b2Shape> triangle(const std::array<Point2, 3>& corners) {
  const auto side = [&](std::size_t i) {
    const Point2& a = corners[(i + 1) % 3];
    const Point2& b = corners[(i + 2) % 3];
    return std::hypot(b.x - a.x, b.y - a.y);
  };
  const double whole = side(0) + side(1) + side(2);
  Point2 middle;
  for (std::size_t i = 0; i < 3; ++i) middle = add(middle, corners[i], side(i) / whole);
  const double twiceArea = std::abs((corners[1].x - corners[0].x) * (corners[2].y - corners[0].y) -
                                    (corners[2].x - corners[0].x) * (corners[1].y - corners[0].y));
  const double inradius = twiceArea / whole;
  const double skin = std::min(kSkin, inradius / 2.0);
  std::vector<Point2> points;
  for (const Point2& corner : corners)
    points.push_back(
        add(middle, {corner.x - middle.x, corner.y - middle.y}, 1.0 - skin / inradius));
  return polygon(points, skin);
}

std::unique_ptr<b2Shape> rectangle(const Primitive& primitive) {
  const double skin = std::min(kSkin, std::min(primitive.halfX, primitive.halfY) / 2.0);
  Primitive drawnIn = primitive;
  drawnIn.halfX -= skin;
  drawnIn.halfY -= skin;
  return polygon(cornersOf(drawnIn), skin);
}

/// Wedges around the middle of an ellipse.
std::vector<std::unique_ptr<b2Shape>> ellipse(const Primitive& primitive) {
  const double skin = std::min(kSkin, std::min(primitive.halfX, primitive.halfY) / 4.0);
  const double c = std::cos(primitive.angle);
  const double s = std::sin(primitive.angle);
  const auto corner = [&](int i) {
    const double t = kTurn * i / kEllipseCorners;
    // On the curve drawn in along its normal.
    const double nx = primitive.halfY * std::cos(t);
    const double ny = primitive.halfX * std::sin(t);
    const double n = std::hypot(nx, ny);
    const double x = primitive.halfX * std::cos(t) - skin * nx / n;
    const double y = primitive.halfY * std::sin(t) - skin * ny / n;
    return Point2{primitive.centre.x + c * x - s * y, primitive.centre.y + s * x + c * y};
  };
  std::vector<std::unique_ptr<b2Shape>> wedges;
  for (int first = 0; first < kEllipseCorners; first += kWedgeCorners) {
    std::vector<Point2> points{primitive.centre};
    for (int i = 0; i <= kWedgeCorners; ++i) points.push_back(corner(first + i));
    wedges.push_back(polygon(points, skin));
  }
  return wedges;
}

Bulk bulkOf(const Primitive& piece) {
  Bulk bulk;
  bulk.centre = piece.centre;
  if (piece.shape == Primitive::Shape::triangle) {
    const auto& c = piece.corners;
    bulk.area = 0.5 * std::abs((c[1].x - c[0].x) * (c[2].y - c[0].y) -
                               (c[2].x - c[0].x) * (c[1].y - c[0].y));
    double sides = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double dx = c[(i + 1) % 3].x - c[i].x;
      const double dy = c[(i + 1) % 3].y - c[i].y;
      sides += dx * dx + dy * dy;
    }
    bulk.inertia = sides / 36.0;  // around the centroid
    return bulk;
  }
  const double squares = piece.halfX * piece.halfX + piece.halfY * piece.halfY;
  const bool isRound = piece.shape == Primitive::Shape::ellipse;
  bulk.area = (isRound ? std::numbers::pi : 4.0) * piece.halfX * piece.halfY;
  bulk.inertia = squares / (isRound ? 4.0 : 3.0);
  return bulk;
}

}  // namespace

std::vector<std::unique_ptr<b2Shape>> boxShapesOf(const Primitive& primitive) {
  std::vector<std::unique_ptr<b2Shape>> shapes;
  if (primitive.shape == Primitive::Shape::triangle) {
    shapes.push_back(triangle(primitive.corners));
  } else if (primitive.shape == Primitive::Shape::rectangle) {
    shapes.push_back(rectangle(primitive));
  } else if (primitive.isCircle()) {
    auto circle = std::make_unique<b2CircleShape>();
    circle->m_p = vec(primitive.centre);
    circle->m_radius = static_cast<float>(primitive.halfX);
    shapes.push_back(std::move(circle));
  } else {
    shapes = ellipse(primitive);
  }
  return shapes;
}

std::unique_ptr<b2Shape> boxShapeOf(const WallSegment& wall) {
  auto edge = std::make_unique<b2EdgeShape>();
  edge->SetTwoSided(vec(wall.from), vec(wall.to));
  edge->m_radius = 0.0f;
  return edge;
}

Bulk bulkOf(std::span<const Primitive> pieces) {
  Bulk whole;
  for (const Primitive& piece : pieces) {
    const Bulk part = bulkOf(piece);
    whole.area += part.area;
    whole.centre = add(whole.centre, part.centre, part.area);
  }
  whole.centre = {whole.centre.x / whole.area, whole.centre.y / whole.area};
  for (const Primitive& piece : pieces) {
    const Bulk part = bulkOf(piece);
    const double dx = part.centre.x - whole.centre.x;
    const double dy = part.centre.y - whole.centre.y;
    whole.inertia += (part.inertia + dx * dx + dy * dy) * part.area / whole.area;
  }
  return whole;
}

}  // namespace ortung
