#include "BodyRays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The interval of a ray that is inside something.
struct Within {
  double entry = -kInfinity;
  double exit = kInfinity;

  /// Keeps the part where position + t * speed <= limit.
  void keepBelow(double position, double speed, double limit) {
    if (speed > 0.0) exit = std::min(exit, (limit - position) / speed);
    if (speed < 0.0) entry = std::max(entry, (limit - position) / speed);
    if (speed == 0.0 && position > limit) exit = -kInfinity;
  }
};

}  // namespace

BodyRays::Piece BodyRays::pieceOf(const Primitive& primitive) {
  Piece piece;
  piece.zLow = primitive.zLow;
  piece.zHigh = primitive.zHigh;
  piece.middle = primitive.centre;
  piece.isRound = primitive.shape == Primitive::Shape::kEllipse;
  if (piece.isRound) {
    const double c = std::cos(primitive.angle);
    const double s = std::sin(primitive.angle);
    piece.sides = 2;
    piece.normals[0] = {c / primitive.halfX, s / primitive.halfX};
    piece.normals[1] = {-s / primitive.halfY, c / primitive.halfY};
    piece.reach = std::max(primitive.halfX, primitive.halfY);
    return piece;
  }
  const std::vector<Point2> corners = cornersOf(primitive);
  piece.sides = corners.size();
  const Point2& a = corners[0];
  const double winding =
      (corners[1].x - a.x) * (corners[2].y - a.y) - (corners[1].y - a.y) * (corners[2].x - a.x);
  for (std::size_t i = 0; i < piece.sides; ++i) {
    const Point2& from = corners[i];
    const Point2& to = corners[(i + 1) % piece.sides];
    const double length = std::copysign(std::hypot(to.x - from.x, to.y - from.y), winding);
    piece.normals[i] = {(to.y - from.y) / length, (from.x - to.x) / length};
    piece.corners[i] = {from.x - piece.middle.x, from.y - piece.middle.y};
    piece.offsets[i] = piece.normals[i][0] * (from.x - piece.middle.x) +
                       piece.normals[i][1] * (from.y - piece.middle.y);
    piece.reach =
        std::max(piece.reach, std::hypot(from.x - piece.middle.x, from.y - piece.middle.y));
  }
  return piece;
}

void BodyRays::add(std::span<const Primitive> pieces, RobotNumber number, const Pose2& pose) {
  bodies_.push_back({number, pose, {}, {}, 0.0});
  reshape(bodies_.size() - 1, pieces);
}

void BodyRays::move(std::size_t place, const Pose2& pose) {
  Body& moved = bodies_[place];
  moved.pose = pose;
  const double c = std::cos(pose.theta);
  const double s = std::sin(pose.theta);
  for (std::size_t i = 0; i < moved.shape.size(); ++i) {
    const Piece& from = moved.shape[i];
    Piece& to = moved.pieces[i];
    to.middle = {pose.x + c * from.middle.x - s * from.middle.y,
                 pose.y + s * from.middle.x + c * from.middle.y};
    for (std::size_t k = 0; k < from.sides; ++k) {
      to.normals[k] = {c * from.normals[k][0] - s * from.normals[k][1],
                       s * from.normals[k][0] + c * from.normals[k][1]};
      to.corners[k] = {c * from.corners[k].x - s * from.corners[k].y,
                       s * from.corners[k].x + c * from.corners[k].y};
    }
  }
}

void BodyRays::reshape(std::size_t place, std::span<const Primitive> pieces) {
  Body& changed = bodies_[place];
  changed.shape.clear();
  changed.reach = 0.0;
  for (const Primitive& piece : pieces) {
    const Piece& made = changed.shape.emplace_back(pieceOf(piece));
    changed.reach = std::max(changed.reach, std::hypot(made.middle.x, made.middle.y) + made.reach);
  }
  changed.pieces = changed.shape;
  move(place, changed.pose);
}

void BodyRays::remove(std::size_t place) {
  bodies_.erase(bodies_.begin() + static_cast<std::ptrdiff_t>(place));
}

/// Returns the distance to the first surface, from outside or inside.
std::optional<double> BodyRays::hit(const Piece& piece, const Ray& ray) {
  const double x = ray.x - piece.middle.x;
  const double y = ray.y - piece.middle.y;
  Within within;
  if (piece.isRound) {
    const auto& n = piece.normals;
    const double px = n[0][0] * x + n[0][1] * y;
    const double py = n[1][0] * x + n[1][1] * y;
    const double vx = n[0][0] * ray.dx + n[0][1] * ray.dy;
    const double vy = n[1][0] * ray.dx + n[1][1] * ray.dy;
    // Inside the unit circle where a t^2 + 2 h t + k <= 0.
    const double a = vx * vx + vy * vy;
    const double h = px * vx + py * vy;
    const double k = px * px + py * py - 1.0;
    const double root = h * h - a * k;
    if (a > 0.0) {
      if (root < 0.0) return std::nullopt;
      within = {(-h - std::sqrt(root)) / a, (-h + std::sqrt(root)) / a};
    } else if (k > 0.0) {
      return std::nullopt;
    }
  } else {
    for (std::size_t i = 0; i < piece.sides; ++i) {
      const auto& n = piece.normals[i];
      within.keepBelow(n[0] * x + n[1] * y, n[0] * ray.dx + n[1] * ray.dy, piece.offsets[i]);
    }
  }
  within.keepBelow(ray.z, ray.dz, piece.zHigh);
  within.keepBelow(-ray.z, -ray.dz, -piece.zLow);
  if (within.entry > within.exit || within.exit < 0.0) return std::nullopt;
  return within.entry >= 0.0 ? within.entry : within.exit;
}

