#include <cmath>
#include <optional>
#include <stdexcept>

#include "ortung/base/Pose2.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/core/SourceHelp.hpp"
#include "ortung/core/SourceOptions.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/Words.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/realsensors/LogSource.hpp"
#include "ortung/realsensors/OpenWorld.hpp"
#include "ortung/realsensors/Scanner.hpp"

namespace ortung {
namespace {

constexpr double kMillimetre = 0.001;
// The robot and its scanner, according to the lectures that the log is from.
constexpr double kMetresPerTick = 0.000349;
constexpr double kWidth = 0.173;                     // distance between the tracks [m]
constexpr double kScannerAhead = 0.030;              // distance of the scanner ahead [m]
constexpr double kAnglePerBeam = 0.006135923151543;  // angle between beams [rad]
constexpr double kAngleOff = -0.06981317;            // angle of the beam in the middle [rad]
constexpr double kLatency = 0.42;  // delay of scans in the first half of the log [s]
constexpr double kMaxRange = 4.0;  // [m]; the arena is 2 m wide
constexpr double kMargin = 0.5;    // distance from the outermost cylinders to the bounds [m]
constexpr double kWayStep = 0.02;  // distance travelled over which a heading is taken [m]
constexpr std::int64_t kMostTicks = 1LL << 40;
constexpr double kMostMillimetres = 1e5;

/// A run of the robot of C. Brenner's lectures on SLAM (Hannover): motor ticks, scans of an arena
/// with cylinders, and places of the scanner by an overhead camera. The path is the beginning of
/// the files' names, e.g. "lego_brenner/robot4"; the cylinders are in robot_arena_landmarks.txt
/// beside them. Stamps are in milliseconds.
class LegoSource : public LogSource {
 public:
  explicit LegoSource(const Parameters& options)
      : path_(options.text("path")),
        latency_(optionNumber(options, "latency_s", kLatency, {-1.0, 1.0})),
        jitter_(optionNumber(options, "jitter_s", 0.0, {0.0, 3600.0})) {
    options.textOr("robot_file", "");
    readCylinders();
    odometryId_ = addFeature({"odometry", "odometry", "pose"});
    scanId_ = addFeature({"laser", "LRF", "scan"});
    readMotors();
    readScans();
    readReference();
    finish(path_);
  }

  std::string robotToml() const override;
  void writeWorld(const std::filesystem::path& file) const override { cylinders_.write(file); }

 private:
  std::filesystem::path file(const char* ending) const { return path_ + ending; }
  static Timestamp stampOf(const LogFile& file) {
    return file.integer(1, "a time [ms]", {0, 1e12}) * 1000;
  }
  void readCylinders();
  void readMotors();
  void readScans();
  void readReference();

