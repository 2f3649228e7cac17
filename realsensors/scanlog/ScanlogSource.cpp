#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "ortung/core/Plugin.hpp"
#include "ortung/core/SourceHelp.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/realsensors/MapFiles.hpp"
#include "ortung/realsensors/OpenWorld.hpp"
#include "ortung/realsensors/ScanLog.hpp"

namespace ortung {
namespace {

constexpr std::size_t kBeforeRanges = 5;  // time, three of odometry, number of beams
constexpr int kFoldersAbove = 2;          // number of parent folders in which a map is searched

const SensorId kReflectors{"laser", "landmarks", "reflectors"};

/// Returns the number right behind @p key in a comment, e.g. "x=" in "sensor at x=+0.78 m".
std::optional<double> numberBehind(const std::string& text, const std::string& key) {
  const std::size_t at = text.find(key);
  if (at == std::string::npos) return std::nullopt;
  const std::size_t begin = text.find_first_not_of(' ', at + key.size());
  if (begin == std::string::npos) return std::nullopt;
  const std::size_t end = text.find_first_not_of("0123456789+-.eE", begin);
  return parseNumber(std::string_view(text).substr(begin, end - begin));
}

/// A folder of plain text files: scans ("time odom_x odom_y odom_theta n r1 ... rn"), a reference
/// (gt or ref: "time x y theta ..."), a separate odometry if the options name one, and a map
/// (YAML). The comment above the scans has the beams' angles.
class ScanlogSource : public ScanLogSource {
 public:
  explicit ScanlogSource(const Parameters& options)
      : ScanLogSource(options), folder_(options.text("path")) {
    readScans();
    readOdometry(options);
    readCommands(options);
    readTruth(options);
    readReflectors(options);
    useMap(fileOption(options, "map", folder_));
    if (map().empty()) findMap();
    finishLog(folder_.string());
  }

 private:
  void readScans();
  Scanner scannerOf(const LogFile& file, const std::string& comment) const;
  void readOdometry(const Parameters& options);
  void readCommands(const Parameters& options);
  void readTruth(const Parameters& options);
  void readReflectors(const Parameters& options);
  void findMap();
  std::string robotToml() const override;
  void writeWorld(const std::filesystem::path& file) const override;

