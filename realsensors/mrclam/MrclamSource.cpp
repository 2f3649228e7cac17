#include <algorithm>
#include <map>
#include <stdexcept>

#include "ortung/base/NewFile.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/core/SourceHelp.hpp"
#include "ortung/core/SourceOptions.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/realsensors/LogSource.hpp"

namespace ortung {
namespace {

constexpr int kRobots = 5;  // subjects 1 to 5 are robots, the others landmarks
constexpr double kMaxSubject = 1e6;
// Distance from the outermost landmarks to the field's bounds [m]; robots went 1.25 m beyond them
// at most. It does not depend on the robot, so that all robots of a run share a world and a table.
constexpr double kMargin = 2.0;
constexpr double kMaxRange = 10.0;      // [m]; the farthest reading of all runs is 9.6
constexpr double kLatency = 0.04;       // [s]; in run 6 0.034 to 0.049, by robot
constexpr double kMaxVelocity = 100.0;  // [m/s], [rad/s]

// These are near the values measured against Vicon over all robots of run 6
// (realsensors/README.md). Errors are correlated from image to image (each robot has its own bias,
// of bearings up to 0.8 degrees), hence the exponent and a sigma of bearings above the spread.
// Ranges are measured along the optical axis, so they are too short towards the edges of the image,
// by the cosine; biases are means over the five robots. Only sightings with range and bearing have
// them: a range alone does not contain the angle to the axis.
constexpr const char* kBiases = R"(range_bias_m = 0.04
range_bias_per_m = 0.023
range_bias_per_m_rad2 = -0.48
)";
constexpr const char* kModels = R"(range_sigma_m = 0.04
range_sigma_per_m = 0.02
bearing_sigma_deg = 1.2
outliers = 0.1
exponent = 0.2

[mcl]
min_distance_m = 0.02
min_rotation_deg = 1
max_interval_s = 0.3

# Odometry is made of commands. Learned by `ortung learn-motion` from robots 1 and 2 of run 6; the
# others have nearly the same delay and scales.
[motion]
delay_s = 0.2
way_scale = 1.05
turn_scale = 0.94
way_bias_m_per_rad = -0.1
turn_per_turn = 0.1
turn_per_m = 0.05
way_per_m = 0.02
way_per_turn = 0.02
slip_share = 0.15
)";

struct Place {
  double x = 0.0;  ///< place in the field frame [m]
  double y = 0.0;  ///< place in the field frame [m]
};

/// A box that grows to hold points.
struct Box {
  double xLow = 1e9, xHigh = -1e9, yLow = 1e9, yHigh = -1e9;  ///< [m]
  void hold(double x, double y, double margin) {
    xLow = std::min(xLow, x - margin);
    xHigh = std::max(xHigh, x + margin);
    yLow = std::min(yLow, y - margin);
    yHigh = std::max(yHigh, y + margin);
  }
};

/// One robot of a run of UTIAS MRCLAM (Leung et al., IJRR 30(8), 2011): commanded velocities,
/// ranges and bearings of identified landmarks, Vicon poses. The folder holds the run's .dat files.
class MrclamSource : public LogSource {
 public:
  explicit MrclamSource(const Parameters& options)
      : folder_(options.text("path")),
        robot_(static_cast<int>(optionNumber(options, "robot", 1, {1, kRobots}))),
        latency_(optionNumber(options, "latency_s", kLatency, {-1.0, 1.0})),
        jitter_(optionNumber(options, "jitter_s", 0.0, {0.0, 3600.0})),
        each_(options.choiceOr("features", "list", {"list", "each"}) == "each") {
    options.textOr("robot_file", "");
    readLandmarks();
    readBarcodes();
    odometryId_ = addFeature({"odometry", "odometry", "pose"});
    addLandmarkFeatures();
    truthId_ = addFeature({"reference", "groundTruth", "pose"});
    readOdometry();
    readMeasurements();
    readTruth();
    finish(folder_.string());
  }

  std::string robotToml() const override;
  void writeWorld(const std::filesystem::path& file) const override;

 private:
  std::filesystem::path robotFile(const char* what) const {
    return folder_ / ("Robot" + std::to_string(robot_) + "_" + what + ".dat");
  }
  void readLandmarks();
  void readBarcodes();
  void addLandmarkFeatures();
  void readOdometry();
  void readMeasurements();
  void addSightings(Timestamp stamp, const LandmarksData::Reading& sightings);
  void readTruth();
  void readVicon();
  void readStanding();
  void addTruth(Timestamp stamp, const Pose2& pose);

