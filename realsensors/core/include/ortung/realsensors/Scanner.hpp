#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/core/SourceHelp.hpp"

namespace ortung {

/// Sensors are this far from the robot's origin at most, along each axis [m].
inline constexpr double kFarMount = 10.0;

/// The mount of a laser scanner and the directions of its beams. Angles are counter-clockwise.
struct Scanner {
  Pose2 mount;                     ///< pose of the scanner in the robot frame
  int beams = 0;                   ///< number of beams, in [1, 8192]
  double firstAngle = 0.0;         ///< angle of beam 0 in the sensor's frame [rad]
  double angleStep = 0.0;          ///< angle between beams [rad], > 0; beams * angleStep <= 2 pi
  std::optional<double> maxRange;  ///< least range that means that nothing was seen [m]
};

/// Options that override what a log says about its scanner: laser_x, laser_y [m], laser_yaw_deg:
/// its mount; max_range_m: ranges from here on mean that nothing was seen. Immutable once made.
class ORTUNG_API ScannerOptions {
 public:
  /// @throws ConfigError for values out of range
  explicit ScannerOptions(const Parameters& options);
  /// Returns the scanner with the options applied and a greatest range: at most 30 m unless the
  /// options set it.
  /// @param scanner the scanner as the log describes it
  /// @param where   file and line for the error
  /// @throws std::runtime_error if the number of beams, their angles or the mount are impossible
  Scanner apply(Scanner scanner, const std::string& where) const;

 private:
  std::optional<double> x_, y_, yaw_, maxRange_;
};

/// Appends those of ScannerOptions to @p options, for the help of a source.
ORTUNG_API std::vector<SourceOption> withScannerOptions(std::vector<SourceOption> options);

/// Returns the median time between two scans [s]; 1 if there are fewer than two.
ORTUNG_API double medianPeriod(const std::vector<Timestamp>& stamps);

/// Returns the beginning of a robot file (TOML), with odometry, named after the log at @p path.
ORTUNG_API std::string robotHead(const std::string& path);
/// Returns the [[sensor]] table of the scanner. @param period time between scans [s]
ORTUNG_API std::string scannerToml(const Scanner& scanner, double period,
                                   const SensorId& id = {"laser", "LRF", "scan"});

}  // namespace ortung
