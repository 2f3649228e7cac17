#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "ortung/core/Plugin.hpp"
#include "ortung/core/SourceHelp.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/realsensors/MapFiles.hpp"
#include "ortung/realsensors/ScanLog.hpp"

namespace ortung {
namespace {

constexpr double kCorrectedFrom = 0.05;  // [m]; less is the rounding of the laser's pose
const Range kBeams{1, 8192};

/// Messages are named in capitals: FLASER, NMEA-GGA, SCANMARK_1.
bool isMessageName(std::string_view text) {
  return text[0] >= 'A' && text[0] <= 'Z' && std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
         });
}

/// Returns a scanner of 180 degrees with beams 1 or 0.5 degrees apart, with or without the last
/// one.
Scanner halfTurn(int beams) {
  Scanner scanner;
  scanner.beams = beams;
  scanner.firstAngle = -std::numbers::pi / 2;
  scanner.angleStep = std::numbers::pi / std::max(1, beams % 2 == 0 ? beams : beams - 1);
  return scanner;
}

/// Odometry from a corrected log, where ODOM lines continue from the last corrected pose: the
/// changes from line to line are those of the wheels, except for the jump at each correction.
class ChainedOdometry {
 public:
  void move(const Pose2& seen) {
    if (last_) pose_ = pose_ * (inverse(*last_) * seen);
    last_ = seen;
  }
  void jump(const Pose2& corrected) { last_ = corrected; }
  const Pose2& pose() const { return pose_; }

 private:
  std::optional<Pose2> last_;
  Pose2 pose_;
};

/// A log of CARMEN: FLASER (or RAWLASER1, ROBOTLASER1) and ODOM lines. In a log corrected by a SLAM
/// program the laser's poses are the reference.
class CarmenSource : public ScanLogSource {
 public:
  explicit CarmenSource(const Parameters& options)
      : ScanLogSource(options),
        path_(options.text("path")),
        laser_(options.choiceOr("laser", "FLASER", {"FLASER", "RAWLASER1", "ROBOTLASER1"})) {
    survey();
    LogFile file(path_);
    while (nextMessage(file)) {
      if (file.text(0) == "ODOM") readOdometry(file);
      if (file.text(0) == laser_) laser_ == "FLASER" ? readFront(file) : readNewer(file);
    }
    useMap(fileOption(options, "map", std::filesystem::path(path_).parent_path()));
    finishLog(path_);
  }

 private:
  bool nextMessage(LogFile& file) const;
  void survey();
  void readOdometry(const LogFile& file);
  void readFront(const LogFile& file);
  void readNewer(const LogFile& file);
  bool isReset(const LogFile& file) const;

  std::string path_;
  std::string laser_;
  bool isChained_ = false;          ///< whether ODOM lines continue from corrected poses
  bool isCorrected_ = false;        ///< whether the laser's poses are not odometry
  double offset_ = 0.0;             ///< place of the laser on the robot's x axis [m]
  std::optional<Pose2> laserPose_;  ///< pose of a scan since the last ODOM line
  ChainedOdometry chain_;
  std::optional<Pose2> odometry_;  ///< pose of the last ODOM line
};

bool CarmenSource::nextMessage(LogFile& file) const {
  if (!file.nextRecord()) return false;
  if (!isMessageName(file.text(0)))
    file.fail(inQuotes(file.text(0)), "the name of a CARMEN message");
  return true;
}

/// Returns whether a line sets odometry to the corrected pose: behind a scan, corrected logs have
/// "ODOM x y theta 0 0 0 0 HOST 0" with the scan's own pose. The time may also be another number.
bool CarmenSource::isReset(const LogFile& file) const {
  const Pose2 pose = file.pose(1);
  return isChained_ && laserPose_ && pose.x == laserPose_->x && pose.y == laserPose_->y &&
         pose.theta == laserPose_->theta;
}