void BodyRays::castFan(const RayFan& fan, RobotNumber ignore, std::span<float> ranges) const {
  const FanTurn turn{std::cos(fan.elevation), std::sin(fan.elevation), std::cos(fan.angleStep),
                     std::sin(fan.angleStep)};
  for (const Body& body : bodies_) {
    if (body.number == ignore) continue;
    for (const Piece& piece : body.pieces) {
      if (fan.elevation == 0.0 && (fan.z < piece.zLow || fan.z > piece.zHigh)) continue;
      castAt(piece, fan, turn, ranges);
    }
  }
}

/// Casts the beams that point at the circle around a piece.
void BodyRays::castAt(const Piece& piece, const RayFan& fan, const FanTurn& turn,
                      std::span<float> ranges) {
  const double dx = piece.middle.x - fan.x;
  const double dy = piece.middle.y - fan.y;
  const double farthest = fan.maxRange + piece.reach;
  const double square = dx * dx + dy * dy;
  if (square > farthest * farthest) return;
  // Beams that end before it can't hit it.
  const auto nearest = static_cast<float>(std::sqrt(square) - piece.reach - 1e-6);
  const auto castBeams = [&](std::size_t from, std::size_t to) {
    const double angle = fan.firstAngle + static_cast<double>(from) * fan.angleStep;
    Ray ray{fan.x,    fan.y, fan.z, turn.level * std::cos(angle), turn.level * std::sin(angle),
            turn.rise};
    for (std::size_t i = from; i < to; ++i) {
      const auto t = ranges[i] < nearest ? std::nullopt : hit(piece, ray);
      if (t && *t < static_cast<double>(ranges[i])) ranges[i] = static_cast<float>(*t);
      const double turned = ray.dx * turn.cos - ray.dy * turn.sin;
      ray.dy = ray.dy * turn.cos + ray.dx * turn.sin;
      ray.dx = turned;
    }
  };
  const std::size_t n = ranges.size();
  if (square <= piece.reach * piece.reach * 1.000001 || fan.angleStep == 0.0 || turn.level <= 0.0)
    return castBeams(0, n);
  // A beam i points at the circle if first + i step is within `half` of `middle`, up to whole
  // turns.
  const double half = std::asin(piece.reach / std::sqrt(square)) + 1e-9;
  const double step = std::abs(fan.angleStep);
  const double sign = fan.angleStep < 0.0 ? -1.0 : 1.0;
  const double middle = sign * (std::atan2(dy, dx) - fan.firstAngle);
  const double last = step * static_cast<double>(n - 1);
  double low = middle - half;
  low -=
      kTurn * std::floor((low + 2.0 * half) / kTurn);  // the first interval that ends behind beam 0
  for (; low <= last; low += kTurn) {
    const double from = std::max(std::ceil(low / step), 0.0);
    const double to = std::min(std::floor((low + 2.0 * half) / step), static_cast<double>(n - 1));
    if (from <= to) castBeams(static_cast<std::size_t>(from), static_cast<std::size_t>(to) + 1);
  }
}

bool BodyRays::isBlocked(const std::array<double, 3>& from, const std::array<double, 3>& direction,
                         double stop, RobotNumber ignore) const {
  constexpr double kHair = 1.0 + 1e-9;  // margin for rounding errors
  const Ray ray{from[0], from[1], from[2], direction[0], direction[1], direction[2]};
  const double level2 = ray.dx * ray.dx + ray.dy * ray.dy;
  // Most bodies are too far away or beside the ray.
  const auto isAway = [&](double toX, double toY, double size) {
    const double reach = kHair * size;
    const double x = toX - ray.x;
    const double y = toY - ray.y;
    const double aside = x * ray.dy - y * ray.dx;
    return x * x + y * y > (stop + reach) * (stop + reach) ||
           aside * aside > reach * reach * level2;
  };
  for (const Body& body : bodies_) {
    if (body.number == ignore || isAway(body.pose.x, body.pose.y, body.reach)) continue;
    for (const Piece& piece : body.pieces) {
      if (isAway(piece.middle.x, piece.middle.y, piece.reach)) continue;
      const auto t = hit(piece, ray);
      if (t && *t < stop) return true;
    }
  }
  return false;
}

}  // namespace ortung
