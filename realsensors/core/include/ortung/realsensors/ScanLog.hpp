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
/// Options: those of ScannerOptions; jitter_s: how far stamps may fall back (default 1); period_s:
/// ignore the stamps of scans and set them this far apart, in the order of lines. Scans whose
/// stamps stand still are set in the order of lines anyway, one second apart. Not thread-safe.
class ORTUNG_API ScanLogSource : public LogSource {
 public:
  ~ScanLogSource() override;
  std::string robotToml() const override;
  void writeWorld(const std::filesystem::path& file) const override;

 protected:
  explicit ScanLogSource(const Parameters& options);

  /// The options' words on the scanner come before the log's. Not called twice.
  void useScanner(const LogFile& file, const Scanner& scanner);
  const std::optional<Scanner>& scanner() const { return scanner_; }

  /// A scan in fields @p first to first + beams of the file's line. The scanner must be known.
  void addScan(const LogFile& file, Timestamp stamp, std::size_t first,
               const std::optional<Pose2>& odometry);
  void addOdometry(const LogFile& file, Timestamp stamp, const Pose2& pose);
  void addTruth(const LogFile& file, Timestamp stamp, const Pose2& pose);
  /// Commanded velocities [m/s], [rad/s], in force from then on; they become odometry's motion
  /// data.
  void addCommand(const LogFile& file, Timestamp stamp, double v, double w);

  /// Call when all is added. @throws std::runtime_error if there was no scan
  void finishLog(const std::string& where);

  void useMap(std::filesystem::path map) { map_ = std::move(map); }
  const std::filesystem::path& map() const { return map_; }

 private:
  struct TimedPose {
    Timestamp stamp;
    Pose2 pose;
  };
  struct Command {
    Timestamp stamp;
    double v;
    double w;
  };
  void setInLineOrder(const std::string& where);

  std::string path_;
  ScannerOptions scannerOptions_;
  std::optional<double> period_;
  std::optional<Scanner> scanner_;
  LogClock scanClock_, odometryClock_, truthClock_, commandClock_;
  Timestamp lastRaw_ = 0;
  std::size_t standing_ = 0;  ///< scans with the stamp of the one before
  std::vector<Timestamp> scanStamps_;
  std::vector<std::uint32_t> scanWords_;
  std::vector<TimedPose> scanOdometry_;  ///< of each scan, or empty
  std::vector<TimedPose> odometry_;
  std::vector<TimedPose> truth_;
  std::vector<Command> commands_;
  std::filesystem::path map_;
};

/// @p options and those that all logs of lasers have, for the help of a source.
ORTUNG_API std::vector<SourceOption> withScanLogOptions(std::vector<SourceOption> options);

}  // namespace ortung