/// Reads the whole log to find out of which kind it is.
void CarmenSource::survey() {
  LogFile file(path_);
  std::size_t lasers = 0;
  bool afterLaser = false;
  std::string others;
  while (nextMessage(file)) {
    const std::string_view name = file.text(0);
    if (name == "ODOM" && afterLaser && parseNumber(file.text(7)) == 0.0) isChained_ = true;
    if (name == "PARAM" && file.text(1) == "robot_frontlaser_offset") {
      offset_ = file.number(2, "the offset of the front laser [m]", {-10, 10});
    }
    if (name != "NEFF") afterLaser = name == laser_;
    if (name.find("LASER") != std::string_view::npos && name != laser_ && others.size() < 100 &&
        others.find(name) == std::string::npos) {
      (others += ' ') += name;
    }
    if (name != laser_) continue;
    ++lasers;
    if (name != "FLASER") continue;
    const auto first = static_cast<std::size_t>(file.integer(1, "a number of beams", kBeams)) + 2;
    const double limit = std::abs(offset_) + kCorrectedFrom;
    if (distance(file.pose(first), file.pose(first + 3)) > limit) isCorrected_ = true;
  }
  isCorrected_ = isCorrected_ || isChained_;
  if (lasers == 0) {
    throw std::runtime_error(file.path().string() + ": found no " + laser_ + " message" +
                             (others.empty() ? "" : " but" + others) +
                             ", expected one; the option laser names another");
  }
}

void CarmenSource::readOdometry(const LogFile& file) {
  file.needFields(10, "ODOM, pose, velocities, acceleration, time, host, time");
  const Pose2 pose = file.pose(1);
  if (isReset(file)) {
    chain_.jump(pose);
  } else {
    chain_.move(pose);
    odometry_ = pose;
  }
  laserPose_.reset();
}

void CarmenSource::readFront(const LogFile& file) {
  const int beams = static_cast<int>(file.integer(1, "a number of beams", kBeams));
  if (!scanner()) {
    Scanner found = halfTurn(beams);
    if (!isCorrected_) found.mount.x = offset_;  // corrected poses are the laser's own
    useScanner(file, found);
  }
  if (beams != scanner()->beams) {
    file.fail(std::to_string(beams) + " beams", std::to_string(scanner()->beams) + " as above");
  }
  const auto poses = static_cast<std::size_t>(beams) + 2;
  file.needFields(poses + 9, "FLASER, n, n ranges, pose, odometry, time, host, time");
  const Timestamp stamp = file.stamp(poses + 6);
  addScan(file, stamp, 2, isChained_ ? chain_.pose() : file.pose(poses + 3));
  if (isCorrected_) addTruth(file, stamp, file.pose(poses));
  laserPose_ = file.pose(poses);
}

/// RAWLASER1 and ROBOTLASER1: type, first angle, field of view, step, greatest range, accuracy,
/// remission mode, n, n ranges, m, m remissions; in ROBOTLASER1 the poses of laser and robot and
/// five numbers; time, host, time.
void CarmenSource::readNewer(const LogFile& file) {
  constexpr std::size_t kRanges = 9;
  const int beams = static_cast<int>(file.integer(8, "a number of beams", kBeams));
  const std::size_t remissions = kRanges + static_cast<std::size_t>(beams);
  const auto more = file.integer(remissions, "a number of remissions", {0, kBeams.high});
  const std::size_t poses = remissions + 1 + static_cast<std::size_t>(more);
  const bool hasPoses = laser_ == "ROBOTLASER1";
  file.needFields(poses + (hasPoses ? 14 : 3), "scanner, ranges, remissions, poses, time");
  if (!scanner()) {
    const Range angles{-10, 10};
    Scanner found;
    found.beams = beams;
    found.firstAngle = file.number(2, "the first angle [rad]", angles);
    found.angleStep = file.number(4, "the step of angles [rad]", angles);
    found.maxRange = file.number(5, "the greatest range [m]", {0.1, 1e4});
    found.mount.x = offset_;
    if (hasPoses) found.mount = inverse(file.pose(poses + 3)) * file.pose(poses);
    useScanner(file, found);
  }
  if (beams != scanner()->beams) {
    file.fail(std::to_string(beams) + " beams", std::to_string(scanner()->beams) + " as above");
  }
  if (hasPoses) odometry_ = file.pose(poses + 3);
  addScan(file, file.stamp(file.size() - 3), kRanges, odometry_);
}

/// The text of `ortung import carmen --help`.
class CarmenHelp : public SourceHelp {
 public:
  explicit CarmenHelp(const Parameters&)
      : SourceHelp("log file of CARMEN",
                   withScanLogOptions(
                       {{"laser", "", "FLASER",
                         "messages that are used as scans: FLASER, RAWLASER1 or ROBOTLASER1"},
                        {"map", "", "none",
                         "map_server YAML, CARMEN map or grid map of MRPT, for --world"}})) {}
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("carmen_source", ortung::provide<ortung::Source, ortung::CarmenSource>("carmen"),
               ortung::provide<ortung::SourceHelp, ortung::CarmenHelp>("carmen"));
