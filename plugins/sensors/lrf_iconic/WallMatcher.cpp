#include "WallMatcher.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "PlaceSearch.hpp"
#include "ScanForecast.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMostWalls =
    8192;  // greatest number of walls that are matched, the longest first
constexpr double kShortestWall = 0.01;  // shorter ones have no direction [m]
constexpr double kPointSpacing = 0.2;   // least distance of points on a piece [m]
constexpr double kMostPoints = 80.0;    // greatest number of points of all pieces
constexpr double kSearchReach = 0.2;    // of points from their walls when places are looked for [m]
constexpr double kSearchAngle = 0.14;   // of pieces to their walls when they are [rad]
constexpr int kRefinements = 8;         // Gauss-Newton steps
constexpr double kSamePlace = 0.3;      // poses within this distance are the same [m]
constexpr double kSameHeading = 0.1;    // headings within this angle are the same [rad]
constexpr std::size_t kMostCompared = 256;  // greatest number of places whose scan is predicted
constexpr double kLeastExplained = 0.5;     // least share of a place's points at walls
constexpr double kAlikeExplained = 0.7;     // share of the best place's with which one is compared
constexpr double kTolerance = 0.15;         // tolerance of a beam's end across its wall [m]
constexpr double kMostThrough = 0.05;       // greatest share of beams that see through walls
constexpr double kLeastOfWalls = 0.5;       // least share of beams to walls that must end there
constexpr double kShareAWall = 0.115;       // increase of the required share per wall less
constexpr double kMostShare = 0.98;
constexpr int kUsualWalls = 5;
constexpr double kAlike = 0.7;          // share of the best agreement that counts as equally good
constexpr double kAlikeOutline = 0.75;  // share of the best one's outline that does, too, ...
constexpr double kAlikeThrough = 0.1;   // ... unless more beams than this share see through walls

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

/// Returns whether a wall's ends are numbers that can be counted in cells.
bool isOnEarth(const FieldWall& wall) {
  constexpr double kFarthest = 1e7;  // [m]
  return std::abs(wall.x0) < kFarthest && std::abs(wall.y0) < kFarthest &&
         std::abs(wall.x1) < kFarthest && std::abs(wall.y1) < kFarthest;
}

/// Returns points of the pieces, equally far from each other: a wall counts by its length, whether
/// many beams meet it nearby or a few far away.
std::vector<OutlinePoint> pointsOf(std::span<const StraightPiece> segments) {
  double total = 0.0;
  for (const StraightPiece& s : segments) total += lengthOf(s);
  const double spacing = std::max(kPointSpacing, total / kMostPoints);
  std::vector<OutlinePoint> points;
  for (const StraightPiece& s : segments) {
    const double count = std::max(1.0, std::round(lengthOf(s) / spacing));
    for (double i = 0.5; i < count; i += 1.0) {
      const double along = i / count;
      points.push_back({s.from.x + along * (s.to.x - s.from.x),
                        s.from.y + along * (s.to.y - s.from.y), directionOf(s)});
    }
  }
  return points;
}

/// Returns whether the foot of @p p lies on the wall, or up to @p slack [m] beyond its ends.
bool isBeside(const MeasuredWall& wall, const PlanePoint& p, double slack) {
  const double along = wall.cosine * (p.x - wall.x0) + wall.sine * (p.y - wall.y0);
  return along >= -slack && along <= wall.length + slack;
}

}  // namespace

std::vector<FieldWall> wallsAt(const FieldModel& field, double z) {
  std::vector<FieldWall> walls;
  for (const FieldWall& wall : field.walls) {
    if (walls.size() == kMostWalls) break;
    if (wall.zLow <= z && z <= wall.zHigh && isOnEarth(wall) && lengthOf(wall) >= kShortestWall)
      walls.push_back(wall);
  }
  return walls;
}

/// A refined place, and the scan's agreement with it.
struct WallMatcher::Place {
  PoseFixData::Fix fix;
  bool isDetermined = false;  ///< whether the pieces say where in the place it is
  double through = 0.0;       ///< share of the beams to walls that end behind them
  int walls = 0;              ///< number of walls of which there are pieces
  double ofWalls = 0.0;       ///< share of the beams to walls that end there
  int outline = 0;            ///< number of the outline's points that lie at walls
  /// Share of beams that end at the wall that is expected there, less those that end behind it; it
  /// is reduced where most beams to walls end elsewhere.
  double worth = 0.0;
};

MeasuredWall::MeasuredWall(const FieldWall& wall)
    : FieldWall(wall),
      length(lengthOf(wall)),
      direction(std::atan2(wall.y1 - wall.y0, wall.x1 - wall.x0)),
      cosine((wall.x1 - wall.x0) / length),
      sine((wall.y1 - wall.y0) / length) {}

