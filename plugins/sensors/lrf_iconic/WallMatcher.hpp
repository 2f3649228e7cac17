#pragma once

#include <span>
#include <vector>

#include "ScanShapes.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/tables/FieldModel.hpp"

namespace ortung {

/// The walls and goals that a scanner at height @p z meets, the longest first, without what is
/// shorter than @p shortest [m].
std::vector<FieldWall> wallsAt(const FieldModel& field, double z, double shortest);

/// A wall with what is asked of it again and again.
struct MeasuredWall : FieldWall {
  explicit MeasuredWall(const FieldWall& wall);
  double length;     ///< [m]
  double direction;  ///< in the field frame [rad]
  double cosine;     ///< of the direction
  double sine;
};

struct MeasuredScan;

struct WallMatcherConfig {
  double reach = 0.25;        ///< a point this near to a wall may be of it [m]
  double angle = 0.12;        ///< a piece turned this little against a wall may be of it [rad]
  double rangeSigma = 0.03;   ///< of the scan's points [m]
  double wallSigma = 0.005;   ///< of where a wall is, as a whole [m]
  double shareMatched = 0.6;  ///< of beams that must end at walls, if five of them agree
  int mostFixes = 8;          ///< more places that fit as well say too little
};

/// Finds where a scanner is from the straight pieces of its scan: two pieces that are not parallel
/// and two walls at the same angle give a pose; the poses that explain most points are refined by
/// Gauss-Newton on the points' distances from their walls. Then the whole scan is compared with
/// what it would be there: a pose is given only where so much of it agrees, with so many walls,
/// that it can't be chance; and with it all others that agree nearly as well.
class WallMatcher {
 public:
  WallMatcher(std::span<const FieldWall> walls, const WallMatcherConfig& config);

  /// Poses of the robot that fit as well as the best, none if nothing fits.
  /// @param mount pose of the scanner in the robot frame
  std::vector<PoseFixData::Fix> match(std::span<const StraightPiece> segments,
                                      const MeasuredScan& scan, const Pose2& mount) const;

  /// Whether a piece lies on a wall with the robot at @p robot.
  bool isOfWall(const StraightPiece& segment, const Pose2& mount, const Pose2& robot) const;

 private:
  struct Candidate;
  struct Place;
  struct Evidence;
  std::vector<Candidate> candidates(std::span<const StraightPiece> segments) const;
  const MeasuredWall* wallOf(const PlanePoint& inField, double direction) const;
  int explained(std::span<const StraightPiece> segments, const Pose2& sensor) const;
  int wallsSeen(std::span<const StraightPiece> segments, const Pose2& sensor) const;
  std::vector<PoseFixData::Fix> chosen(std::vector<Place> places) const;
  Evidence evidenceOf(const StraightPiece& segment, const Pose2& mount, const Pose2& robot) const;
  bool refine(std::span<const StraightPiece> segments, const Pose2& mount,
              PoseFixData::Fix& fix) const;

  std::vector<MeasuredWall> walls_;
  WallMatcherConfig config_;
};

}  // namespace ortung
