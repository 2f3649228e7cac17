#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ortung/realsensors/LogFile.hpp"
#include "ortung/realsensors/LogSource.hpp"
#include "ortung/realsensors/Scanner.hpp"

namespace ortung {

/// Logs of one laser scanner, odometry and, perhaps, a reference pose: what they have in common.
/// Features: odometry/odometry/pose, laser/LRF/scan, reference/groundTruth/pose.
///
/// Options: those of ScannerOptions; jitter_s: how far stamps may fall back [s] (default 1);
/// period_s: the stamps of scans are ignored, and scans are this far apart [s], in the order of
/// lines. Scans whose stamps do not change are one second apart in any case. Not thread-safe.
class ORTUNG_API ScanLogSource : public LogSource {
 public:
  ~ScanLogSource() override;
  /// A robot file with odometry and the scanner.
  std::string robotToml() const override;
  /// Writes the world of the map. @throws std::runtime_error if there is no map
  void writeWorld(const std::filesystem::path& file) const override;
  std::string remark() const override { return remark_; }

 protected:
  /// @throws ConfigError
  explicit ScanLogSource(const Parameters& options);

  /// Sets the scanner; what the options say about it overrides the log. Called once at most.
  void useScanner(const LogFile& file, const Scanner& scanner);
  /// The scanner; nothing before useScanner().
  const std::optional<Scanner>& scanner() const { return scanner_; }

  /// Adds a scan, whose ranges [m] are the fields from @p first on of the current line.
  /// @param odometry the robot's pose in the odometry frame, if the line has one
  /// @pre useScanner() was called
  void addScan(const LogFile& file, Timestamp stamp, std::size_t first,
               const std::optional<Pose2>& odometry);
  /// Adds a pose of the odometry.
  void addOdometry(const LogFile& file, Timestamp stamp, const Pose2& pose);
  /// Adds a reference pose in the field frame.
  void addTruth(const LogFile& file, Timestamp stamp, const Pose2& pose);
  /// Adds commanded velocities, in force from @p stamp on; they become the odometry's motion data.
  /// @param v translational [m/s] @param w rotational [rad/s]
  void addCommand(const LogFile& file, Timestamp stamp, double v, double w);

  /// Ends adding. @param where file for the error
  /// @throws std::runtime_error if there was no scan
  void finishLog(const std::string& where);

  /// Sets the map's file, see writeWorld().
  void useMap(std::filesystem::path map) { map_ = std::move(map); }
  const std::filesystem::path& map() const { return map_; }

 private:
  /// A pose at a time.
  struct TimedPose {
    Timestamp stamp;
    Pose2 pose;
  };
  /// Velocities that are in force from a time on.
  struct Command {
    Timestamp stamp;
    double v;  ///< translational velocity [m/s]
    double w;  ///< rotational velocity [rad/s]
  };
  void setInLineOrder(const std::string& where);

  std::string path_;
  ScannerOptions scannerOptions_;
  std::optional<double> period_;  ///< time between scans [s]; nothing: by their stamps
  std::optional<Scanner> scanner_;
  LogClock scanClock_, odometryClock_, truthClock_, commandClock_;
  Timestamp lastRaw_ = 0;
  std::size_t standing_ = 0;  ///< number of scans with the stamp of the scan before
  std::vector<Timestamp> scanStamps_;
  std::vector<std::uint32_t> scanWords_;
  std::vector<TimedPose> scanOdometry_;  ///< odometry pose of each scan, or empty
  std::vector<TimedPose> odometry_;
  std::vector<TimedPose> truth_;
  std::vector<Command> commands_;
  std::filesystem::path map_;  ///< file of the map, or empty
  std::string remark_;         ///< what of the odometry no robot does, or ""
};

/// Appends the options that all logs of lasers have to @p options, for the help of a source.
ORTUNG_API std::vector<SourceOption> withScanLogOptions(std::vector<SourceOption> options);

}  // namespace ortung
