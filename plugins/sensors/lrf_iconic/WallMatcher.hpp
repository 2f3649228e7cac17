#pragma once

#include <span>
#include <vector>

#include "ScanShapes.hpp"
#include "WallRaster.hpp"
#include "WallsNearby.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/tables/FieldModel.hpp"

namespace ortung {

/// Returns the walls and goals that a scanner at height @p z [m] meets, the longest first.
std::vector<FieldWall> wallsAt(const FieldModel& field, double z);

/// A wall with precomputed values.
struct MeasuredWall : FieldWall {
  explicit MeasuredWall(const FieldWall& wall);
  double length;     ///< length [m]
  double direction;  ///< direction in the field frame [rad]
  double cosine;     ///< cosine of the direction
  double sine;
};

struct MeasuredScan;
struct OutlinePoint;

struct WallMatcherConfig {
  double reach = 0.25;        ///< greatest distance of a point from its wall [m]
  double angle = 0.12;        ///< greatest angle between a piece and its wall [rad]
  double rangeSigma = 0.03;   ///< standard deviation of the scan's points [m]
  double wallSigma = 0.005;   ///< standard deviation of a wall's place as a whole [m]
  double shareMatched = 0.6;  ///< share of beams that must end at walls, if five of them agree
  int mostFixes = 8;          ///< greatest number of equally good places; more are too ambiguous
};

/// Finds the pose of a scanner from the straight pieces of its scan: all places of the field at
/// which so many of their points lie at walls are found (PlaceSearch) and refined by Gauss-Newton
/// on the points' distances from their walls. Then the whole scan is compared with the expected
/// one at each of them: a pose is reported only if so much of the scan agrees, with so many walls,
/// that it can't be a coincidence, together with all others that agree nearly as well.
class WallMatcher {
 public:
  WallMatcher(std::span<const FieldWall> walls, const WallMatcherConfig& config);

  /// Returns the poses of the robot that fit as well as the best: of as many places as there are;
  /// none if nothing fits, or too much.
  /// @param mount pose of the scanner in the robot frame
  std::vector<PoseFixData::Fix> match(std::span<const StraightPiece> segments,
                                      const MeasuredScan& scan, const Pose2& mount) const;

  /// Returns whether a piece lies on a wall with the robot at @p robot.
  bool isOfWall(const StraightPiece& segment, const Pose2& mount, const Pose2& robot) const;

 private:
  struct Place;
  struct Evidence;
  const MeasuredWall* wallOf(const PlanePoint& inField, double direction) const;
  int wallsSeen(std::span<const StraightPiece> segments, const Pose2& sensor) const;
  Place placeAt(const Pose2& sensor, std::span<const StraightPiece> segments,
                const MeasuredScan& scan, const Pose2& mount) const;
  int pointsAtWalls(std::span<const OutlinePoint> outline, const Pose2& sensor) const;
  std::vector<PoseFixData::Fix> chosen(std::vector<Place> places) const;
  Evidence evidenceOf(const StraightPiece& segment, const Pose2& mount, const Pose2& robot) const;
  bool refine(std::span<const StraightPiece> segments, const Pose2& mount,
              PoseFixData::Fix& fix) const;

  std::vector<MeasuredWall> walls_;
  WallMatcherConfig config_;
  WallsNearby nearby_;
  WallRaster raster_;
};

}  // namespace ortung
