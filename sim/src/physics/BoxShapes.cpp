#include "BoxShapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "EngineUnits.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr double kSkin = 0.01 / kScale;  ///< skin that the engine gives polygons [m]
constexpr int kEllipseCorners = 48;
/// Corners on the ellipse per wedge; the engine takes at most 8 corners.
constexpr int kWedgeCorners = 6;

Point2 add(const Point2& p, const Point2& q, double factor) {
  return {p.x + factor * q.x, p.y + factor * q.y};
}
Point2 away(const Point2& from, const Point2& to) { return {to.x - from.x, to.y - from.y}; }

/// Makes a convex polygon. The engine's own function welds corners, and aborts the program if no
/// area is left.
std::unique_ptr<b2Shape> polygon(std::vector<Point2> corners, double skin) {
  double twiceArea = 0.0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Point2 a = away(corners[0], corners[i]);
    const Point2 b = away(corners[0], corners[i + 1]);
    twiceArea += a.x * b.y - a.y * b.x;
  }
  if (twiceArea < 0.0) std::reverse(corners.begin(), corners.end());
  auto shape = std::make_unique<b2PolygonShape>();
  shape->m_radius = toEngine(skin);
  shape->m_count = static_cast<int32>(corners.size());
  Point2 middle;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2 side = away(corners[i], corners[(i + 1) % corners.size()]);
    const double length = std::hypot(side.x, side.y);
    shape->m_vertices[i] = toEngine(corners[i]);
    shape->m_normals[i] = {single(side.y / length), single(-side.x / length)};
    middle = add(middle, corners[i], 1.0 / static_cast<double>(corners.size()));
  }
  shape->m_centroid = toEngine(middle);
  return shape;
}

struct Inscribed {
  Point2 centre;
  double radius = 0.0;  ///< radius [m]
};

/// Returns the circle inscribed in a triangle.
Inscribed inscribedIn(const std::array<Point2, 3>& corners) {
  std::array<double, 3> sides{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Point2 side = away(corners[(i + 1) % 3], corners[(i + 2) % 3]);
    sides[i] = std::hypot(side.x, side.y);
  }
  const double whole = sides[0] + sides[1] + sides[2];
  Inscribed circle;
  for (std::size_t i = 0; i < 3; ++i)
    circle.centre = add(circle.centre, corners[i], sides[i] / whole);
  const Point2 a = away(corners[0], corners[1]);
  const Point2 b = away(corners[0], corners[2]);
  circle.radius = std::abs(a.x * b.y - a.y * b.x) / whole;
  return circle;
}

/// Returns wedges around the middle of an ellipse.
std::vector<std::unique_ptr<b2Shape>> wedgesOf(const Primitive& ellipse, double skin) {
  const double c = std::cos(ellipse.angle);
  const double s = std::sin(ellipse.angle);
  const auto corner = [&](int i) {
    const double t = kTurn * i / kEllipseCorners;
    const double x = ellipse.halfX * std::cos(t);
    const double y = ellipse.halfY * std::sin(t);
    return Point2{ellipse.centre.x + c * x - s * y, ellipse.centre.y + s * x + c * y};
  };
  std::vector<std::unique_ptr<b2Shape>> wedges;
  for (int first = 0; first < kEllipseCorners; first += kWedgeCorners) {
    std::vector<Point2> points{ellipse.centre};
    for (int i = 0; i <= kWedgeCorners; ++i) points.push_back(corner(first + i));
    wedges.push_back(polygon(std::move(points), skin));
  }
  return wedges;
}

/// Returns half the smallest width of a primitive [m].
double thinnest(const Primitive& primitive) {
  return primitive.shape == Primitive::Shape::kTriangle
             ? inscribedIn(primitive.corners).radius
             : std::min(primitive.halfX, primitive.halfY);
}

Primitive seenFrom(Primitive primitive, const Point2& origin) {
  primitive.centre = away(origin, primitive.centre);
  for (Point2& corner : primitive.corners) corner = away(origin, corner);
  return primitive;
}

/// Returns whether a piece certainly lies within another one. All are convex.
bool isWithin(const Primitive& inner, const Primitive& outer) {
  if (inner.zLow < outer.zLow || inner.zHigh > outer.zHigh) return false;
  if (inner.friction != outer.friction || inner.restitution != outer.restitution) return false;
  if (inner.isCircle() && outer.isCircle()) {
    const Point2 apart = away(inner.centre, outer.centre);
    return std::hypot(apart.x, apart.y) + inner.halfX <= outer.halfX;
  }
  Primitive around = inner;  // the bounding rectangle if it is an ellipse
  if (inner.shape == Primitive::Shape::kEllipse) around.shape = Primitive::Shape::kRectangle;
  const std::vector<Point2> corners = cornersOf(around);
  return std::all_of(corners.begin(), corners.end(),
                     [&](const Point2& corner) { return distanceTo(outer, corner) == 0.0; });
}

Bulk bulkOf(const Primitive& piece) {
  Bulk bulk;
  bulk.centre = piece.centre;
  if (piece.shape == Primitive::Shape::kTriangle) {
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
  const bool isRound = piece.shape == Primitive::Shape::kEllipse;
  bulk.area = (isRound ? std::numbers::pi : 4.0) * piece.halfX * piece.halfY;
  bulk.inertia = squares / (isRound ? 4.0 : 3.0);
  return bulk;
}

}  // namespace

Primitive drawnIn(const Primitive& primitive, double depth) {
  Primitive smaller = primitive;
  depth = std::min(depth, thinnest(primitive) / 2.0);
  if (primitive.shape == Primitive::Shape::kTriangle) {
    const Inscribed circle = inscribedIn(primitive.corners);
    for (Point2& corner : smaller.corners)
      corner = add(circle.centre, away(circle.centre, corner), 1.0 - depth / circle.radius);
    return smaller;
  }
  smaller.halfX -= depth;
  smaller.halfY -= depth;
  return smaller;
}

std::vector<std::unique_ptr<b2Shape>> boxShapesOf(const Primitive& primitive,
                                                  const Point2& origin) {
  const Primitive whole = seenFrom(primitive, origin);
  std::vector<std::unique_ptr<b2Shape>> shapes;
  if (whole.isCircle()) {
    auto circle = std::make_unique<b2CircleShape>();
    circle->m_p = toEngine(whole.centre);
    circle->m_radius = toEngine(whole.halfX);
    shapes.push_back(std::move(circle));
    return shapes;
  }
  const double skin = std::min(kSkin, thinnest(whole) / 2.0);
  const Primitive core = drawnIn(whole, skin);
  if (whole.shape == Primitive::Shape::kEllipse) return wedgesOf(core, skin);
  shapes.push_back(polygon(cornersOf(core), skin));
  return shapes;
}

std::unique_ptr<b2Shape> boxShapeOf(const WallSegment& wall, const Point2& origin) {
  auto edge = std::make_unique<b2EdgeShape>();
  edge->SetTwoSided(toEngine(away(origin, wall.from)), toEngine(away(origin, wall.to)));
  edge->m_radius = 0.0f;
  return edge;
}

std::vector<Primitive> withoutHidden(std::span<const Primitive> pieces) {
  std::vector<Primitive> seen;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    bool isHidden = false;
    for (std::size_t k = 0; k < pieces.size() && !isHidden; ++k)
      // The first one of two equal pieces stays.
      isHidden =
          k != i && isWithin(pieces[i], pieces[k]) && (k < i || !isWithin(pieces[k], pieces[i]));
    if (!isHidden) seen.push_back(pieces[i]);
  }
  return seen;
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
