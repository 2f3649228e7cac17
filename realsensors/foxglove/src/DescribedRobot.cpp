#include "DescribedRobot.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "BoardReplies.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/core/Format.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung::foxglove {
namespace {

/// A feature of which a message needs no more than what its format says of the words.
class DescribedData : public SensorData {
 public:
  DescribedData(SensorId id, const Pose2& mount, Format format)
      : SensorData(std::move(id), mount),
        format_(std::move(format)),
        row_(format_.has("row") ? format_.list("row").size() : 1) {}
  Format format() const override { return format_; }
  std::string wordsHelp() const override { return format_.toText(); }

 private:
  // Of the words of its own formats the board has refused what is wrong.
  void check(std::span<const std::uint32_t> words) const override {
    if (words.size() % row_ != 0)
      throw std::invalid_argument("found " + std::to_string(words.size()) +
                                  " words, expected whole rows");
  }
  void decode(std::span<const std::uint32_t>) override {}

  Format format_;
  std::size_t row_;  ///< words of one
};

/// What a board says of one feature.
struct Described {
  SensorId id;
  std::optional<Format> format;
  Pose2 mount;
};

int beamsOf(const Format& format) {
  constexpr double kMost = 1e6;  // ScanData knows better
  const double beams = format.number("beams");
  if (beams != std::nearbyint(beams) || std::abs(beams) > kMost)
    throw std::invalid_argument("found " + format.toText() + ", expected a number of beams");
  return static_cast<int>(beams);
}

/// A feature of a format that messages are made of; of any other what its words mean.
/// @throws std::invalid_argument for parameters of none
std::unique_ptr<SensorData> featureOf(const SensorId& id, const Pose2& mount,
                                      const Format& format) {
  if (format.name() == formats::kScan) {
    ScanData::Config scan;
    scan.beams = beamsOf(format);
    scan.firstAngle = format.angle("first_deg");
    scan.angleStep = format.angle("step_deg");
    scan.maxRange = format.number("max_m");
    return std::make_unique<ScanData>(id, mount, scan);
  }
  if (format.name() == formats::kCone) {
    ConeData::Config cone;
    cone.openingAngle = format.angle("opening_deg");
    cone.maxRange = format.number("max_m");
    return std::make_unique<ConeData>(id, mount, cone);
  }
  if (format.name() == formats::kOdometry) return std::make_unique<OdometryData>(id);
  if (format.name() == formats::kPose) return std::make_unique<PoseData>(id);
  if (format.name() == formats::kFix)
    return std::make_unique<PoseFixData>(id, PoseFixData::Config{});
  if (format.name() == formats::kImage) return std::make_unique<ImageData>(id, mount);
  return std::make_unique<DescribedData>(id, mount, format);
}

/// The word at the beginning, which is taken away.
std::string_view nextWord(std::string_view& text) {
  const std::string_view word = text.substr(0, text.find(' '));
  text.remove_prefix(std::min(word.size() + 1, text.size()));
  return word;
}

/// Takes over a line "format MODEL/TYPE/FEATURE NAME key=value ..." without its first word.
void takeFormat(std::string_view text, std::map<std::string, Described>& features) {
  const auto feature = features.find(std::string(nextWord(text)));
  if (feature == features.end()) return;
  try {
    feature->second.format = parseFormat(text);
  } catch (const std::invalid_argument&) {
    return;  // of a later board
  }
}

/// Takes over a line "mount MODEL/TYPE/FEATURE x_m= y_m= theta_rad=" without its first word.
void takeMount(std::string_view text, std::map<std::string, Described>& features) {
  const BoardReply parsed = parseBoardLine(text);
  if (parsed.words.empty()) return;
  const auto feature = features.find(parsed.words[0]);
  if (feature == features.end()) return;
  feature->second.mount = {parsed.real("x_m").value_or(0.0), parsed.real("y_m").value_or(0.0),
                           parsed.real("theta_rad").value_or(0.0)};
}

/// The features of a robot, in the order of the board, and by name what is said of them.
std::pair<std::vector<std::string>, std::map<std::string, Described>> featuresIn(
    const std::vector<std::string>& lines) {
  std::vector<std::string> names;
  std::map<std::string, Described> features;
  for (const std::string& line : lines) {
    const std::string name = line.substr(0, line.find(' '));
    if (name.find('/') == name.npos) continue;  // no feature
    try {
      if (features.try_emplace(name, Described{parseSensorId(name), {}, {}}).second)
        names.push_back(name);
    } catch (const std::invalid_argument&) {
      continue;  // a feature of a later board
    }
  }
  for (const std::string& line : lines) {
    std::string_view rest = line;
    const std::string_view what = nextWord(rest);
    if (what == "format") takeFormat(rest, features);
    if (what == "mount") takeMount(rest, features);
  }
  return {names, features};
}

/// Whether the feature is in the container now: of a format whose parameters are right.
bool add(const Described& feature, SensorContainer& container) {
  if (!feature.format) return false;
  try {
    container.add(featureOf(feature.id, feature.mount, *feature.format));
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

}  // namespace

std::unique_ptr<DescribedRobot> describedRobot(const std::vector<std::string>& lines,
                                               const ros2::RobotTopics::Options& options) {
  auto robot = std::make_unique<DescribedRobot>();
  const auto [names, features] = featuresIn(lines);
  std::vector<SensorId> others;
  for (const std::string& one : names) {
    const Described& feature = features.at(one);
    robot->hasTruth |= feature.id.type == "groundTruth";
    if (!add(feature, robot->container)) others.push_back(feature.id);
  }
  robot->topics = std::make_unique<ros2::RobotTopics>(robot->container, options);
  for (const SensorId& id : others) robot->topics->addWords(id);
  return robot;
}

}  // namespace ortung::foxglove
