#pragma once

/// A robot that drives through a simulated office of three dimensions and is localized by a planar
/// scanner, or by the clouds of a lidar in its place.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "CloudShape.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/robot/RobotTables.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung::testing {

/// A lidar that turns ten times a second: rings at even elevations, each of them a point a column.
struct Lidar {
  int rings = 16, columns = 900;
  double lowest = -15.0, highest = 15.0;  ///< elevations of the outermost rings [degrees]
  double noise = 0.02;                    ///< standard deviation of ranges [m]
  double maxRange = 40.0;                 ///< [m]
};

/// What is done with the clouds.
struct CloudUse {
  double tilt = 0.0;         ///< greatest roll and pitch while the robot drives [rad]
  bool isLevelled = true;    ///< by an inertial unit that is off by a tenth of a degree
  bool isMotionUsed = true;  ///< whether the motion during sweeps is taken out
  double mountPitch = 0.0;   ///< of the lidar [rad]
};

/// Errors of the estimates at the stamps of scans, from the third second on [m].
struct DriveErrors {
  double median = 0.0, worst = 0.0;
  std::size_t count = 0;
};

/// A drive, simulated once. Not thread-safe.
class CloudDrive {
 public:
  /// @param folder for the files that it makes
  CloudDrive(const std::filesystem::path& folder, double seconds, std::uint64_t seed);

  /// Localizes by a planar scanner at the lidar's place, which sees all beams at one moment.
  DriveErrors byScanner();
  DriveErrors byClouds(const Lidar& lidar, const CloudUse& use);

 private:
  struct Truth {
    Timestamp stamp;
    Pose2 pose;
  };
  Pose2 poseAt(Timestamp stamp) const;
  ros2::PointCloud cloudAt(Timestamp stamp, const Lidar& lidar, const CloudUse& use,
                           std::uint64_t number) const;
  Eigen::Isometry3d robotAt(Timestamp stamp, double tilt) const;
  Eigen::Matrix3d tiltToldAt(Timestamp stamp, const CloudUse& use, Random& random) const;
  double rangeOf(const Eigen::Isometry3d& lidar, const Eigen::Vector3d& direction,
                 double maxRange) const;
  DriveErrors localize(const std::vector<std::vector<Message>>& moments);

  std::filesystem::path robotFile_;
  std::unique_ptr<SimWorld> world_;
  std::shared_ptr<const RobotTables> tables_;
  std::vector<std::vector<Message>> moments_;
  std::vector<Truth> truth_;
};

}  // namespace ortung::testing
