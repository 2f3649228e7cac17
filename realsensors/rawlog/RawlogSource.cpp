#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "ortung/base/Angles.hpp"
#include "ortung/base/HelperProgram.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/core/ReadingLine.hpp"
#include "ortung/core/SourceHelp.hpp"
#include "ortung/core/SourceOptions.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/realsensors/LogSource.hpp"
#include "ortung/realsensors/MapFiles.hpp"
#include "ortung/realsensors/Scanner.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMaxOutput = 1u << 30;  // bytes of readings as text
constexpr std::size_t kMaxFeatures = 4096;
const SensorId kOdometry{"odometry", "odometry", "pose"};
const SensorId kScan{"laser", "LRF", "scan"};
const SensorId kLandmarks{"camera", "landmarks", "posts"};

/// A sensor of landmarks or beacons, as the reader describes it.
struct Observer {
  Pose2 mount;
  double maxRange = 0.0;     ///< greatest range [m]; 0: not known
  double fieldOfView = 0.0;  ///< field of view [rad]; 0: all around
};

/// A rawlog of MRPT. MRPT's readers believe whatever a file says, so a separate program,
/// ortung-mrpt-reader, reads it; its output is checked as hostile input, too.
class RawlogSource : public LogSource {
 public:
  explicit RawlogSource(const Parameters& options)
      : path_(options.text("path")),
        scannerOptions_(options),
        jitter_(optionNumber(options, "jitter_s", 1.0, {0, 3600})) {
    options.textOr("robot_file", "");
    if (!std::filesystem::is_regular_file(path_)) {
      throw std::runtime_error(path_ + ": found no such file, expected a rawlog");
    }
    const auto folder = std::filesystem::path(path_).parent_path();
    map_ = fileOption(options, "map", folder);
    beaconFile_ = fileOption(options, "beacons", folder);
    const auto truth = fileOption(options, "gt", folder);
    for (const SensorId& id : {kOdometry, kScan, kLandmarks})
      features_[toText(id)] = addFeature(id);
    readOutput(runHelper(findHelper("ortung-mrpt-reader", path_),
                         {"rawlog", std::filesystem::absolute(path_).string()}, path_, kMaxOutput));
    if (!truth.empty()) readTruth(truth);
    finish(path_);
  }

  std::string robotToml() const override;
  void writeWorld(const std::filesystem::path& file) const override;
  std::string remark() const override;

 private:
  void readOutput(const std::string& output);
  void readComment(const std::string& line);
  void readMessage(const std::string& line);
  void readTruth(const std::filesystem::path& file);
  std::vector<double> numbersOf(std::istringstream& words, std::size_t count) const;
  Observer observerOf(std::istringstream& words, bool hasFieldOfView) const;
  void checkWords(const Message& message) const;
  void noteIdentities(const Message& message);
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const;

  std::string path_;
  ScannerOptions scannerOptions_;
  double jitter_;
  std::filesystem::path map_;
  std::filesystem::path beaconFile_;  ///< file with the places of the beacons
  std::map<std::string, std::uint32_t> features_;
  std::size_t lineNumber_ = 0;
  std::size_t readings_ = 0;
  bool ended_ = false;
  std::optional<Scanner> scanner_;
  std::optional<Observer> beacons_;
  std::optional<Observer> landmarks_;
  std::set<std::uint32_t> beaconIdentities_;
  std::set<std::uint32_t> landmarkIdentities_;
  std::vector<Timestamp> scanStamps_;
  std::vector<std::string> skipped_;            ///< what the reader left out, and how much of it
  std::map<std::string, Timestamp> newest_;     ///< newest time of each feature
  std::map<std::string, std::size_t> earlier_;  ///< number of readings before it
};

void RawlogSource::fail(const std::string& found, const std::string& expected) const {
  throw std::runtime_error(path_ + ": found " + found + " in line " + std::to_string(lineNumber_) +
                           " of what ortung-mrpt-reader prints, expected " + expected);
}

