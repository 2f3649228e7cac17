#include "WallMatcher.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace ortung {
namespace {

constexpr std::size_t kMostWalls = 96;    // that are matched, the longest first
constexpr std::size_t kMostSegments = 6;  // of a scan, of which pairs are tried
constexpr int kRefinements = 8;           // Gauss-Newton steps
constexpr double kSamePlace = 0.3;        // poses nearer than this are one [m]
constexpr double kSameHeading = 0.1;      // [rad]
constexpr double kFewestSine = 0.34;      // of the angle between two pieces: 20 degrees

double lengthOf(const StraightPiece& s) { return std::hypot(s.to.x - s.from.x, s.to.y - s.from.y); }
double lengthOf(const FieldWall& w) { return std::hypot(w.x1 - w.x0, w.y1 - w.y0); }
double directionOf(const StraightPiece& s) {
  return std::atan2(s.to.y - s.from.y, s.to.x - s.from.x);
}
double directionOf(const FieldWall& w) { return std::atan2(w.y1 - w.y0, w.x1 - w.x0); }

PlanePoint moved(const Pose2& frame, const PlanePoint& p) {
  const double c = std::cos(frame.theta);
  const double s = std::sin(frame.theta);
  return {frame.x + c * p.x - s * p.y, frame.y + s * p.x + c * p.y};
}

/// Signed distance to a wall's line, positive on the side from which it is seen [m].
double offsetFrom(const FieldWall& wall, const PlanePoint& p) {
  return ((wall.x1 - wall.x0) * (p.y - wall.y0) - (wall.y1 - wall.y0) * (p.x - wall.x0)) /
         lengthOf(wall);
}

/// Whether the foot of @p p lies on the wall, or up to @p slack beyond its ends.
bool isBeside(const FieldWall& wall, const PlanePoint& p, double slack) {
  const double length = lengthOf(wall);
  const double along =
      ((wall.x1 - wall.x0) * (p.x - wall.x0) + (wall.y1 - wall.y0) * (p.y - wall.y0)) / length;
  return along >= -slack && along <= length + slack;
}

}  // namespace

std::vector<FieldWall> wallsAt(const FieldModel& field, double z, double shortest) {
  std::vector<FieldWall> walls;
  for (const FieldWall& wall : field.walls) {
    if (walls.size() == kMostWalls) break;
    if (wall.zLow <= z && z <= wall.zHigh && lengthOf(wall) >= shortest) walls.push_back(wall);
  }
  return walls;
}

struct WallMatcher::Candidate {
  Pose2 sensor;
  int explained = 0;
};

WallMatcher::WallMatcher(std::span<const FieldWall> walls, const WallMatcherConfig& config)
    : walls_(walls), config_(config) {}

/// The nearest wall that a piece in this direction can be of, or null.
const FieldWall* WallMatcher::wallOf(const PlanePoint& inField, double direction) const {
  const FieldWall* nearest = nullptr;
  double reach = config_.reach;
  for (const FieldWall& wall : walls_) {
    const double off = std::abs(offsetFrom(wall, inField));
    if (off >= reach || !isBeside(wall, inField, config_.reach)) continue;
    if (std::abs(wrapAngle(directionOf(wall) - direction)) > config_.angle) continue;
    reach = off;
    nearest = &wall;
  }
  return nearest;
}

int WallMatcher::explained(std::span<const StraightPiece> segments, const Pose2& sensor) const {
  int count = 0;
  for (const StraightPiece& segment : segments) {
    const double direction = sensor.theta + directionOf(segment);
    for (const PlanePoint& point : segment.points)
      count += wallOf(moved(sensor, point), direction) != nullptr ? 1 : 0;
  }
  return count;
}

