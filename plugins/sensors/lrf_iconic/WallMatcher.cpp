#include "WallMatcher.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace ortung {
namespace {

constexpr std::size_t kMostWalls = 256;   // that are matched, the longest first
constexpr std::size_t kMostSegments = 6;  // of a scan, of which pairs are tried
constexpr int kRefinements = 8;           // Gauss-Newton steps
constexpr double kSamePlace = 0.3;        // poses nearer than this are one [m]
constexpr double kSameHeading = 0.1;      // [rad]
constexpr double kMostThrough = 0.1;      // of points that would be seen through walls
constexpr double kFewestSine = 0.34;      // of the angle between two pieces: 20 degrees

double lengthOf(const StraightPiece& s) { return std::hypot(s.to.x - s.from.x, s.to.y - s.from.y); }
double directionOf(const StraightPiece& s) {
  return std::atan2(s.to.y - s.from.y, s.to.x - s.from.x);
}

PlanePoint moved(const Pose2& frame, const PlanePoint& p) {
  const double c = std::cos(frame.theta);
  const double s = std::sin(frame.theta);
  return {frame.x + c * p.x - s * p.y, frame.y + s * p.x + c * p.y};
}

/// Signed distance to a wall's line, positive on the side from which it is seen [m].
double offsetFrom(const MeasuredWall& wall, const PlanePoint& p) {
  return wall.cosine * (p.y - wall.y0) - wall.sine * (p.x - wall.x0);
}

/// Whether the foot of @p p lies on the wall, or up to @p slack beyond its ends.
bool isBeside(const MeasuredWall& wall, const PlanePoint& p, double slack) {
  const double along = wall.cosine * (p.x - wall.x0) + wall.sine * (p.y - wall.y0);
  return along >= -slack && along <= wall.length + slack;
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

MeasuredWall::MeasuredWall(const FieldWall& wall)
    : FieldWall(wall),
      length(lengthOf(wall)),
      direction(std::atan2(wall.y1 - wall.y0, wall.x1 - wall.x0)),
      cosine((wall.x1 - wall.x0) / length),
      sine((wall.y1 - wall.y0) / length) {}

WallMatcher::WallMatcher(std::span<const FieldWall> walls, const WallMatcherConfig& config)
    : walls_(walls.begin(), walls.end()), config_(config) {}

/// The nearest wall that a piece in this direction can be of, or null.
const MeasuredWall* WallMatcher::wallOf(const PlanePoint& inField, double direction) const {
  const MeasuredWall* nearest = nullptr;
  double reach = config_.reach;
  for (const MeasuredWall& wall : walls_) {
    const double off = std::abs(offsetFrom(wall, inField));
    if (off >= reach || !isBeside(wall, inField, config_.reach)) continue;
    if (std::abs(wrapAngle(wall.direction - direction)) > config_.angle) continue;
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

/// Whether the way from a to b crosses a wall.
bool crosses(const PlanePoint& a, const PlanePoint& b, const FieldWall& wall) {
  const double wx = wall.x1 - wall.x0;
  const double wy = wall.y1 - wall.y0;
  const double sideA = wx * (a.y - wall.y0) - wy * (a.x - wall.x0);
  const double sideB = wx * (b.y - wall.y0) - wy * (b.x - wall.x0);
  if ((sideA > 0.0) == (sideB > 0.0)) return false;
  const double bx = b.x - a.x;
  const double by = b.y - a.y;
  const double side0 = bx * (wall.y0 - a.y) - by * (wall.x0 - a.x);
  const double side1 = bx * (wall.y1 - a.y) - by * (wall.x1 - a.x);
  return (side0 > 0.0) != (side1 > 0.0);
}

/// Whether more points than a few would be seen through walls: then a place that explains them is
/// wrong all the same.
bool WallMatcher::isContradicted(std::span<const StraightPiece> segments,
                                 const Pose2& sensor) const {
  std::size_t through = 0;
  std::size_t points = 0;
  for (const StraightPiece& segment : segments) {
    for (const PlanePoint& point : segment.points) {
      ++points;
      const double range = std::hypot(point.x, point.y);
      const double before = range > config_.reach ? 1.0 - config_.reach / range : 0.0;
      const PlanePoint end = moved(sensor, {before * point.x, before * point.y});
      through += std::any_of(walls_.begin(), walls_.end(), [&](const FieldWall& wall) {
        return crosses({sensor.x, sensor.y}, end, wall);
      });
    }
  }
  return static_cast<double>(through) > kMostThrough * static_cast<double>(points);
}

/// Poses at which two pieces lie on two walls.
std::vector<WallMatcher::Candidate> WallMatcher::candidates(
    std::span<const StraightPiece> segments) const {
  std::vector<Candidate> found;
  const auto lies = [this](const MeasuredWall& wall, const StraightPiece& s, const Pose2& sensor) {
    return isBeside(wall, moved(sensor, s.from), config_.reach) &&
           isBeside(wall, moved(sensor, s.to), config_.reach);
  };
  const auto tryPair = [&](const StraightPiece& a, const StraightPiece& b, double directionA,
                           double directionB, const MeasuredWall& u, const MeasuredWall& v) {
    const double turnA = wrapAngle(u.direction - directionA);
    const double turnB = wrapAngle(v.direction - directionB);
    if (std::abs(wrapAngle(turnA - turnB)) > config_.angle) return;
    const double shareB = lengthOf(b) / (lengthOf(a) + lengthOf(b));
    Pose2 sensor{0.0, 0.0, wrapAngle(turnA + shareB * wrapAngle(turnB - turnA))};
    // Both pieces' middles must come to lie on the walls' lines.
    const auto middle = [](const StraightPiece& s) {
      return PlanePoint{0.5 * (s.from.x + s.to.x), 0.5 * (s.from.y + s.to.y)};
    };
    const double offA = offsetFrom(u, moved(sensor, middle(a)));
    const double offB = offsetFrom(v, moved(sensor, middle(b)));
    const double sine = u.cosine * v.sine - u.sine * v.cosine;
    if (std::abs(sine) < kFewestSine) return;
    sensor.x = (-offA * v.cosine + offB * u.cosine) / sine;
    sensor.y = (offB * u.sine - offA * v.sine) / sine;
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
      const double a = directionOf(segments[i]);
      const double b = directionOf(segments[j]);
      if (std::abs(std::sin(b - a)) < kFewestSine) continue;
      for (const MeasuredWall& u : walls_)
        for (const MeasuredWall& v : walls_) tryPair(segments[i], segments[j], a, b, u, v);
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
        const MeasuredWall* wall = wallOf(p, direction);
        if (wall == nullptr) continue;
        const double nx = -wall->sine;
        const double ny = wall->cosine;
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
  double least = config_.shareMatched * static_cast<double>(points);
  for (const Candidate& candidate : found) {
    if (candidate.explained < least) break;
    if (isContradicted(sorted, candidate.sensor)) continue;
    // As good as the best, but for what noise at the ends of walls does.
    least = std::max(least, 0.95 * candidate.explained);
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
