#include <numbers>
#include <string_view>

#include "ortung/base/Angles.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/core/SourceHelp.hpp"
#include "ortung/core/SourceOptions.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/realsensors/LogSource.hpp"
#include "ortung/realsensors/OpenWorld.hpp"

namespace ortung {
namespace {

constexpr double kMargin = 0.5;  // distance from the beacons to the bounds [m]

/// Bearings of beacons, measured by a stationary robot (Roh, KAIST, in the Triangulation Toolbox):
/// a CSV file with a bearing [deg] of each beacon in a line. Its name "(X1.5,Y3.0).csv" is the
/// robot's place, with a heading of 90 degrees; landmark.csv beside it has the beacons.
class RohSource : public LogSource {
 public:
  explicit RohSource(const Parameters& options)
      : path_(options.text("path")),
        period_(optionNumber(options, "period_s", 0.1, {1e-3, 3600.0})) {
    options.textOr("robot_file", "");
    readBeacons();
    const Pose2 truth = placeOf(path_.filename().string());
    const auto odometry = addFeature({"odometry", "odometry", "pose"});
    const auto reference = addFeature({"reference", "groundTruth", "pose"});
    const Timestamp last = readBearings();
    for (Timestamp at = 0; at <= last; at += fromSeconds(period_)) {
      add(odometry, at, OdometryData::encode({{}, 0.0, 0.0, {}}));
      add(reference, at, PoseData::encode(truth));
    }
    finish(path_.string());
  }

  std::string robotToml() const override;
  void writeWorld(const std::filesystem::path& file) const override { beacons_.write(file); }

 private:
  Pose2 placeOf(std::string_view name) const;
  void readBeacons();
  Timestamp readBearings();

  std::filesystem::path path_;
  double period_;  ///< time between two lines, which have no stamps [s]
  std::uint32_t count_ = 0;
  OpenWorld beacons_{"beacon", kMargin};
};

/// Returns the pose in a file's name.
Pose2 RohSource::placeOf(std::string_view name) const {
  const std::size_t comma = name.find(",Y");
  const std::size_t end = name.find(')');
  if (name.starts_with("(X") && comma != name.npos && end != name.npos && comma + 2 < end) {
    const auto x = parseNumber(name.substr(2, comma - 2));
    const auto y = parseNumber(name.substr(comma + 2, end - comma - 2));
    if (x && y && std::abs(*x) < 1000.0 && std::abs(*y) < 1000.0)
      return {*x, *y, std::numbers::pi / 2};
  }
  throw std::runtime_error(path_.string() + ": found the name " + inQuotes(name) +
                           ", expected one like '(X1.5,Y3.0).csv', the place of the robot");
}

void RohSource::readBeacons() {
  LogFile file(path_.parent_path() / "landmark.csv", LogFile::kCommas);
  while (file.nextRecord()) {
    file.needFields(2, "x, y [m]");
    beacons_.read(file, ++count_, 0);
    addFeature({"beacons", "landmarks", "beacon" + std::to_string(count_) + "Bearing"});
  }
  if (beacons_.isEmpty()) file.fail("no beacon", "at least one");
}

/// Reads all bearings. @return the time of the last line
Timestamp RohSource::readBearings() {
  LogFile file(path_, LogFile::kCommas);
  Timestamp stamp = 0;
  for (std::int64_t line = 0; file.nextRecord(); ++line) {
    file.needFields(count_, "a bearing [deg] of each beacon");
    stamp = line * fromSeconds(period_);
    for (std::uint32_t i = 0; i < count_; ++i) {
      const double bearing = file.number(i, "a bearing [deg]", {-360.0, 360.0});
      add(i, stamp, BearingData::encode(wrapAngle(radians(bearing))));
    }
  }
  return stamp;
}

std::string RohSource::robotToml() const {
  return "# A turning infrared detector among beacons (Roh, KAIST). Noise: see "
         "realsensors/README.md.\n[robot]\nname = \"roh\"\nradius_m = 0.2\n"
         "\n[[sensor]]\nplugin = \"odometry\"\n"
         "\n[[sensor]]\nplugin = \"landmarks\"\nmodel = \"beacons\"\ntype = \"landmarks\"\n"
         "features = \"bearings\"\nkind = \"beacon\"\nidentities = [" +
         beacons_.identities() + "]\nmax_range_m = 20.0\n" +
         "bearing_sigma_deg = 3.0\noutliers = 0.05\nexponent = 0.1\n";
}

/// The text of `ortung import roh --help`.
class RohHelp : public SourceHelp {
 public:
  explicit RohHelp(const Parameters&)
      : SourceHelp("file '(X1.5,Y3.0).csv' with bearings, beside landmark.csv",
                   {{"period_s", "s", "0.1", "time between two lines, which have no stamps"}}) {}
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("roh_source", ortung::provide<ortung::Source, ortung::RohSource>("roh"),
               ortung::provide<ortung::SourceHelp, ortung::RohHelp>("roh"));