void RawlogSource::readOutput(const std::string& output) {
  std::size_t begin = 0;
  while (begin < output.size() && !ended_) {
    const std::size_t end = output.find('\n', begin);
    ++lineNumber_;
    if (end == std::string::npos) break;
    const std::string line = output.substr(begin, end - begin);
    line.starts_with("# ") ? readComment(line) : readMessage(line);
    begin = end + 1;
  }
  if (!ended_) fail("its end", "a last line '# end COUNT'");
}

std::vector<double> RawlogSource::numbersOf(std::istringstream& words, std::size_t count) const {
  std::vector<double> numbers;
  std::string word;
  while (numbers.size() < count && words >> word) {
    const auto number = parseNumber(word);
    if (!number || std::abs(*number) > kMaxLogMetres) fail(inQuotes(word), "a number");
    numbers.push_back(*number);
  }
  if (numbers.size() < count || words >> word) {
    fail("a comment of another length", std::to_string(count) + " numbers");
  }
  return numbers;
}

Observer RawlogSource::observerOf(std::istringstream& words, bool hasFieldOfView) const {
  const auto n = numbersOf(words, hasFieldOfView ? 5 : 4);
  if (std::abs(n[0]) > kFarMount || std::abs(n[1]) > kFarMount)
    fail("a sensor that is farther from the robot", "one within 10 m");
  return {{n[0], n[1], wrapAngle(n[2])}, n[3], hasFieldOfView ? n[4] : 0.0};
}

void RawlogSource::readComment(const std::string& line) {
  std::istringstream words(line);
  std::string mark, what;
  words >> mark >> what;
  if (what == "scanner" && !scanner_) {
    const auto n = numbersOf(words, 7);
    Scanner scanner;
    scanner.mount = {n[0], n[1], wrapAngle(n[2])};
    scanner.firstAngle = n[3];
    scanner.angleStep = n[4];
    if (n[5] > 0) scanner.maxRange = n[5];
    scanner.beams = static_cast<int>(n[6]);
    scanner_ = scannerOptions_.apply(scanner, path_);
  } else if (what == "beacons") {
    beacons_ = observerOf(words, false);
  } else if (what == "landmarks") {
    landmarks_ = observerOf(words, true);
  } else if (what == "skipped") {
    constexpr std::size_t kMostSkipped = 32;
    if (skipped_.size() < kMostSkipped) skipped_.push_back(line.substr(line.find("skipped ") + 8));
  } else if (what == "end") {
    const auto n = numbersOf(words, 1);
    if (n[0] != static_cast<double>(readings_)) {
      fail(std::to_string(readings_) + " readings before '" + line + "'", "as many");
    }
    ended_ = true;
  }
}

void RawlogSource::checkWords(const Message& message) const {
  std::size_t expected = message.words.size();
  if (message.id == kOdometry) expected = 5;
  if (message.id == kScan) {
    if (!scanner_) fail("a scan", "a line '# scanner ...' before it");
    expected = static_cast<std::size_t>(scanner_->beams);
  }
  if (message.words.size() != expected || (message.id == kLandmarks && expected % 3 != 0)) {
    fail(std::to_string(message.words.size()) + " words of " + toText(message.id),
         std::to_string(expected));
  }
}

void RawlogSource::noteIdentities(const Message& message) {
  if (message.id == kLandmarks) {
    for (std::size_t i = 0; i < message.words.size(); i += 3)
      landmarkIdentities_.insert(message.words[i]);
  } else if (message.id.feature.starts_with("beacon")) {
    const auto number =
        parseNumber(message.id.feature.substr(6, message.id.feature.find("Distance") - 6));
    if (!number || *number < 0 || *number > 1e6)
      fail(inQuotes(message.id.feature), "beaconNDistance");
    beaconIdentities_.insert(static_cast<std::uint32_t>(*number));
  }
}

void RawlogSource::readMessage(const std::string& line) {
  std::string why;
  const auto message = parseLine(line, &why);
  if (!message) fail(inQuotes(line), "a line of a record (" + why + ")");
  checkWords(*message);
  noteIdentities(*message);
  auto feature = features_.find(toText(message->id));
  if (feature == features_.end()) {
    if (features_.size() == kMaxFeatures)
      fail("more features", "at most " + std::to_string(kMaxFeatures));
    feature = features_.emplace(toText(message->id), addFeature(message->id)).first;
  }
  if (message->id == kScan) scanStamps_.push_back(message->stamp);
  const auto newest = newest_.try_emplace(feature->first, message->stamp).first;
  if (message->stamp < newest->second) ++earlier_[feature->first];
  newest->second = std::max(newest->second, message->stamp);
  add(feature->second, message->stamp, message->words);
  ++readings_;
}

