#include "WallMatcher.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "ScanForecast.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMostWalls =
    256;  // greatest number of walls that are matched, the longest first
constexpr std::size_t kMostSegments = 6;   // greatest number of segments of which pairs are tried
constexpr int kRefinements = 8;            // Gauss-Newton steps
constexpr double kSamePlace = 0.3;         // poses within this distance are the same [m]
constexpr double kSameHeading = 0.1;       // headings within this angle are the same [rad]
constexpr std::size_t kMostCompared = 24;  // greatest number of candidates whose scan is predicted
constexpr double kLeastExplained = 0.4;    // least explained share of a candidate's points
constexpr double kTolerance = 0.15;        // tolerance of a beam's end across its wall [m]
constexpr double kMostThrough = 0.05;      // greatest share of beams that see through walls
constexpr double kLeastOfWalls = 0.5;      // least share of beams to walls that must end there
constexpr double kShareAWall = 0.115;      // reduction of the required share per further wall
constexpr double kMostShare = 0.98;
constexpr int kUsualWalls = 5;
constexpr double kAlike = 0.75;  // share of the best agreement that counts as equally good
constexpr double kAlikeThrough = 0.1;
constexpr double kFewestSine = 0.34;  // least sine of the angle between two pieces: 20 degrees

double lengthOf(const StraightPiece& s) { return distance(s.from, s.to); }
double directionOf(const StraightPiece& s) {
  return std::atan2(s.to.y - s.from.y, s.to.x - s.from.x);
}
PlanePoint middleOf(const StraightPiece& s) {
  return {0.5 * (s.from.x + s.to.x), 0.5 * (s.from.y + s.to.y)};
}

PlanePoint moved(const Pose2& frame, const PlanePoint& p) {
  const double c = std::cos(frame.theta);
  const double s = std::sin(frame.theta);
  return {frame.x + c * p.x - s * p.y, frame.y + s * p.x + c * p.y};
}

/// Returns the signed distance to a wall's line, positive on its visible side [m].
double offsetFrom(const MeasuredWall& wall, const PlanePoint& p) {
  return wall.cosine * (p.y - wall.y0) - wall.sine * (p.x - wall.x0);
}

bool isSame(const Pose2& a, const Pose2& b) {
  return distance(a, b) < kSamePlace && std::abs(wrapAngle(a.theta - b.theta)) < kSameHeading;
}

/// Returns whether the foot of @p p lies on the wall, or up to @p slack [m] beyond its ends.
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

/// A refined candidate, and the scan's agreement with it.
struct WallMatcher::Place {
  PoseFixData::Fix fix;
  double share = 0.0;    ///< share of beams that end at the wall that is expected there
  double through = 0.0;  ///< share of the beams to walls that end behind them
  int walls = 0;         ///< number of walls of which there are pieces
  double ofWalls = 0.0;  ///< share of the beams to walls that end there
};

MeasuredWall::MeasuredWall(const FieldWall& wall)
    : FieldWall(wall),
      length(lengthOf(wall)),
      direction(std::atan2(wall.y1 - wall.y0, wall.x1 - wall.x0)),
      cosine((wall.x1 - wall.x0) / length),
      sine((wall.y1 - wall.y0) / length) {}

WallMatcher::WallMatcher(std::span<const FieldWall> walls, const WallMatcherConfig& config)
    : walls_(walls.begin(), walls.end()), config_(config) {}

/// Returns the nearest wall to which a piece in this direction can belong, or null.
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

/// Returns the number of walls of which there are pieces.
int WallMatcher::wallsSeen(std::span<const StraightPiece> segments, const Pose2& sensor) const {
  std::vector<const MeasuredWall*> seen;
  for (const StraightPiece& s : segments) {
    const MeasuredWall* wall = wallOf(moved(sensor, middleOf(s)), sensor.theta + directionOf(s));
    if (wall != nullptr && std::find(seen.begin(), seen.end(), wall) == seen.end())
      seen.push_back(wall);
  }
  return static_cast<int>(seen.size());
}

/// Returns the poses at which two pieces lie on two walls.
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
    // The middles of both pieces must lie on the walls' lines.
    const double offA = offsetFrom(u, moved(sensor, middleOf(a)));
    const double offB = offsetFrom(v, moved(sensor, middleOf(b)));
    const double sine = u.cosine * v.sine - u.sine * v.cosine;
    if (std::abs(sine) < kFewestSine) return;
    sensor.x = (-offA * v.cosine + offB * u.cosine) / sine;
    sensor.y = (offB * u.sine - offA * v.sine) / sine;
    if (!lies(u, a, sensor) || !lies(v, b, sensor)) return;
    const bool isKnown = std::any_of(found.begin(), found.end(),
                                     [&](const Candidate& c) { return isSame(c.sensor, sensor); });
    if (!isKnown) found.push_back({sensor, explained(segments, sensor)});
  };
  const std::size_t tried = std::min(segments.size(), kMostSegments);
  for (std::size_t i = 0; i < tried; ++i) {
    for (std::size_t j = i + 1; j < tried; ++j) {
      const double a = directionOf(segments[i]);
      const double b = directionOf(segments[j]);
      if (std::abs(std::sin(b - a)) < kFewestSine) continue;
      const double cosine = std::cos(b - a);
      const double sine = std::sin(b - a);
      const double least = std::cos(config_.angle) - 1e-9;
      for (const MeasuredWall& u : walls_)
        for (const MeasuredWall& v : walls_) {
          // Most walls are at another angle, which can be tested without a rotation.
          const double along = u.cosine * v.cosine + u.sine * v.sine;
          const double across = u.cosine * v.sine - u.sine * v.cosine;
          if (along * cosine + across * sine >= least)
            tryPair(segments[i], segments[j], a, b, u, v);
        }
    }
  }
  return found;
}