WallMatcher::WallMatcher(std::span<const FieldWall> walls, const WallMatcherConfig& config)
    : walls_(walls.begin(), walls.end()),
      config_(config),
      nearby_(walls, std::numbers::sqrt2 * config.reach),
      raster_(walls, kSearchReach, kSearchAngle) {}

/// Returns the nearest wall to which a piece in this direction can belong, or null.
const MeasuredWall* WallMatcher::wallOf(const PlanePoint& inField, double direction) const {
  const MeasuredWall* nearest = nullptr;
  double reach = config_.reach;
  for (const std::uint32_t i : nearby_.at(inField.x, inField.y)) {
    const MeasuredWall& wall = walls_[i];
    const double off = std::abs(offsetFrom(wall, inField));
    if (off >= reach || !isBeside(wall, inField, config_.reach)) continue;
    if (std::abs(wrapAngle(wall.direction - direction)) > config_.angle) continue;
    reach = off;
    nearest = &wall;
  }
  return nearest;
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
  const std::vector<OutlinePoint> outline = pointsOf(segments);
  const FoundPlaces found = findPlaces(raster_, outline,
                                       {.least = kLeastExplained,
                                        .alike = kAlikeExplained,
                                        .most = kMostCompared,
                                        .apart = kSamePlace,
                                        .turned = kSameHeading});
  if (!found.isAll) return {};  // too many to say which they are
  std::vector<Place> places;
  for (const Pose2& sensor : found.scanners) {
    places.push_back(placeAt(sensor, segments, scan, mount));
    places.back().outline = pointsAtWalls(outline, places.back().fix.pose * mount);
  }
  return chosen(std::move(places));
}

WallMatcher::Place WallMatcher::placeAt(const Pose2& sensor,
                                        std::span<const StraightPiece> segments,
                                        const MeasuredScan& scan, const Pose2& mount) const {
  Place place;
  const Pose2 first = sensor * inverse(mount);
  place.fix.pose = first;
  const bool isRefined = refine(segments, mount, place.fix);
  if (!isRefined) place.fix.pose = first;
  const double sigma = std::sqrt(std::max(place.fix.covariance[0], place.fix.covariance[4]));
  place.isDetermined = isRefined && sigma < kSamePlace;
  const Pose2 refined = place.fix.pose * mount;
  const Agreement agreement = agreementOf(scan, walls_, refined, kTolerance);
  if (agreement.seen == 0 || agreement.expected == 0) return place;
  place.through = static_cast<double>(agreement.through) / agreement.expected;
  place.ofWalls = static_cast<double>(agreement.agreeing) / agreement.expected;
  place.walls = wallsSeen(segments, refined);
  place.worth = static_cast<double>(agreement.agreeing - agreement.through) / agreement.seen *
                std::min(1.0, place.ofWalls / kLeastOfWalls);
  return place;
}

int WallMatcher::pointsAtWalls(std::span<const OutlinePoint> outline, const Pose2& sensor) const {
  return static_cast<int>(
      std::count_if(outline.begin(), outline.end(), [&](const OutlinePoint& point) {
        const PlanePoint inField = moved(sensor, {point.x, point.y});
        const MeasuredWall* wall = wallOf(inField, sensor.theta + point.direction);
        return wall != nullptr && std::abs(offsetFrom(*wall, inField)) < kTolerance;
      }));
}

/// Returns the places that fit as well as the best if the fit is significant: a few beams end at
/// walls by coincidence, too, the more likely the fewer walls there are.
std::vector<PoseFixData::Fix> WallMatcher::chosen(std::vector<Place> places) const {
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.worth > b.worth; });
  std::vector<PoseFixData::Fix> fixes;
  if (places.empty()) return fixes;
  const Place& best = places.front();
  const double demanded = std::min(
      kMostShare, config_.shareMatched + kShareAWall * std::max(0, kUsualWalls - best.walls));
  if (best.walls < 2 || best.worth < demanded || best.through > kMostThrough ||
      best.ofWalls < kLeastOfWalls)
    return fixes;
  // Walls count by their beams, most of which meet the nearest one, and by their length: if that
  // one has changed or is not in the map, the right place has little but the others.
  const auto isAlike = [&](const Place& place) {
    return place.worth >= kAlike * best.worth ||
           (place.outline >= kAlikeOutline * best.outline && place.through <= kAlikeThrough);
  };
  for (const Place& place : places) {
    if (!isAlike(place)) continue;
    const bool isKnown = std::any_of(fixes.begin(), fixes.end(), [&](const auto& fix) {
      return isSame(fix.pose, place.fix.pose);
    });
    if (isKnown) continue;
    if (!place.isDetermined) return {};  // somewhere along a corridor would do as well
    fixes.push_back(place.fix);
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