  std::filesystem::path folder_;
  int robot_;
  double latency_;                            ///< delay of the camera's images [s]
  double jitter_;                             ///< how far stamps may fall back [s]
  bool each_;                                 ///< whether every landmark has features of its own
  std::map<std::uint32_t, Place> landmarks_;  ///< places of landmarks by subject
  std::map<std::int64_t, std::uint32_t> subjects_;  ///< subjects by barcode
  std::uint32_t odometryId_ = 0;
  std::uint32_t truthId_ = 0;
  std::uint32_t listId_ = 0;
  std::map<std::uint32_t, std::uint32_t> distanceIds_;  ///< feature by subject; the bearing follows
  Timestamp first_ = 0;                                 ///< first stamp of odometry
  Timestamp last_ = 0;                                  ///< last stamp of odometry
  Box field_;
};

void MrclamSource::readLandmarks() {
  LogFile file(folder_ / "Landmark_Groundtruth.dat");
  while (file.nextRecord()) {
    file.needFields(5, "subject, x, y and their standard deviations [m]");
    const auto subject = static_cast<std::uint32_t>(
        file.integer(0, "a landmark's subject", {kRobots + 1, kMaxSubject}));
    const Range metres{-kMaxLogMetres, kMaxLogMetres};
    const Place place{file.number(1, "x [m]", metres), file.number(2, "y [m]", metres)};
    if (!landmarks_.emplace(subject, place).second) {
      file.fail("subject " + std::to_string(subject) + " twice", "each once");
    }
    field_.hold(place.x, place.y, kMargin);
  }
  if (landmarks_.empty()) file.fail("no landmark", "at least one");
}

void MrclamSource::readBarcodes() {
  LogFile file(folder_ / "Barcodes.dat");
  while (file.nextRecord()) {
    file.needFields(2, "subject and barcode");
    const auto subject = static_cast<std::uint32_t>(file.integer(0, "a subject", {1, kMaxSubject}));
    const std::int64_t barcode = file.integer(1, "a barcode", {0, kMaxSubject});
    if (!subjects_.emplace(barcode, subject).second) {
      file.fail("barcode " + std::to_string(barcode) + " twice", "each once");
    }
  }
}

void MrclamSource::addLandmarkFeatures() {
  if (!each_) {
    listId_ = addFeature({"camera", "landmarks", "posts"});
    return;
  }
  for (const auto& [subject, place] : landmarks_) {
    const std::string name = "post" + std::to_string(subject);
    distanceIds_[subject] = addFeature({"camera", "landmarks", name + "Distance"});
    addFeature({"camera", "landmarks", name + "Bearing"});
  }
}

/// Reads velocities. Those of a line hold from its time until that of the next line.
void MrclamSource::readOdometry() {
  if (!findLogFile(robotFile("Odometry"))) {
    throw std::runtime_error(robotFile("Odometry").string() + ": found no odometry of robot " +
                             std::to_string(robot_) +
                             " in this run, expected one (it may end in"
                             " .xz or .gz); the option robot chooses another robot");
  }
  LogFile file(robotFile("Odometry"));
  LogClock clock(jitter_);
  OdometryData::Reading state;
  bool isFirst = true;
  const Range velocities{-kMaxVelocity, kMaxVelocity};
  while (file.nextRecord()) {
    file.needFields(3, "time [s], velocities [m/s] [rad/s]");
    const Timestamp stamp = clock(file, file.stamp(0));
    if (isFirst) {
      first_ = stamp;
    } else {
      state.pose = alongArc(state.pose, state.translationalVelocity, state.rotationalVelocity,
                            toSeconds(stamp - last_));
    }
    state.translationalVelocity = file.number(1, "a velocity [m/s]", velocities);
    state.rotationalVelocity = file.number(2, "a velocity [rad/s]", velocities);
    add(odometryId_, stamp, OdometryData::encode(state));
    last_ = stamp;
    isFirst = false;
  }
}

void MrclamSource::readMeasurements() {
  LogFile file(robotFile("Measurement"));
  LandmarksData::Reading sightings;
  std::optional<Timestamp> image;
  while (file.nextRecord()) {
    file.needFields(4, "time [s], barcode, range [m], bearing [rad]");
    const Timestamp stamp = file.stamp(0);
    if (image && stamp < *image) file.fail("a time before that of the line above", "rising times");
    if (image && stamp > *image) {
      addSightings(*image, sightings);
      sightings.clear();
    }
    image = stamp;
    const auto subject = subjects_.find(file.integer(1, "a barcode", {0, kMaxSubject}));
    const double range = file.number(2, "a range [m]", {0.0, 1000.0});
    const double bearing = file.number(3, "a bearing [rad]", {-10.0, 10.0});
    // Unknown barcodes are misread ones; those of other robots are not landmarks.
    if (subject == subjects_.end() || !landmarks_.contains(subject->second)) continue;
    sightings.push_back({subject->second, range, wrapAngle(bearing)});
  }
  if (image) addSightings(*image, sightings);
}

