#include "Cones.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "BodyRays.hpp"
#include "ConeOverPlan.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr double kFinestRays = 0.1 * kTurn / 360.0;
constexpr double kWidestRays = 2.0 * kTurn / 360.0;
/// Sagitta of the chords that approximate a round outline [m].
constexpr double kSagitta = 0.0005;
constexpr std::size_t kFewestChords = 16;
constexpr std::size_t kMostChords = 96;

/// Casts cones of horizontal rays that are at most @p widest [rad] apart; shared rays are cast
/// once.
void castLevel(const World& world, double widest, const ConeFan& fan, RobotNumber ignore,
               std::span<float> ranges) {
  const bool shares = ranges.size() > 1 && fan.angleStep > 0.0;
  const double span = shares ? fan.angleStep : fan.halfAngle;
  const double pieces = std::max(1.0, std::ceil(span / widest - 1e-9));
  const double step = span / pieces;
  const auto between = static_cast<std::size_t>(shares ? pieces : 1.0);
  const auto toEachSide = static_cast<std::size_t>(std::floor(fan.halfAngle / step + 1e-9));
  thread_local std::vector<float> rays;  // reused, so that a cone does not allocate in each cycle
  rays.resize((ranges.size() - 1) * between + 2 * toEachSide + 1);
  world.castFan({.x = fan.x,
                 .y = fan.y,
                 .z = fan.z,
                 .firstAngle = fan.firstAngle - static_cast<double>(toEachSide) * step,
                 .angleStep = step,
                 .maxRange = fan.maxRange},
                ignore, rays);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const auto first = rays.begin() + static_cast<std::ptrdiff_t>(i * between);
    ranges[i] =
        std::min(ranges[i],
                 *std::min_element(first, first + static_cast<std::ptrdiff_t>(2 * toEachSide + 1)));
  }
}

}  // namespace

void castConesAtMaps(const World& world, const std::vector<GridBody>& maps, const ConeFan& fan,
                     RobotNumber ignore, std::span<float> ranges) {
  double cell = fan.maxRange;
  bool anyLevel = false;
  bool anyElsewhere = false;
  for (const GridBody& body : maps) {
    const bool isLevel = body.zLow <= fan.z && fan.z <= body.zHigh;
    if (isLevel) cell = std::min(cell, body.map.cell);
    anyLevel = anyLevel || isLevel;
    anyElsewhere = anyElsewhere || !isLevel;
  }
  if (anyElsewhere) world.World::castCones(fan, ignore, ranges);
  if (!anyLevel || ranges.empty() || !(fan.maxRange > 0.0)) return;
  castLevel(world, std::clamp(cell / fan.maxRange, kFinestRays, kWidestRays), fan, ignore, ranges);
}

void BodyRays::castCones(const ConeFan& fan, RobotNumber ignore, std::span<float> ranges) const {
  for (const Body& body : bodies_) {
    if (body.number == ignore) continue;
    for (const Piece& piece : body.pieces) castConesAt(piece, fan, ranges);
  }
}

/// Writes the corners of a piece's outline around @p middle; for a round piece, the ends of chords.
/// @returns their number
std::size_t BodyRays::outlineOf(const Piece& piece, const Point2& middle,
                                std::span<Point2> outline) {
  if (!piece.isRound) {
    for (std::size_t i = 0; i < piece.sides; ++i)
      outline[i] = {piece.corners[i].x + middle.x, piece.corners[i].y + middle.y};
    return piece.sides;
  }
  const double chords = kTurn / 2.0 / std::sqrt(2.0 * kSagitta / std::max(piece.reach, kSagitta));
  const std::size_t n = std::clamp(static_cast<std::size_t>(chords), kFewestChords, kMostChords);
  const auto& m = piece.normals;  // maps the ellipse to the unit circle
  const double determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  for (std::size_t i = 0; i < n; ++i) {
    const double t = kTurn * static_cast<double>(i) / static_cast<double>(n);
    const double c = std::cos(t);
    const double s = std::sin(t);
    outline[i] = {(m[1][1] * c - m[0][1] * s) / determinant + middle.x,
                  (m[0][0] * s - m[1][0] * c) / determinant + middle.y};
  }
  return n;
}

void BodyRays::castConesAt(const Piece& piece, const ConeFan& fan, std::span<float> ranges) {
  const Point2 middle{piece.middle.x - fan.x, piece.middle.y - fan.y};
  const double distance = std::hypot(middle.x, middle.y);
  const double height = std::max({0.0, piece.zLow - fan.z, fan.z - piece.zHigh});
  const double least = std::hypot(std::max(0.0, distance - piece.reach), height);
  if (least >= fan.maxRange) return;
  const ConeOverPlan cone{std::tan(fan.halfAngle)};
  const double bearing = std::atan2(middle.y, middle.x);
  const double aside = distance > piece.reach ? std::asin(piece.reach / distance) : kTurn;
  std::array<Point2, kMostChords> outline;
  std::array<Point2, kMostChords> seen;
  std::size_t n = 0;  // computed only when needed: most pieces are in no cone or are hidden
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    if (least >= static_cast<double>(ranges[k])) continue;
    const double axis = fan.firstAngle + static_cast<double>(k) * fan.angleStep;
    if (std::abs(std::remainder(bearing - axis, kTurn)) > aside + fan.halfAngle + 1e-9) continue;
    if (n == 0) n = outlineOf(piece, middle, outline);
    const double c = std::cos(axis);
    const double s = std::sin(axis);
    for (std::size_t i = 0; i < n; ++i)
      seen[i] = {c * outline[i].x + s * outline[i].y, c * outline[i].y - s * outline[i].x};
    const double range = cone.nearest({seen.data(), n}, height);
    if (range < static_cast<double>(ranges[k])) ranges[k] = static_cast<float>(range);
  }
}

}  // namespace ortung