  std::filesystem::path folder_;
  std::filesystem::path reflectorMap_;
  std::string reflectorIdentities_;  ///< identities, e.g. "1, 2, 7"; "": there are none
  Pose2 reflectorMount_;
  double farthestReflector_ = 1.0;  ///< greatest range of a sighting [m]
};

Scanner ScanlogSource::scannerOf(const LogFile& file, const std::string& comment) const {
  Scanner scanner;
  scanner.beams = static_cast<int>(file.integer(kBeforeRanges - 1, "a number of beams", {1, 8192}));
  const std::string listed = "ANGLES ";
  const auto step = numberBehind(comment, "+ k*");
  if (const std::size_t at = comment.find(listed); at != std::string::npos) {
    const auto first = numberBehind(comment, listed);
    const std::size_t blank = comment.find(' ', at + listed.size());
    const auto increment =
        blank == std::string::npos ? std::nullopt : numberBehind(comment.substr(blank), " ");
    if (!first || !increment)
      file.fail("no two numbers behind 'ANGLES' in the comment above",
                "first angle and step [rad]");
    scanner.firstAngle = *first;
    scanner.angleStep = *increment;
  } else if (step && comment.find("angle -pi/2 +") != std::string::npos) {
    scanner.firstAngle = -std::numbers::pi / 2;
    scanner.angleStep = *step;
  } else {
    file.fail("no angles of the beams in the comments above",
              "'ANGLES FIRST STEP' or 'at angle -pi/2 + k*STEP' [rad]");
  }
  if (comment.find(" at x=") != std::string::npos) {
    scanner.mount = {numberBehind(comment, " at x=").value_or(0.0),
                     numberBehind(comment, " y=").value_or(0.0),
                     wrapAngle(numberBehind(comment, " yaw=").value_or(0.0))};
  }
  scanner.maxRange = numberBehind(comment, "max range ");
  return scanner;
}

void ScanlogSource::readScans() {
  LogFile file(folder_ / "scans.txt");
  std::string comment;
  while (file.nextLine()) {
    if (file.isComment()) {
      if (!scanner()) (comment += file.line()) += ' ';
      continue;
    }
    if (file.size() < kBeforeRanges)
      file.needFields(kBeforeRanges + 1, "time, odometry, n, ranges");
    if (!scanner()) useScanner(file, scannerOf(file, comment));
    const auto beams = file.integer(kBeforeRanges - 1, "a number of beams", {1, 8192});
    if (beams != scanner()->beams) {
      file.fail(std::to_string(beams) + " beams", std::to_string(scanner()->beams) + " as above");
    }
    file.needFields(kBeforeRanges + static_cast<std::size_t>(beams), "time, odometry, n, n ranges");
    addScan(file, file.stamp(0), kBeforeRanges, file.pose(1));
  }
}

/// By default the odometry in each scan's line is used: it has the scan's time. A separate file is
/// denser, but may begin elsewhere, so it replaces the other.
void ScanlogSource::readOdometry(const Parameters& options) {
  const auto path = fileOption(options, "odom", folder_);
  if (path.empty()) return;
  LogFile file(path);
  while (file.nextRecord()) {
    file.needFields(4, "time [s], x [m], y [m], theta [rad]");
    addOdometry(file, file.stamp(0), file.pose(1));
  }
}

void ScanlogSource::readCommands(const Parameters& options) {
  constexpr double kFastest = 100.0;  // [m/s], [rad/s]
  const auto path = fileOption(options, "commands", folder_);
  if (path.empty()) return;
  LogFile file(path);
  while (file.nextRecord()) {
    file.needFields(3, "time [s], commanded velocities [m/s] [rad/s]");
    const Range velocities{-kFastest, kFastest};
    addCommand(file, file.stamp(0), file.number(1, "a velocity [m/s]", velocities),
               file.number(2, "a velocity [rad/s]", velocities));
  }
}

void ScanlogSource::readTruth(const Parameters& options) {
  if (options.textOr("gt", "") == "none") return;
  auto path = fileOption(options, "gt", folder_);
  if (path.empty()) {
    // If both files exist, ref.txt is preferred: it was added because gt.txt is not good enough.
    for (const char* name : {"gt.txt", "ref.txt"}) {
      if (findLogFile(folder_ / name)) path = folder_ / name;
    }
    if (path.empty()) return;
  }
  LogFile file(path);
  while (file.nextRecord()) {
    if (file.size() < 4) file.needFields(4, "time [s], x [m], y [m], theta [rad]");
    addTruth(file, file.stamp(0), file.pose(1));
  }
}

/// Reads sightings of reflectors without identity; those of one time are one reading.
void ScanlogSource::readReflectors(const Parameters& options) {
  const auto path = fileOption(options, "reflectors", folder_);
  reflectorMap_ = fileOption(options, "reflector_map", folder_);
  if (path.empty() != reflectorMap_.empty())
    throw std::runtime_error(
        folder_.string() +
        ": found one of the options reflectors and reflector_map, expected both or none");
  if (path.empty()) return;
  OpenWorld world("reflector", 0.0);
  for (LogFile places(reflectorMap_); places.nextRecord();) {
    places.needFields(3, "identity, x, y [m]");
    const auto identity = places.integer(0, "an identity", {0, 1e6});
    world.read(places, static_cast<std::uint32_t>(identity), 1);
  }
  reflectorIdentities_ = world.identities();
  const std::uint32_t feature = addFeature(kReflectors);
  LogFile file(path);
  LandmarksData::Reading sightings;
  std::optional<Timestamp> at;
  while (file.nextLine()) {
    if (file.isComment()) {
      if (const auto x = numberBehind(std::string(file.line()), "sensor at "))
        reflectorMount_.x = *x;
      continue;
    }
    file.needFields(3, "time [s], range [m], bearing [rad]");
    const Timestamp stamp = file.stamp(0);
    if (at && stamp < *at) file.fail("a time before that of the line above", "rising times");
    if (at && stamp > *at) {
      add(feature, *at, LandmarksData::encode(sightings));
      sightings.clear();
    }
    at = stamp;
    const double range = file.number(1, "a range [m]", {0.0, 1000.0});
    farthestReflector_ = std::max(farthestReflector_, range);
    sightings.push_back({LandmarksData::kUnknown, range,
                         wrapAngle(file.number(2, "a bearing [rad]", {-10.0, 10.0}))});
  }
  if (at) add(feature, *at, LandmarksData::encode(sightings));
}

std::string ScanlogSource::robotToml() const {
  std::string text = ScanLogSource::robotToml();
  if (reflectorIdentities_.empty()) return text;
  // Navigation scanners are as high as their reflectors and see over everything lower.
  return text + "\n[[sensor]]\nplugin = \"landmarks\"\nmodel = " + tomlText(kReflectors.model) +
         "\ntype = " + tomlText(kReflectors.type) + "\nfeature = " + tomlText(kReflectors.feature) +
         "\nfeatures = \"list\"\nidentified = false\nkind = \"reflector\"\nidentities = [" +
         reflectorIdentities_ + "]\npose = { x_m = " + tomlNumber(reflectorMount_.x) +
         ", z_m = 2.0 }\nmax_range_m = " + tomlNumber(std::ceil(farthestReflector_)) +
         "\nocclusion = false\nrange_sigma_m = 0.05\nbearing_sigma_deg = 0.3\noutliers = 0.05\n"
         "exponent = 0.3\n";
}

void ScanlogSource::writeWorld(const std::filesystem::path& file) const {
  if (reflectorMap_.empty() || map().empty()) {
    ScanLogSource::writeWorld(file);
  } else {
    writeGridWorld(file, map(), landmarksToml(reflectorMap_, "reflector"));
  }
}

/// Finds map.yaml or the only YAML file, in the folder or up to two folders above.
void ScanlogSource::findMap() {
  std::error_code error;
  std::filesystem::path folder = std::filesystem::absolute(folder_, error).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  for (int i = 0; i <= kFoldersAbove && map().empty(); ++i, folder = folder.parent_path()) {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
      if (entry.path().extension() == ".yaml") found.push_back(entry.path());
    }
    const auto standard = std::find(found.begin(), found.end(), folder / "map.yaml");
    if (standard != found.end())
      useMap(*standard);
    else if (found.size() == 1)
      useMap(found.front());
  }
}

/// The text of `ortung import scanlog --help`.
class ScanlogHelp : public SourceHelp {
 public:
  explicit ScanlogHelp(const Parameters&)
      : SourceHelp(
            "folder with scans.txt",
            withScanLogOptions(
                {{"gt", "", "ref.txt, else gt.txt",
                  "file with the reference: t x y theta; none: no reference"},
                 {"odom", "", "that beside the scans", "file with odometry: t x y theta"},
                 {"commands", "", "none", "file with commanded velocities: t v w"},
                 {"reflectors", "", "none",
                  "file with sightings of reflectors without identity: t range bearing"},
                 {"reflector_map", "", "none", "file with their places: identity x y, for --world"},
                 {"map", "", "map.yaml, or the only *.yaml",
                  "map_server YAML, CARMEN map or grid map of MRPT, for --world"}})) {}
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("scanlog_source", ortung::provide<ortung::Source, ortung::ScanlogSource>("scanlog"),
               ortung::provide<ortung::SourceHelp, ortung::ScanlogHelp>("scanlog"));
