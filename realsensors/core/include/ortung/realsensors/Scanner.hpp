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

/// Where a laser scanner sits and where its beams go. Angles counter-clockwise.
struct Scanner {
  Pose2 mount;                     ///< in the robot frame
  int beams = 0;                   ///< 1 to 8192
  double firstAngle = 0.0;         ///< of beam 0 in the sensor's frame [rad]
  double angleStep = 0.0;          ///< [rad], positive; beams * angleStep <= 2 pi
  std::optional<double> maxRange;  ///< from which on nothing was seen, if it is known [m]
};

/// What options say of the scanner, instead of its log: laser_x, laser_y [m], laser_yaw_deg: its
/// mount; max_range_m: readings from here on mean that nothing was seen. Immutable once made.
class ORTUNG_API ScannerOptions {
 public:
  /// @throws ConfigError
  explicit ScannerOptions(const Parameters& options);
  /// The scanner as the options want it, with a greatest range: at most 30 m unless they say so.
  /// @param where file and line for the error
  /// @throws std::runtime_error if it is no possible scanner
  Scanner apply(Scanner scanner, const std::string& where) const;

 private:
  std::optional<double> x_, y_, yaw_, maxRange_;
};

/// @p options and those of ScannerOptions, for the help of a source.
ORTUNG_API std::vector<SourceOption> withScannerOptions(std::vector<SourceOption> options);

/// Time between two scans, in the middle of all [s]; 1 if there are less than two.
ORTUNG_API double medianPeriod(const std::vector<Timestamp>& stamps);

/// Robot file up to its first sensor, named after the log at @p path; with odometry.
ORTUNG_API std::string robotHead(const std::string& path);
/// [[sensor]] of the scanner, @p period [s] between scans.
ORTUNG_API std::string scannerToml(const Scanner& scanner, double period,
                                   const SensorId& id = {"laser", "LRF", "scan"});

}  // namespace ortung
