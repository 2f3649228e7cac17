#include "ortung/sim/Primitive.hpp"

#include <algorithm>
#include <cmath>

namespace ortung {
namespace {

Point2 toLocal(const Primitive& primitive, const Point2& point) {
  const double dx = point.x - primitive.centre.x;
  const double dy = point.y - primitive.centre.y;
  const double c = std::cos(primitive.angle);
  const double s = std::sin(primitive.angle);
  return {c * dx + s * dy, c * dy - s * dx};
}

Point2 toField(const Primitive& primitive, const Point2& local) {
  const double c = std::cos(primitive.angle);
  const double s = std::sin(primitive.angle);
  return {primitive.centre.x + c * local.x - s * local.y,
          primitive.centre.y + s * local.x + c * local.y};
}

double distanceToSegment(const Point2& a, const Point2& b, const Point2& p) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double along = ((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy);
  const double t = std::clamp(along, 0.0, 1.0);
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

double side(const Point2& a, const Point2& b, const Point2& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

double distanceToTriangle(const std::array<Point2, 3>& c, const Point2& p) {
  const double s0 = side(c[0], c[1], p);
  const double s1 = side(c[1], c[2], p);
  const double s2 = side(c[2], c[0], p);
  if ((s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0)) return 0.0;
  return std::min({distanceToSegment(c[0], c[1], p), distanceToSegment(c[1], c[2], p),
                   distanceToSegment(c[2], c[0], p)});
}

// The nearest point of an ellipse is (a^2 x / (t + a^2), b^2 y / (t + b^2)) for the greatest root t
// of F(t) = (a x / (t + a^2))^2 + (b y / (t + b^2))^2 - 1, found by bisection, which cannot fail
// (D. Eberly, "Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid", 2013).
double distanceToEllipse(double a, double b, double x, double y) {
  x = std::abs(x);
  y = std::abs(y);
  if (x * x / (a * a) + y * y / (b * b) <= 1.0) return 0.0;
  const auto excess = [&](double t) {
    const double u = a * x / (t + a * a);
    const double v = b * y / (t + b * b);
    return u * u + v * v - 1.0;
  };
  double low = 0.0;  // outside of the ellipse F(0) is positive
  double high = std::hypot(a * x, b * y);
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (excess(middle) > 0.0 ? low : high) = middle;
  }
  const double t = 0.5 * (low + high);
  return std::hypot(x - a * a * x / (t + a * a), y - b * b * y / (t + b * b));
}

}  // namespace

double distanceTo(const Primitive& primitive, const Point2& point) {
  if (primitive.shape == Primitive::Shape::kTriangle)
    return distanceToTriangle(primitive.corners, point);
  const Point2 local = toLocal(primitive, point);
  if (primitive.isCircle()) return std::max(0.0, std::hypot(local.x, local.y) - primitive.halfX);
  if (primitive.shape == Primitive::Shape::kEllipse)
    return distanceToEllipse(primitive.halfX, primitive.halfY, local.x, local.y);
  return std::hypot(std::max(0.0, std::abs(local.x) - primitive.halfX),
                    std::max(0.0, std::abs(local.y) - primitive.halfY));
}

Box2 boundsOf(const Primitive& primitive) {
  if (primitive.shape == Primitive::Shape::kTriangle) {
    const auto& c = primitive.corners;
    return {std::min({c[0].x, c[1].x, c[2].x}), std::max({c[0].x, c[1].x, c[2].x}),
            std::min({c[0].y, c[1].y, c[2].y}), std::max({c[0].y, c[1].y, c[2].y})};
  }
  const double c = std::abs(std::cos(primitive.angle));
  const double s = std::abs(std::sin(primitive.angle));
  const double hx = primitive.halfX;
  const double hy = primitive.halfY;
  const bool round = primitive.shape == Primitive::Shape::kEllipse;
  const double width = round ? std::hypot(hx * c, hy * s) : hx * c + hy * s;
  const double height = round ? std::hypot(hx * s, hy * c) : hx * s + hy * c;
  return {primitive.centre.x - width, primitive.centre.x + width, primitive.centre.y - height,
          primitive.centre.y + height};
}

double reachOf(const Primitive& primitive) {
  if (primitive.shape == Primitive::Shape::kEllipse)
    return std::hypot(primitive.centre.x, primitive.centre.y) +
           std::max(primitive.halfX, primitive.halfY);
  double reach = 0.0;
  for (const Point2& corner : cornersOf(primitive))
    reach = std::max(reach, std::hypot(corner.x, corner.y));
  return reach;
}

double topOf(std::span<const Primitive> primitives) {
  double top = 0.0;
  for (const Primitive& primitive : primitives) top = std::max(top, primitive.zHigh);
  return top;
}

std::vector<Point2> cornersOf(const Primitive& primitive) {
  if (primitive.shape == Primitive::Shape::kTriangle)
    return {primitive.corners.begin(), primitive.corners.end()};
  const double hx = primitive.halfX;
  const double hy = primitive.halfY;
  return {toField(primitive, {-hx, -hy}), toField(primitive, {hx, -hy}),
          toField(primitive, {hx, hy}), toField(primitive, {-hx, hy})};
}

Primitive inOwnFrame(Primitive primitive) {
  for (Point2& corner : primitive.corners) {
    corner.x -= primitive.centre.x;
    corner.y -= primitive.centre.y;
  }
  primitive.centre = {};
  primitive.angle = 0.0;
  return primitive;
}

}  // namespace ortung