/// Poses at which two pieces lie on two walls.
std::vector<WallMatcher::Candidate> WallMatcher::candidates(
    std::span<const StraightPiece> segments) const {
  std::vector<Candidate> found;
  const auto lies = [this](const FieldWall& wall, const StraightPiece& s, const Pose2& sensor) {
    return isBeside(wall, moved(sensor, s.from), config_.reach) &&
           isBeside(wall, moved(sensor, s.to), config_.reach);
  };
  const auto tryPair = [&](const StraightPiece& a, const StraightPiece& b, const FieldWall& u,
                           const FieldWall& v) {
    const double turnA = wrapAngle(directionOf(u) - directionOf(a));
    const double turnB = wrapAngle(directionOf(v) - directionOf(b));
    if (std::abs(wrapAngle(turnA - turnB)) > config_.angle) return;
    const double shareB = lengthOf(b) / (lengthOf(a) + lengthOf(b));
    Pose2 sensor{0.0, 0.0, wrapAngle(turnA + shareB * wrapAngle(turnB - turnA))};
    // Both pieces' middles must come to lie on the walls' lines.
    const auto middle = [](const StraightPiece& s) {
      return PlanePoint{0.5 * (s.from.x + s.to.x), 0.5 * (s.from.y + s.to.y)};
    };
    const double offA = offsetFrom(u, moved(sensor, middle(a)));
    const double offB = offsetFrom(v, moved(sensor, middle(b)));
    const double ux = -(u.y1 - u.y0) / lengthOf(u);
    const double uy = (u.x1 - u.x0) / lengthOf(u);
    const double vx = -(v.y1 - v.y0) / lengthOf(v);
    const double vy = (v.x1 - v.x0) / lengthOf(v);
    const double sine = ux * vy - uy * vx;
    if (std::abs(sine) < kFewestSine) return;
    sensor.x = (-offA * vy + offB * uy) / sine;
    sensor.y = (-offB * ux + offA * vx) / sine;
    if (!lies(u, a, sensor) || !lies(v, b, sensor)) return;
    const bool isKnown = std::any_of(found.begin(), found.end(), [&](const Candidate& c) {
      return distance(c.sensor, sensor) < kSamePlace &&
             std::abs(wrapAngle(c.sensor.theta - sensor.theta)) < kSameHeading;
    });
    if (!isKnown) found.push_back({sensor, explained(segments, sensor)});
  };
  const std::size_t tried = std::min(segments.size(), kMostSegments);
  for (std::size_t i = 0; i < tried; ++i) {
    for (std::size_t j = i + 1; j < tried; ++j) {
      const double between = directionOf(segments[j]) - directionOf(segments[i]);
      if (std::abs(std::sin(between)) < kFewestSine) continue;
      for (const FieldWall& u : walls_)
        for (const FieldWall& v : walls_) tryPair(segments[i], segments[j], u, v);
    }
  }
  return found;
}

/// Least squares of the points' distances from their walls, over the robot's pose.
bool WallMatcher::refine(std::span<const StraightPiece> segments, const Pose2& mount,
                         PoseFixData::Fix& fix) const {
  Eigen::Matrix3d normal;
  for (int step = 0; step < kRefinements; ++step) {
    normal.setZero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    const Pose2 sensor = fix.pose * mount;
    for (const StraightPiece& segment : segments) {
      const double direction = sensor.theta + directionOf(segment);
      for (const PlanePoint& point : segment.points) {
        const PlanePoint p = moved(sensor, point);
        const FieldWall* wall = wallOf(p, direction);
        if (wall == nullptr) continue;
        const double nx = -(wall->y1 - wall->y0) / lengthOf(*wall);
        const double ny = (wall->x1 - wall->x0) / lengthOf(*wall);
        // Turning the robot moves the point across its lever.
        const Eigen::Vector3d row(nx, ny, -nx * (p.y - fix.pose.y) + ny * (p.x - fix.pose.x));
        normal += row * row.transpose();
        right -= row * offsetFrom(*wall, p);
      }
    }
    const Eigen::FullPivLU<Eigen::Matrix3d> solver(normal);
    if (!solver.isInvertible() || solver.rcond() < 1e-9) return false;
    const Eigen::Vector3d change = solver.solve(right);
    fix.pose = {fix.pose.x + change[0], fix.pose.y + change[1],
                wrapAngle(fix.pose.theta + change[2])};
  }
  const Eigen::Matrix3d covariance =
      config_.rangeSigma * config_.rangeSigma * Eigen::Matrix3d(normal.inverse());
  for (int i = 0; i < 9; ++i)
    fix.covariance[static_cast<std::size_t>(i)] = covariance(i / 3, i % 3);
  return isFinite(fix.pose) && covariance.diagonal().minCoeff() > 0.0;
}

std::vector<PoseFixData::Fix> WallMatcher::match(std::span<const StraightPiece> segments,
                                                 const Pose2& mount) const {
  std::vector<StraightPiece> sorted(segments.begin(), segments.end());
  std::stable_sort(
      sorted.begin(), sorted.end(),
      [](const StraightPiece& a, const StraightPiece& b) { return lengthOf(a) > lengthOf(b); });
  std::size_t points = 0;
  for (const StraightPiece& segment : sorted) points += segment.points.size();
  std::vector<Candidate> found = candidates(sorted);
  std::stable_sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return a.explained > b.explained;
  });
  std::vector<PoseFixData::Fix> fixes;
  for (const Candidate& candidate : found) {
    // As good as the best, but for what noise at the ends of walls does.
    const bool isGood = candidate.explained >= 0.95 * found.front().explained &&
                        candidate.explained >= config_.shareMatched * static_cast<double>(points);
    if (!isGood) break;
    PoseFixData::Fix fix{candidate.sensor * inverse(mount), {}};
    if (refine(sorted, mount, fix)) fixes.push_back(fix);
  }
  if (static_cast<int>(fixes.size()) > config_.mostFixes) fixes.clear();
  return fixes;
}

bool WallMatcher::isOfWall(const StraightPiece& segment, const Pose2& mount,
                           const Pose2& robot) const {
  const Pose2 sensor = robot * mount;
  const double direction = sensor.theta + directionOf(segment);
  return wallOf(moved(sensor, segment.from), direction) != nullptr &&
         wallOf(moved(sensor, segment.to), direction) != nullptr;
}

}  // namespace ortung
