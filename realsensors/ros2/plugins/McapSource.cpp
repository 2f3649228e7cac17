#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <stdexcept>

#include "Bag.hpp"
#include "MapWorld.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/core/SourceHelp.hpp"
#include "ortung/core/SourceOptions.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/realsensors/LogSource.hpp"
#include "ortung/realsensors/Scanner.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {
namespace {

std::string cleaned(const std::string& topic) {
  std::string name;
  for (const char c : topic) {
    const bool isPlain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (isPlain)
      name += c;
    else if (!name.empty())
      name += '_';
  }
  constexpr std::size_t kLongest = 48;
  return name.empty() ? "topic" : name.substr(0, kLongest);
}

CloudBands bandsOf(const Parameters& options, std::optional<double> maxRange) {
  CloudBands bands;
  const double beams = optionNumber(options, "cloud_beams", 360, {8, 8192});
  if (beams != std::floor(beams)) options.fail("cloud_beams", "must be a whole number");
  bands.each.beams = static_cast<int>(beams);
  if (maxRange) bands.each.maxRange = *maxRange;
  const double leastRange = std::min(bands.each.minRange, bands.each.maxRange / 2);
  bands.each.minRange = optionNumber(options, "cloud_min_range_m", leastRange, {0.01, 100});
  try {
    bands.takeHeights(options.textOr("band", ""));
  } catch (const std::invalid_argument& error) {
    options.fail("band", error.what());
  }
  try {
    bands.check();
  } catch (const std::invalid_argument& error) {
    options.fail("band", std::string("and the ranges of clouds: ") + error.what());
  }
  return bands;
}

/// A bag of ROS 2 (MCAP, .db3) or ROS 1 (.bag): laser scans, clouds of lidars, odometry, ranges,
/// poses, and the mounts of the sensors.
class McapSource : public LogSource {
 public:
  explicit McapSource(const Parameters& options)
      : path_(options.text("path")), maxRange_(optionNumber(options, "max_range_m", {0.1, 1000})) {
    options.textOr("robot_file", "");
    BagChoice choice = BagChoice::read(options);
    readMounts(options, choice.mounts);
    choice.bands = bandsOf(options, maxRange_);
    Bag bag(path_, choice);
    checkMounts(bag);
    if (!bag.odometry.list.empty()) addOdometry(bag);
    for (const Bag::Scans& scans : bag.scans) addScans(bag, scans);
    for (const Bag::Clouds& clouds : bag.clouds) addClouds(bag, clouds);
    for (const Bag::Ranges& ranges : bag.ranges) addRanges(bag, ranges);
    for (const Bag::Pictures& pictures : bag.pictures) addPictures(pictures);
    if (!bag.truth.list.empty()) addTruth(bag.truth);
    for (const auto& [topic, own] : bag.own) addOwn(topic, own);
    map_ = std::move(bag.map);
    if (!bag.robotToml.empty()) toml_ = bag.robotToml;
    remarks_.insert(remarks_.end(), bag.remarks.begin(), bag.remarks.end());
    finish(path_);
  }

  std::string remark() const override {
    std::string text;
    for (const std::string& one : remarks_) text += (text.empty() ? "" : "; ") + one;
    return text;
  }
  std::string robotToml() const override {
    return toml_.empty() ? robotHead(path_) + sensors_ : toml_;
  }
  void writeWorld(const std::filesystem::path& file) const override;

 private:
  void readMounts(const Parameters& options, std::map<std::string, Eigen::Isometry3d>& inSpace);
  void checkMounts(const Bag& bag) const;
  void addOdometry(const Bag& bag);
  void addScans(const Bag& bag, const Bag::Scans& scans);
  void addClouds(const Bag& bag, const Bag::Clouds& clouds);
  void addRanges(const Bag& bag, const Bag::Ranges& ranges);
  void addPictures(const Bag::Pictures& pictures);
  void addTruth(const Bag::Track& truth);
  void addOwn(const std::string& topic, const Bag::OwnWords& own);
  /// Returns the name in files that Ortung wrote, if it is valid, or else @p fallback; made unique.
  SensorId idFor(const std::string& feature, SensorId fallback);
  /// Returns the mount of a sensor, and whether it is upside down.
  std::pair<Pose2, bool> mountOf(const Bag& bag, const std::string& frame, const std::string& topic,
                                 bool isScanner);