void MrclamSource::addSightings(Timestamp stamp, const LandmarksData::Reading& sightings) {
  const Timestamp taken = stamp - fromSeconds(latency_);
  if (!each_) {
    add(listId_, taken, LandmarksData::encode(sightings));
    return;
  }
  for (const auto& sighting : sightings) {
    const std::uint32_t feature = distanceIds_.at(sighting.identity);
    add(feature, taken, ScalarData::encode(sighting.range));
    add(feature + 1, taken, BearingData::encode(sighting.bearing));
  }
}

void MrclamSource::readTruth() {
  if (findLogFile(robotFile("Groundtruth"))) {
    readVicon();
  } else if (findLogFile(robotFile("SparseGroundtruth"))) {
    readStanding();
  }
}

void MrclamSource::addTruth(Timestamp stamp, const Pose2& pose) {
  if (stamp < first_ || stamp > last_) return;  // Vicon recorded longer than the robot
  add(truthId_, stamp, PoseData::encode(pose));
}

void MrclamSource::readVicon() {
  LogFile file(robotFile("Groundtruth"));
  LogClock clock(jitter_);
  while (file.nextRecord()) {
    file.needFields(4, "time [s], x [m], y [m], theta [rad]");
    addTruth(clock(file, file.stamp(0)), file.pose(1));
  }
}

/// Reads poses of the stationary robot, each valid from tmin to tmax; lines of one t share a time.
void MrclamSource::readStanding() {
  LogFile file(robotFile("SparseGroundtruth"));
  std::optional<Timestamp> last;
  while (file.nextRecord()) {
    file.needFields(7, "time, first, last time [s], x [m], y [m], theta [rad], landmarks seen");
    const Timestamp stamp = file.stamp(0);
    const Timestamp begin = file.stamp(1);
    const Timestamp end = file.stamp(2);
    if (begin > stamp || stamp > end)
      file.fail("a time outside of its span", "first <= time <= last");
    if (last && stamp < *last) file.fail("a time before that of the line above", "rising times");
    last = stamp;
    for (const Timestamp t : {begin, stamp, end}) addTruth(t, file.pose(3));
  }
}

std::string MrclamSource::robotToml() const {
  std::string identities;
  for (const auto& [subject, place] : landmarks_) {
    identities += (identities.empty() ? "" : ", ") + std::to_string(subject);
  }
  return "# iRobot Create with a camera (UTIAS MRCLAM). Noise: see realsensors/README.md.\n"
         "[robot]\nname = \"mrclam" +
         std::to_string(robot_) +
         "\"\nradius_m = 0.17\n"
         "\n[[sensor]]\nplugin = \"odometry\"\n"
         "\n[[sensor]]\nplugin = \"landmarks\"\nmodel = \"camera\"\ntype = \"landmarks\"\n" +
         std::string(each_ ? "features = \"each\"\n"
                           : "feature = \"posts\"\nfeatures = \"list\"\n") +
         "kind = \"post\"\nidentities = [" + identities +
         "]\nmax_range_m = " + tomlNumber(kMaxRange) + "\nfov_deg = 70.0\n" +
         (each_ ? "" : kBiases) + kModels;
}

void MrclamSource::writeWorld(const std::filesystem::path& file) const {
  std::string text = "[world]\nname = " + tomlText(file.stem().string()) + "\nx_m = [" +
                     tomlNumber(field_.xLow) + ", " + tomlNumber(field_.xHigh) + "]\ny_m = [" +
                     tomlNumber(field_.yLow) + ", " + tomlNumber(field_.yHigh) + "]\n";
  for (const auto& [subject, place] : landmarks_) {
    text += "\n[[landmark]]\nkind = \"post\"\nidentity = " + std::to_string(subject) +
            "\nposition_m = [" + tomlNumber(place.x) + ", " + tomlNumber(place.y) + "]\n";
  }
  writeFile(file, text);
}

/// The text of `ortung import mrclam --help`.
class MrclamHelp : public SourceHelp {
 public:
  explicit MrclamHelp(const Parameters&)
      : SourceHelp("folder of a run of UTIAS MRCLAM",
                   {{"robot", "", "1", "number of the robot, 1 to 5"},
                    {"features", "", "list",
                     "list: all landmarks of an image in one feature; each: distance and bearing "
                     "of each are features"},
                    {"latency_s", "s", "0.04", "delay of images, subtracted from their stamps"},
                    {"jitter_s", "s", "0", "how far stamps may fall back before it is an error"}}) {
  }
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("mrclam_source", ortung::provide<ortung::Source, ortung::MrclamSource>("mrclam"),
               ortung::provide<ortung::SourceHelp, ortung::MrclamHelp>("mrclam"));