void RawlogSource::readTruth(const std::filesystem::path& path) {
  const auto feature = addFeature({"reference", "groundTruth", "pose"});
  LogFile file(path);
  LogClock clock(jitter_);
  while (file.nextRecord()) {
    if (file.size() < 4) file.needFields(4, "time [s], x [m], y [m], theta [rad]");
    add(feature, clock(file, file.stamp(0)), PoseData::encode(file.pose(1)));
  }
}

std::string RawlogSource::remark() const {
  std::string text;
  const auto tell = [&](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
  for (const std::string& one : skipped_) tell(one + ": left out");
  for (const auto& [feature, count] : earlier_)
    tell(std::to_string(count) + " readings of " + feature +
         " have earlier times than those before them, and were put in the order of time");
  return text;
}

/// Returns the [[sensor]] table of a sensor of landmarks.
std::string observerToml(const Observer& observer, const std::string& names,
                         const std::set<std::uint32_t>& identities) {
  std::string list;
  for (const std::uint32_t identity : identities) {
    list += (list.empty() ? "" : ", ") + std::to_string(identity);
  }
  const double sight = observer.fieldOfView > 0 ? std::min(observer.fieldOfView, kTurn) : kTurn;
  return "\n[[sensor]]\nplugin = \"landmarks\"\n" + names + "identities = [" + list +
         "]\npose = { x_m = " + tomlNumber(observer.mount.x) +
         ", y_m = " + tomlNumber(observer.mount.y) +
         ", theta_deg = " + tomlNumber(degrees(observer.mount.theta)) + " }\nmax_range_m = " +
         tomlNumber(observer.maxRange > 0 ? std::min(observer.maxRange, 1000.0) : 30.0) +
         "\nfov_deg = " + tomlNumber(std::max(1.0, degrees(sight))) + "\n";
}

std::string RawlogSource::robotToml() const {
  std::string text = robotHead(path_);
  if (scanner_) text += scannerToml(*scanner_, medianPeriod(scanStamps_));
  if (!beaconIdentities_.empty()) {
    text += observerToml(
        beacons_.value_or(Observer()),
        "model = \"uwb\"\ntype = \"landmarks\"\nfeatures = \"each\"\nkind = \"beacon\"\n",
        beaconIdentities_);
  }
  if (!landmarkIdentities_.empty()) {
    text += observerToml(landmarks_.value_or(Observer()),
                         "model = \"camera\"\ntype = \"landmarks\"\nfeature = \"posts\"\n"
                         "features = \"list\"\nkind = \"post\"\n",
                         landmarkIdentities_);
  }
  return text;
}

void RawlogSource::writeWorld(const std::filesystem::path& file) const {
  if (map_.empty()) {
    throw std::runtime_error(path_ + ": a rawlog has no map; the option map=FILE names one");
  }
  writeGridWorld(file, map_, beaconFile_.empty() ? "" : landmarksToml(beaconFile_, "beacon"));
}

/// The text of `ortung import rawlog --help`.
class RawlogHelp : public SourceHelp {
 public:
  explicit RawlogHelp(const Parameters&)
      : SourceHelp(
            "rawlog of MRPT",
            withScannerOptions(
                {{"gt", "", "none", "file with the reference: t x y theta"},
                 {"map", "", "none", "map_server YAML or grid map of MRPT, for --world"},
                 {"beacons", "", "none",
                  "file with places of beacons: identity x y [z], for --world"},
                 {"jitter_s", "s", "1", "how far stamps may fall back before it is an error"}})) {}
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("rawlog_source", ortung::provide<ortung::Source, ortung::RawlogSource>("rawlog"),
               ortung::provide<ortung::SourceHelp, ortung::RawlogHelp>("rawlog"));
