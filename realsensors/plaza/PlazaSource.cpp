#include <algorithm>
#include <cmath>
#include <map>

#include "ortung/base/Angles.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/core/SourceHelp.hpp"
#include "ortung/core/SourceOptions.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/realsensors/LogSource.hpp"
#include "ortung/realsensors/OpenWorld.hpp"

namespace ortung {
namespace {

constexpr double kMargin = 10.0;  // distance from beacons to bounds [m]; the mower went 2 m beyond
constexpr double kMaxIdentity = 1e6;
// Measured range / distance, fitted to the first half of plaza1 against GPS; 1.070 to 1.073 in the
// second half.
constexpr double kScale = 1.07;

/// A run of the Plaza data (Djugash, CMU): ranges of ultra-wideband beacons, wheel and gyro, GPS.
/// Files NAME_DR, NAME_TD, NAME_TL and, if it is there, NAME_GT (.txt).
class PlazaSource : public LogSource {
 public:
  explicit PlazaSource(const Parameters& options)
      : path_(options.text("path")),
        run_(runOf(options, path_, "_TL.txt")),
        jitter_(optionNumber(options, "jitter_s", 1.0, {0.0, 3600.0})) {
    options.textOr("robot_file", "");
    readBeacons();
    odometryId_ = addFeature({"odometry", "odometry", "pose"});
    readOdometry();
    readRanges();
    readTruth();
    finish(path_.string());
  }

  std::string robotToml() const override;
  void writeWorld(const std::filesystem::path& file) const override { beacons_.write(file); }

 private:
  std::filesystem::path file(const char* what) const { return path_ / (run_ + what); }
  void readBeacons();
  void readOdometry();
  void readRanges();
  void readTruth();

  std::filesystem::path path_;
  std::string run_;
  double jitter_;  ///< how far stamps may fall back [s]
  OpenWorld beacons_{"beacon", kMargin};
  std::map<std::uint32_t, std::uint32_t> features_;  ///< number of each beacon's feature
  std::uint32_t odometryId_ = 0;
};

std::uint32_t identityOf(const LogFile& file, std::size_t field) {
  return static_cast<std::uint32_t>(file.integer(field, "a beacon's identity", {0, kMaxIdentity}));
}

void PlazaSource::readBeacons() {
  LogFile log(file("_TL.txt"));
  while (log.nextRecord()) {
    log.needFields(3, "identity, x, y [m]");
    const std::uint32_t identity = identityOf(log, 0);
    beacons_.read(log, identity, 1);
    features_[identity] =
        addFeature({"uwb", "landmarks", "beacon" + std::to_string(identity) + "Distance"});
  }
  if (beacons_.isEmpty()) log.fail("no beacon", "at least one");
}

/// Reads odometry: each line has the distance travelled and the turn since the line before.
void PlazaSource::readOdometry() {
  LogFile log(file("_DR.txt"));
  LogClock clock(jitter_);
  PoseOdometry odometry;
  Pose2 pose;
  while (log.nextRecord()) {
    log.needFields(3, "time [s], distance travelled [m], turn [rad]");
    const Timestamp stamp = clock(log, log.stamp(0));
    const double travelled = log.number(1, "a distance travelled [m]", {-100.0, 100.0});
    pose = alongArc(pose, travelled, log.number(2, "a turn [rad]", {-10.0, 10.0}), 1.0);
    add(odometryId_, stamp, odometry.words(stamp, pose));
  }
}

/// Reads ranges. Some are a minute late in the file, with the right stamps.
void PlazaSource::readRanges() {
  LogFile log(file("_TD.txt"));
  while (log.nextRecord()) {
    log.needFields(4, "time [s], sender, receiver, range [m]");
    const auto feature = features_.find(identityOf(log, 2));
    if (feature == features_.end())
      log.fail("a range to beacon " + inQuotes(log.text(2)), "one of " + beacons_.identities());
    const double range = log.number(3, "a range [m]", {0.0, 10000.0});
    add(feature->second, log.stamp(0), ScalarData::encode(range));
  }
}

/// Reads GPS poses. Headings of some runs are reversed: a comment says "add NUMBER to heading".
void PlazaSource::readTruth() {
  if (!findLogFile(file("_GT.txt"))) return;
  const auto feature = addFeature({"reference", "groundTruth", "pose"});
  LogFile log(file("_GT.txt"));
  LogClock clock(jitter_);
  double turned = 0.0;
  while (log.nextLine()) {
    if (log.isComment()) {
      for (std::size_t i = 0; i + 3 < log.size(); ++i) {
        if (log.text(i) == "add" && log.text(i + 2) == "to" && log.text(i + 3) == "heading")
          turned = log.number(i + 1, "an angle [rad]", {-10.0, 10.0});
      }
      continue;
    }
    log.needFields(4, "time [s], x [m], y [m], theta [rad]");
    Pose2 pose = log.pose(1);
    pose.theta = wrapAngle(pose.theta + turned);
    add(feature, clock(log, log.stamp(0)), PoseData::encode(pose));
  }
}

std::string PlazaSource::robotToml() const {
  return "# A mower with ultra-wideband beacons (CMU Plaza). Noise: see realsensors/README.md.\n"
         "[robot]\nname = " +
         tomlText(run_) +
         "\nradius_m = 0.5\n\n[[sensor]]\nplugin = \"odometry\"\n"
         "\n[[sensor]]\nplugin = \"landmarks\"\nmodel = \"uwb\"\ntype = \"landmarks\"\n"
         "features = \"distances\"\nkind = \"beacon\"\nidentities = [" +
         beacons_.identities() +
         "]\nmax_range_m = " + tomlNumber(std::ceil(kScale * beacons_.diagonal())) +
         "\nrange_scale = " + tomlNumber(kScale) +
         "\nrange_sigma_m = 0.55\noutliers = 0.02\n"
         "\n[mcl]\nmin_distance_m = 0.0\nmin_rotation_deg = 0.0\nmax_interval_s = 0.2\n"
         "\n# The gyro belongs to the GPS's inertial system.\n[motion]\nturn_per_turn = 0.02\n"
         "turn_per_m = 0.005\nway_per_m = 0.02\nway_per_turn = 0.02\n";
}

/// The text of `ortung import plaza --help`.
class PlazaHelp : public SourceHelp {
 public:
  explicit PlazaHelp(const Parameters&)
      : SourceHelp("folder with NAME_DR.txt, NAME_TD.txt, NAME_TL.txt",
                   {{"run", "", "the only one", "NAME, the beginning of the files' names"},
                    {"jitter_s", "s", "1", "how far stamps may fall back before it is an error"}}) {
  }
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("plaza_source", ortung::provide<ortung::Source, ortung::PlazaSource>("plaza"),
               ortung::provide<ortung::SourceHelp, ortung::PlazaHelp>("plaza"));
