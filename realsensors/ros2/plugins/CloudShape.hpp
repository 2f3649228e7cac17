#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "CloudLayout.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/realsensors/Scanner.hpp"

namespace ortung::ros2 {

/// What is taken of the points of a lidar.
struct CloudBand {
  int beams = 360;         ///< of the planar scanner that is made of it, all around, 8 to 8192
  double minHeight = 0.2;  ///< above the robot's frame [m]: floors, kerbs and their noise are below
  double maxHeight = 1.8;  ///< [m]; below lintels, so that open doors are open
  double minRange = 0.5;   ///< from the lidar in the plane [m]; what is nearer is the robot itself
  double maxRange = 30.0;  ///< [m]
  /// @throws std::invalid_argument naming what is out of its range
  void check() const;
};

/// Velocity of a robot in its own frame.
struct PlanarVelocity {
  double forward = 0.0, left = 0.0;  ///< [m/s]
  double turn = 0.0;                 ///< [rad/s]
};

/// How a robot leans and moves during a sweep. Rotations are from the robot's frame into one of the
/// same heading that is level.
struct SweepMotion {
  Eigen::Matrix3d tiltAtBegin = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d tiltAtEnd = Eigen::Matrix3d::Identity();
  PlanarVelocity velocity;  ///< in the middle of the sweep
};

/// Makes scans of a planar scanner of the clouds of a lidar that sits anywhere on a robot, in any
/// direction. The scanner sits at the lidar's place with its beams all around, and beam 0 points
/// backwards in the robot's frame. Each beam has the range of the nearest surface among the points
/// of its sector that are in the band of heights: the mean of the points behind the nearest one, up
/// to 10 cm and what a wall at some 60 degrees has within the sector (30 cm at most), since the
/// nearest of many noisy points would be too near. As these points are seldom in the middle of
/// their sector, the range is moved to there along the surface that the neighbouring beams show.
///
/// A beam without such a point is not valid (NaN), as rays that return nothing leave no points, or
/// points without a direction: nobody knows what was there. Only if a point was seen beyond the
/// greatest range, and the whole way of its ray up to that range lies in the band, nothing is there
/// (+infinity).
///
/// After the first cloud of its size none takes memory. Not thread-safe.
class CloudShape {
 public:
  /// What is wrong with a cloud that is sound, but has nothing for a scan.
  static constexpr std::string_view kNoPoint = "found no point in the band of heights and ranges";

  /// @param mount pose of the lidar in the robot's frame
  /// @throws std::invalid_argument as band.check()
  CloudShape(const CloudBand& band, const Eigen::Isometry3d& mount);
  ~CloudShape();
  CloudShape(CloudShape&&) noexcept;
  CloudShape& operator=(CloudShape&&) noexcept;

  /// Returns the ranges of a cloud [m], which are valid until the next one: NaN: not valid;
  /// +infinity: nothing seen.
  /// @param motion by which points that have times are put to where they were at the cloud's stamp
  /// @param why    out: what is wrong with a cloud of which nothing is made, e.g. since none of its
  ///   points is in the band
  std::span<const float> fit(const CloudLayout& cloud, const SweepMotion& motion, std::string& why);

  Scanner scanner() const;
  const CloudBand& band() const { return band_; }

 private:
  struct Block;
  struct Kept {
    std::uint32_t beam;
    float range;   ///< [m]
    float offset;  ///< from the middle of the beam's sector [beams]
  };
  void place(const CloudLayout& cloud, const SweepMotion& motion);
  void takeBlock(std::size_t count);
  std::span<const float> finish(std::string& why);
  void moveToMiddle();

  CloudBand band_;
  Eigen::Isometry3d mount_;
  Pose2 origin_;                  ///< of the scanner in the robot's frame
  std::unique_ptr<Block> block_;  ///< some points, a quantity in a row
  std::vector<Kept> kept_;        ///< all points in the band
  std::size_t keptCount_ = 0;
  std::vector<float> nearest_, means_, offsets_, ranges_;  ///< by beam
  std::vector<std::uint32_t> counts_;                      ///< by beam
  std::vector<std::uint8_t> isFree_;  ///< by beam: whether a ray has seen nothing
};

}  // namespace ortung::ros2