/// The evidence of a piece about the pose.
struct WallMatcher::Evidence {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();  ///< sum over all its points
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< effect of a wall that is 1 m off
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();    ///< effect of a wall that is turned by 1 rad
};

WallMatcher::Evidence WallMatcher::evidenceOf(const StraightPiece& segment, const Pose2& mount,
                                              const Pose2& robot) const {
  Evidence evidence;
  const Pose2 sensor = robot * mount;
  const double direction = sensor.theta + directionOf(segment);
  const PlanePoint middle = moved(sensor, middleOf(segment));
  for (const PlanePoint& point : segment.points) {
    const PlanePoint p = moved(sensor, point);
    const MeasuredWall* wall = wallOf(p, direction);
    if (wall == nullptr) continue;
    const double nx = -wall->sine;
    const double ny = wall->cosine;
    // A turn of the robot moves the point at right angles to its lever arm.
    const Eigen::Vector3d row(nx, ny, -nx * (p.y - robot.y) + ny * (p.x - robot.x));
    evidence.normal += row * row.transpose();
    evidence.right -= row * offsetFrom(*wall, p);
    evidence.offset += row;
    evidence.turn += row * (wall->cosine * (p.x - middle.x) + wall->sine * (p.y - middle.y));
  }
  return evidence;
}

/// Refines the robot's pose by least squares of the points' distances from their walls. The
/// covariance accounts for independent noise of the points and for errors of the walls' places,
/// which are common to all points of a wall.
bool WallMatcher::refine(std::span<const StraightPiece> segments, const Pose2& mount,
                         PoseFixData::Fix& fix) const {
  Eigen::Matrix3d normal;
  Eigen::Matrix3d spread;
  const double noise = config_.rangeSigma * config_.rangeSigma;
  const double walls = config_.wallSigma * config_.wallSigma;
  for (int step = 0; step < kRefinements; ++step) {
    normal.setZero();
    spread.setZero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const StraightPiece& segment : segments) {
      const Evidence e = evidenceOf(segment, mount, fix.pose);
      normal += e.normal;
      right += e.right;
      const double half = 0.5 * std::max(lengthOf(segment), 1e-3);
      spread += noise * e.normal + walls * (e.offset * e.offset.transpose() +
                                            e.turn * e.turn.transpose() / (half * half));
    }
    const Eigen::FullPivLU<Eigen::Matrix3d> solver(normal);
    if (!solver.isInvertible() || solver.rcond() < 1e-9) return false;
    const Eigen::Vector3d change = solver.solve(right);
    fix.pose = {fix.pose.x + change[0], fix.pose.y + change[1],
                wrapAngle(fix.pose.theta + change[2])};
  }
  const Eigen::Matrix3d inverse = normal.inverse();
  const Eigen::Matrix3d covariance = inverse * spread * inverse;
  for (int i = 0; i < 9; ++i)
    fix.covariance[static_cast<std::size_t>(i)] = covariance(i / 3, i % 3);
  return isFinite(fix.pose) && covariance.diagonal().minCoeff() > 0.0;
}

std::vector<PoseFixData::Fix> WallMatcher::match(std::span<const StraightPiece> segments,
                                                 const MeasuredScan& scan,
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
  if (found.size() > kMostCompared) found.resize(kMostCompared);
  std::vector<Place> places;
  for (const Candidate& candidate : found) {
    if (candidate.explained < kLeastExplained * static_cast<double>(points)) break;
    Place place;
    place.fix.pose = candidate.sensor * inverse(mount);
    if (!refine(sorted, mount, place.fix)) continue;
    const Pose2 sensor = place.fix.pose * mount;
    const Agreement agreement = agreementOf(scan, walls_, sensor, kTolerance);
    if (agreement.seen == 0 || agreement.expected == 0) continue;
    place.share = static_cast<double>(agreement.agreeing) / agreement.seen;
    place.through = static_cast<double>(agreement.through) / agreement.expected;
    place.ofWalls = static_cast<double>(agreement.agreeing) / agreement.expected;
    place.walls = wallsSeen(sorted, sensor);
    places.push_back(place);
  }
  return chosen(std::move(places));
}

/// Returns the places that fit as well as the best if the fit is significant: a few beams end at
/// walls by coincidence, too, the more likely the fewer walls there are.
std::vector<PoseFixData::Fix> WallMatcher::chosen(std::vector<Place> places) const {
  const auto worth = [](const Place& place) {
    return place.share * std::min(1.0, place.ofWalls / kLeastOfWalls);
  };
  std::stable_sort(places.begin(), places.end(),
                   [&](const Place& a, const Place& b) { return worth(a) > worth(b); });
  std::vector<PoseFixData::Fix> fixes;
  if (places.empty()) return fixes;
  const Place& best = places.front();
  const double demanded =
      std::min(kMostShare, config_.shareMatched + kShareAWall * (kUsualWalls - best.walls));
  if (best.walls < 2 || best.share < demanded || best.through > kMostThrough ||
      best.ofWalls < kLeastOfWalls)
    return fixes;
  for (const Place& place : places) {
    if (place.share < kAlike * best.share || place.through > best.through + kAlikeThrough) continue;
    const bool isKnown = std::any_of(fixes.begin(), fixes.end(), [&](const auto& fix) {
      return isSame(fix.pose, place.fix.pose);
    });
    if (!isKnown) fixes.push_back(place.fix);
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