  std::string path_;
  std::optional<double> maxRange_;
  std::map<std::string, Pose2> mounts_;  ///< mounts by frame, from the options
  std::set<std::string> names_;
  std::map<std::string, std::uint32_t> numbers_;  ///< numbers of features by name
  std::string sensors_;                           ///< [[sensor]] tables
  std::string toml_;                              ///< robot file in a file that Ortung wrote
  std::vector<std::string> remarks_;
  std::optional<OccupancyGrid> map_;
};

/// Reads the mounts of sensors. @param inSpace out: those of lidars, which may be tilted
void McapSource::readMounts(const Parameters& options,
                            std::map<std::string, Eigen::Isometry3d>& inSpace) {
  std::string rest = options.textOr("mounts", "");
  while (!rest.empty()) {
    const std::string one = rest.substr(0, rest.find(';'));
    rest.erase(0, one.size() + 1);
    const std::size_t colon = one.rfind(':');
    auto numbers =
        colon == one.npos ? std::nullopt : parseNumbers(std::string_view(one).substr(colon + 1));
    const bool isMount =
        numbers && (numbers->size() == 3 || numbers->size() == 4 || numbers->size() == 6);
    if (!isMount)
      options.fail("mounts", "has '" + one +
                                 "', must be FRAME:x,y,theta in m and degrees, and ';' "
                                 "between two; of lidars with z, or with z,roll,pitch behind");
    numbers->resize(6, 0.0);
    const auto [x, y, theta, z, roll, pitch] = std::array<double, 6>{
        (*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3], (*numbers)[4], (*numbers)[5]};
    if (!(std::abs(x) <= kFarMount && std::abs(y) <= kFarMount && std::abs(z) <= kFarMount))
      options.fail("mounts", "has '" + one + "', must be within 10 m of the robot's origin");
    mounts_[one.substr(0, colon)] = {x, y, wrapAngle(radians(theta))};
    inSpace[one.substr(0, colon)] = Eigen::Translation3d(x, y, z) *
                                    Eigen::AngleAxisd(radians(theta), Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(radians(pitch), Eigen::Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(radians(roll), Eigen::Vector3d::UnitX());
  }
}

/// Throws for a mount of a frame that no sensor has.
void McapSource::checkMounts(const Bag& bag) const {
  std::string known;
  for (const std::string& frame : bag.sensorFrames())
    known += (known.empty() ? "" : ", ") + inQuotes(frame);
  for (const auto& [frame, mount] : mounts_)
    if (!bag.sensorFrames().contains(frame))
      throw std::runtime_error(path_ + ": found no sensor in the frame " + inQuotes(frame) +
                               " that the option mounts names, expected one of " +
                               (known.empty() ? "none" : known));
}

SensorId McapSource::idFor(const std::string& feature, SensorId fallback) {
  SensorId id = std::move(fallback);
  try {
    if (!feature.empty()) id = parseSensorId(feature);
  } catch (const std::invalid_argument&) {
    remarks_.push_back("a channel calls its feature " + inQuotes(feature) +
                       ", which is not a valid name");
  }
  const std::string wanted = id.feature;
  for (int i = 2; !names_.insert(toText(id)).second; ++i) id.feature = wanted + std::to_string(i);
  return id;
}

std::pair<Pose2, bool> McapSource::mountOf(const Bag& bag, const std::string& frame,
                                           const std::string& topic, bool isScanner) {
  if (const auto told = mounts_.find(frame); told != mounts_.end()) return {told->second, false};
  const auto found = bag.frames.find(frame, bag.base);
  if (!found) {
    remarks_.push_back("the mount of frame " + inQuotes(frame) + " of " + topic + " in " +
                       inQuotes(bag.base) +
                       " is not known: it was put at the origin; the option mounts sets it");
    return {Pose2(), false};
  }
  const PlanarMount mount = onPlane(*found);
  if (isScanner && !mount.isLevel())
    throw std::runtime_error(path_ + ": the scanner of " + topic + " is tilted by " +
                             std::to_string(static_cast<int>(degrees(std::acos(mount.up)))) +
                             " degrees, expected a level one; the option scans leaves it "
                             "out");
  const Eigen::Vector3d place = found->translation();
  if (std::hypot(place.x(), place.y()) > kFarMount)
    remarks_.push_back("the frame " + inQuotes(frame) + " of " + topic + " is " +
                       tomlNumber(std::round(std::hypot(place.x(), place.y()))) + " m from " +
                       inQuotes(bag.base) + "; the option mounts sets where it is");
  return {mount.pose, isScanner && mount.isUpsideDown()};
}

void McapSource::addOdometry(const Bag& bag) {
  const SensorId id = idFor(bag.odometry.feature, {"odometry", "odometry", "pose"});
  const auto feature = addFeature(id);
  numbers_[toText(id)] = feature;
  auto list = bag.odometry.list;
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  const bool isToldVelocities = bag.odometry.topic != "/tf";
  PoseOdometry odometry;
  for (const Bag::Moving& one : list) {
    const auto words = odometry.words(one.stamp, one.pose);
    add(feature, one.stamp,
        isToldVelocities ? OdometryData::encode({one.pose, one.forward, one.turn, {}, one.left})
                         : words);
  }
  if (!odometry.remark().empty()) remarks_.push_back(odometry.remark());
}

void McapSource::addScans(const Bag& bag, const Bag::Scans& scans) {
  const bool isOnly = bag.scans.size() == 1;
  const SensorId id =
      idFor(scans.feature, {isOnly ? "laser" : cleaned(scans.topic), "LRF", "scan"});
  const auto feature = addFeature(id);
  const auto [mount, isUpsideDown] = mountOf(bag, scans.shape->frame(), scans.topic, true);
  Scanner scanner = scans.shape->scanner(isUpsideDown);
  scanner.mount = mount;
  if (!(scans.shape->maxRange() > 0.0) && !maxRange_)
    remarks_.push_back("the scans of " + scans.topic + " say a greatest range of " +
                       scans.shape->toldRange() +
                       " m: it was taken as 30 m; the option max_range_m sets it");
  scanner.maxRange = maxRange_.value_or(scans.shape->usefulRange());
  const bool isReversed = scans.shape->isClockwise() != isUpsideDown;
  std::vector<Timestamp> stamps;
  std::vector<std::uint32_t> words;
  for (const Bag::Scan& scan : scans.list) {
    ScanData::encode(scan.ranges, *scanner.maxRange, words);
    if (isReversed) std::reverse(words.begin(), words.end());
    add(feature, scan.stamp, words);
    stamps.push_back(scan.stamp);
  }
  sensors_ += scannerToml(scanner, std::clamp(medianPeriod(stamps), 0.001, 3600.0), id);
}

void McapSource::addClouds(const Bag& bag, const Bag::Clouds& clouds) {
  if (clouds.list.empty()) return;
  const bool isOnly = bag.clouds.size() == 1;
  const SensorId id = idFor("", {isOnly ? "lidar" : cleaned(clouds.topic), "LRF", "scan"});
  const auto feature = addFeature(id);
  const Scanner scanner = clouds.shape->scanner();
  std::vector<Timestamp> stamps;
  std::vector<std::uint32_t> words;
  for (const Bag::Scan& scan : clouds.list) {
    ScanData::encode(scan.ranges, *scanner.maxRange, words);
    add(feature, scan.stamp, words);
    stamps.push_back(scan.stamp);
  }
  sensors_ += scannerToml(scanner, std::clamp(medianPeriod(stamps), 0.001, 3600.0), id);
}

void McapSource::addRanges(const Bag& bag, const Bag::Ranges& ranges) {
  SensorId id = idFor(ranges.feature, {"sonar", "ultrasonic", cleaned(ranges.topic) + "_0"});
  const auto feature = addFeature(id);
  const Pose2 mount = mountOf(bag, ranges.frame, ranges.topic, false).first;
  const double maxRange = plain(ranges.maxRange);
  for (const Bag::Reading& one : ranges.list) {
    const std::uint32_t word = ConeData::encode(one.range, maxRange);
    add(feature, one.stamp, {&word, 1});
  }
  if (id.feature.ends_with("0")) id.feature.pop_back();  // the plugin numbers its sonars
  sensors_ +=
      "\n[[sensor]]\nplugin = \"sonar\"\nmodel = " + tomlText(id.model) +
      "\ntype = " + tomlText(id.type) + "\nfeature = " + tomlText(id.feature) +
      "\npose = { x_m = " + tomlNumber(mount.x) + ", y_m = " + tomlNumber(mount.y) +
      ", theta_deg = " + tomlNumber(plain(degrees(mount.theta))) +
      " }\nring_radius_m = 0.0\nopening_deg = " + tomlNumber(plain(degrees(ranges.openingAngle))) +
      "\nmax_range_m = " + tomlNumber(maxRange) + "\n";
}

void McapSource::addPictures(const Bag::Pictures& pictures) {
  const auto feature =
      addFeature(idFor(pictures.feature, {cleaned(pictures.topic), "camera", "image"}));
  for (const Bag::Picture& one : pictures.list) add(feature, one.stamp, one.words);
}

void McapSource::addTruth(const Bag::Track& truth) {
  const auto feature = addFeature(idFor(truth.feature, {"reference", "groundTruth", "pose"}));
  for (const Bag::Moving& one : truth.list) add(feature, one.stamp, PoseData::encode(one.pose));
}

/// Adds words; they replace a message of the same feature and time.
void McapSource::addOwn(const std::string& topic, const Bag::OwnWords& own) {
  const auto known = numbers_.find(own.feature);
  const auto feature = known != numbers_.end()
                           ? known->second
                           : addFeature(idFor(own.feature, {"ros", "words", cleaned(topic)}));
  for (const Bag::Picture& one : own.list) add(feature, one.stamp, one.words);
}

/// Writes the map as map_server does, and a world that consists of it.
void McapSource::writeWorld(const std::filesystem::path& file) const {
  if (!map_)
    throw std::runtime_error(path_ +
                             ": found no nav_msgs/msg/OccupancyGrid, expected one to make "
                             "a world of");
  writeWorldOf(*map_, file);
}

/// The text of `ortung import mcap --help`.
class McapHelp : public SourceHelp {
 public:
  explicit McapHelp(const Parameters&)
      : McapHelp("bag of ROS 2 (MCAP, .db3, also compressed), its folder, or a .bag of ROS 1") {}

 protected:
  explicit McapHelp(const char* path)
      : SourceHelp(
            path,
            {{"scans", "", "all", "topics of sensor_msgs/LaserScan, with commas between them"},
             {"clouds", "", "all, if there are no scans",
              "topics of sensor_msgs/PointCloud2, of lidars that become scanners"},
             {"band", "m", "0.2,1.8",
              "heights above the robot's frame in which their points count: LOW,HIGH or "
              "TOPIC:LOW,HIGH, and ';' between two"},
             {"cloud_beams", "", "360", "beams of such a scanner, all around"},
             {"cloud_min_range_m", "m", "0.5", "points that are nearer are the robot itself"},
             {"level", "", "odometry",
              "what tells the robot's roll and pitch for clouds: a topic of sensor_msgs/Imu, "
              "odometry (its poses in space), or none"},
             {"ranges", "", "all", "topics of sensor_msgs/Range"},
             {"images", "", "none", "topics of sensor_msgs/Image (rgb8, bgr8, mono8)"},
             {"odometry", "", "the first",
              "topic of nav_msgs/Odometry, or tf: the robot's poses at /tf"},
             {"truth", "", "a topic called ground truth",
              "topic of poses or odometry that is the reference; tf: the robot's poses in the map "
              "at /tf; none"},
             {"map", "", "the first", "topic of nav_msgs/OccupancyGrid, for --world"},
             {"base", "", "that of odometry", "frame of the robot"},
             {"mounts", "x,y,theta in m and degrees", "those at /tf_static",
              "mounts of sensors: FRAME:x,y,theta, of lidars FRAME:x,y,theta,z or with ,roll,pitch "
              "behind, "
              "and ';' between two"},
             {"max_range_m", "m", "the scan's, or 30",
              "ranges from here on mean that nothing was seen"},
             {"stamps", "", "header", "header: times of measurement; log: of recording"}}) {}
};

class BagHelp : public McapHelp {
 public:
  explicit BagHelp(const Parameters&) : McapHelp("another name of mcap: takes the same files") {}
};

}  // namespace
}  // namespace ortung::ros2

// Both names mean the same: what a file is, its first bytes tell.
ORTUNG_PLUGINS("mcap_source", ortung::provide<ortung::Source, ortung::ros2::McapSource>("mcap"),
               ortung::provide<ortung::Source, ortung::ros2::McapSource>("bag"),
               ortung::provide<ortung::SourceHelp, ortung::ros2::McapHelp>("mcap"),
               ortung::provide<ortung::SourceHelp, ortung::ros2::BagHelp>("bag"));