  std::string path_;
  double latency_;  ///< delay of scans [s]
  double jitter_;   ///< how far stamps may fall back [s]
  OpenWorld cylinders_{"cylinder", kMargin};
  double radius_ = 0.0;  ///< radius of all cylinders [m]
  std::uint32_t odometryId_ = 0;
  std::uint32_t scanId_ = 0;
  int beams_ = 0;
  std::vector<Timestamp> scanStamps_;
};

/// Reads lines "L C x y radius" [mm]. (Scans show that it is the radius: cylinders are 0.1 m wide.)
void LegoSource::readCylinders() {
  const auto folder = std::filesystem::path(path_).parent_path();
  LogFile file(folder / "robot_arena_landmarks.txt");
  std::uint32_t count = 0;
  while (file.nextRecord()) {
    file.needFields(5, "'L', 'C', x, y and radius [mm]");
    const Range millimetres{-kMostMillimetres, kMostMillimetres};
    cylinders_.add(file, ++count, kMillimetre * file.number(2, "x [mm]", millimetres),
                   kMillimetre * file.number(3, "y [mm]", millimetres));
    const double radius = kMillimetre * file.number(4, "a radius [mm]", {5.0, 5000.0});
    if (count > 1 && radius != radius_)
      file.fail("another radius", "all cylinders to be as wide as the first one");
    radius_ = radius;
  }
  if (count == 0) file.fail("no cylinder", "at least one");
}

/// Reads lines "M time left ... right ...": the tracks' ticks are in fields 3 and 7.
void LegoSource::readMotors() {
  constexpr std::size_t kLeft = 2;
  constexpr std::size_t kRight = 6;
  LogFile file(this->file("_motors.txt"));
  LogClock clock(jitter_);
  PoseOdometry odometry;
  Pose2 pose;
  std::optional<std::pair<std::int64_t, std::int64_t>> last;
  while (file.nextRecord()) {
    if (file.size() <= kRight) file.needFields(kRight + 1, "'M', time [ms], ticks");
    const Range ticks{-static_cast<double>(kMostTicks), static_cast<double>(kMostTicks)};
    const std::int64_t left = file.integer(kLeft, "ticks", ticks);
    const std::int64_t right = file.integer(kRight, "ticks", ticks);
    if (last) {
      const double l = kMetresPerTick * static_cast<double>(left - last->first);
      const double r = kMetresPerTick * static_cast<double>(right - last->second);
      if (std::abs(l) > 10.0 || std::abs(r) > 10.0)
        file.fail("a step of more than 10 m", "ticks that count on from line to line");
      pose = alongArc(pose, 0.5 * (l + r), (r - l) / kWidth, 1.0);
    }
    last = {left, right};
    const Timestamp stamp = clock(file, stampOf(file));
    add(odometryId_, stamp, odometry.words(stamp, pose));
  }
}

/// Reads lines "S time n r1 ... rn" [mm].
void LegoSource::readScans() {
  constexpr std::size_t kBeforeRanges = 3;
  LogFile file(this->file("_scan.txt"));
  LogClock clock(jitter_);
  std::vector<std::uint32_t> words;
  while (file.nextRecord()) {
    if (file.size() < kBeforeRanges) file.needFields(kBeforeRanges + 1, "'S', time, n, ranges");
    const auto beams = static_cast<int>(file.integer(2, "a number of beams", {1, 1000}));
    if (beams_ != 0 && beams != beams_)
      file.fail(std::to_string(beams) + " beams", std::to_string(beams_) + " as above");
    beams_ = beams;
    file.needFields(kBeforeRanges + static_cast<std::size_t>(beams), "'S', time, n, n ranges");
    words.clear();
    for (int i = 0; i < beams; ++i) {
      const auto field = kBeforeRanges + static_cast<std::size_t>(i);
      words.push_back(words::fromMetres(kMillimetre *
                                        file.number(field, "a range [mm]", {0, kMostMillimetres})));
    }
    scanStamps_.push_back(clock(file, stampOf(file)) - fromSeconds(latency_));
    add(scanId_, scanStamps_.back(), words);
  }
  if (beams_ == 0) file.fail("no scan", "at least one");
}

/// Reads lines "P time x y" [mm], places of the scanner. Headings are directions of travel.
void LegoSource::readReference() {
  if (!findLogFile(this->file("_reference.txt"))) return;
  const std::uint32_t feature = addFeature({"reference", "groundTruth", "pose"});
  LogFile file(this->file("_reference.txt"));
  LogClock clock(jitter_);
  std::vector<Timestamp> stamps;
  std::vector<Pose2> places;
  const Range millimetres{-kMostMillimetres, kMostMillimetres};
  while (file.nextRecord()) {
    file.needFields(4, "'P', time [ms], x, y [mm]");
    places.push_back({kMillimetre * file.number(2, "x [mm]", millimetres),
                      kMillimetre * file.number(3, "y [mm]", millimetres), 0.0});
    stamps.push_back(clock(file, stampOf(file)));
  }
  const std::vector<double> headings = headingsOfWay(places, kWayStep);
  const Pose2 back{-kScannerAhead, 0.0, 0.0};
  for (std::size_t i = 0; i < places.size(); ++i)
    add(feature, stamps[i], PoseData::encode(Pose2{places[i].x, places[i].y, headings[i]} * back));
}

std::string LegoSource::robotToml() const {
  Scanner scanner;
  scanner.mount = {kScannerAhead, 0.0, 0.0};
  scanner.beams = beams_;
  scanner.firstAngle = kAngleOff - kAnglePerBeam * (beams_ / 2);
  scanner.angleStep = kAnglePerBeam;
  scanner.maxRange = kMaxRange;
  return robotHead(path_) + scannerToml(scanner, medianPeriod(scanStamps_)) +
         // The arena's walls are not in the map, so the scans alone can't localize.
         "localizes = false\n\n[[sensor]]\nplugin = \"lrf_cylinders\"\nmodel = \"laser\"\n"
         "type = \"landmarks\"\nreads = \"laser/LRF/scan\"\npose = { x_m = " +
         tomlNumber(kScannerAhead) + " }\nidentities = [" + cylinders_.identities() +
         "]\nradius_m = " + tomlNumber(radius_) + "\nmax_range_m = " + tomlNumber(kMaxRange) +
         // `ortung calibrate noise` learns these from the first half of the log.
         "\nrange_bias_m = -0.12\nrange_bias_per_m = -0.02\nrange_sigma_m = 0.04\n"
         "bearing_sigma_deg = 3.0\noutliers = 0.1\nexponent = 0.3\n";
}

/// The text of `ortung import lego --help`.
class LegoHelp : public SourceHelp {
 public:
  explicit LegoHelp(const Parameters&)
      : SourceHelp("path and NAME of NAME_motors.txt, NAME_scan.txt, NAME_reference.txt",
                   {{"latency_s", "s", "0.42", "delay of scans, subtracted from their stamps"},
                    {"jitter_s", "s", "0", "how far stamps may fall back before it is an error"}}) {
  }
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("lego_source", ortung::provide<ortung::Source, ortung::LegoSource>("lego"),
               ortung::provide<ortung::SourceHelp, ortung::LegoHelp>("lego"));
