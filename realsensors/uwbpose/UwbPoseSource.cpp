#include <algorithm>
#include <cmath>
#include <vector>

#include "ortung/core/Plugin.hpp"
#include "ortung/core/SourceHelp.hpp"
#include "ortung/core/SourceOptions.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/realsensors/LogSource.hpp"
#include "ortung/realsensors/OpenWorld.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMostTags = 16;
constexpr std::int64_t kMostAnchors = 64;
constexpr double kMargin = 1.0;         // distance from the anchors to the bounds [m]
constexpr double kWayStep = 0.15;       // distance travelled over which a heading is taken [m]
constexpr double kDefaultHeight = 1.0;  // height of the tags without ground truth [m]

struct Tag {
  double x, y;  ///< place in the robot frame [m]
};

/// Ranges between the tags of a trolley and anchors at the walls, poses by motion capture
/// ("Efficient planar pose estimation via UWB measurements", CUHK Shenzhen): NAME_ranges.txt with a
/// column for each anchor and tag, NAME_gt.txt, and README_source.md, whose tables have the places
/// of anchors and tags.
class UwbPoseSource : public LogSource {
 public:
  explicit UwbPoseSource(const Parameters& options)
      : folder_(options.text("path")),
        run_(runOf(options, folder_, "_ranges.txt")),
        bias_(optionNumber(options, "range_bias_m", 0.0, {-10.0, 10.0})),
        jitter_(optionNumber(options, "jitter_s", 1.0, {0.0, 3600.0})) {
    options.textOr("robot_file", "");
    readPlaces();
    for (std::size_t tag = 0; tag < tags_.size(); ++tag) {
      for (std::size_t anchor = 0; anchor < anchors_; ++anchor)
        addFeature({"tag" + std::to_string(tag), "landmarks",
                    "anchor" + std::to_string(anchor) + "Distance"});
    }
    readRanges();
    readTruth();
    finish(folder_.string());
  }

  std::string robotToml() const override;
  void writeWorld(const std::filesystem::path& file) const override { world_.write(file); }

 private:
  void readPlaces();
  void readRanges();
  void readTruth();

  std::filesystem::path folder_;
  std::string run_;
  double bias_;    ///< bias that is subtracted from ranges [m]
  double jitter_;  ///< how far stamps may fall back [s]
  std::size_t anchors_ = 0;
  OpenWorld world_{"anchor", kMargin};
  std::vector<Tag> tags_;
  double height_ = kDefaultHeight;  ///< height of the tags [m]
  double farthest_ = 1.0;           ///< greatest range of all readings [m]
};

/// Reads rows "| Tag 0 | x | y | z |" and "| Anchor 0 | x | y | z |" of the tables, in order.
void UwbPoseSource::readPlaces() {
  constexpr std::size_t kFirst = 4;  // field of x; every second one is a bar
  LogFile file(folder_ / "README_source.md");
  while (file.nextLine()) {
    if (file.text(0) != "|" || (file.text(1) != "Tag" && file.text(1) != "Anchor")) continue;
    const bool isTag = file.text(1) == "Tag";
    const std::size_t next = isTag ? tags_.size() : anchors_;
    if (file.integer(2, "a number", {0, kMostAnchors - 1}) != static_cast<std::int64_t>(next))
      file.fail(inQuotes(file.text(2)), std::to_string(next) + ", the next one");
    if (isTag) {
      const Range near{-9.0, 9.0};
      if (tags_.size() == kMostTags) file.fail("more tags", "at most " + std::to_string(kMostTags));
      tags_.push_back({file.number(kFirst, "x [m]", near), file.number(kFirst + 2, "y [m]", near)});
    } else {
      world_.read(file, static_cast<std::uint32_t>(anchors_++), kFirst, 2, true);
    }
  }
  if (tags_.empty() || anchors_ == 0)
    file.fail(std::to_string(tags_.size()) + " tags and " + std::to_string(anchors_) + " anchors",
              "tables with rows '| Tag 0 | x | y | z |' and '| Anchor 0 | x | y | z |'");
}

/// Reads ranges. Columns are ordered by anchor, then by tag. "nan" and 0 are failed measurements.
void UwbPoseSource::readRanges() {
  LogFile file(folder_ / (run_ + "_ranges.txt"));
  LogClock clock(jitter_);
  while (file.nextRecord()) {
    file.needFields(1 + anchors_ * tags_.size(), "time [s], a range [m] for each anchor and tag");
    const Timestamp stamp = clock(file, file.stamp(0));
    for (std::size_t anchor = 0; anchor < anchors_; ++anchor) {
      for (std::size_t tag = 0; tag < tags_.size(); ++tag) {
        const std::size_t field = 1 + anchor * tags_.size() + tag;
        if (file.text(field) == "nan") continue;
        const double range = file.number(field, "a range [m] or nan", {0.0, 1000.0});
        if (range == 0.0) continue;
        farthest_ = std::max(farthest_, range);
        add(static_cast<std::uint32_t>(tag * anchors_ + anchor), stamp,
            ScalarData::encode(std::max(range - bias_, 0.0)));
      }
    }
  }
}

/// Reads the ground truth. The file's yaw comes from quaternions read in the wrong order, always
/// near 180 degrees, so the heading is the direction of travel.
void UwbPoseSource::readTruth() {
  if (!findLogFile(folder_ / (run_ + "_gt.txt"))) return;
  const auto feature = addFeature({"reference", "groundTruth", "pose"});
  LogFile file(folder_ / (run_ + "_gt.txt"));
  LogClock clock(jitter_);
  std::vector<Timestamp> stamps;
  std::vector<Pose2> places;
  while (file.nextRecord()) {
    file.needFields(5, "time [s], x, y, z [m], yaw [rad]");
    const Range metres{-kMaxLogMetres, kMaxLogMetres};
    const double height = file.number(3, "z [m]", {0.0, 10.0});
    if (places.empty()) height_ = height;
    places.push_back({file.number(1, "x [m]", metres), file.number(2, "y [m]", metres), 0.0});
    stamps.push_back(clock(file, file.stamp(0)));
  }
  const std::vector<double> headings = headingsOfWay(places, kWayStep);
  for (std::size_t i = 0; i < places.size(); ++i)
    add(feature, stamps[i], PoseData::encode({places[i].x, places[i].y, headings[i]}));
}

std::string UwbPoseSource::robotToml() const {
  std::string text =
      "# A trolley with ultra-wideband tags, pushed by hand: no odometry. Noise: see "
      "realsensors/README.md.\n[robot]\nname = " +
      tomlText("uwbpose-" + run_) + "\nradius_m = 0.3\n";
  for (std::size_t tag = 0; tag < tags_.size(); ++tag) {
    text += "\n[[sensor]]\nplugin = \"landmarks\"\nmodel = \"tag" + std::to_string(tag) +
            "\"\ntype = \"landmarks\"\nfeatures = \"distances\"\nkind = \"anchor\"\n"
            "identities = [" +
            world_.identities() + "]\npose = { x_m = " + tomlNumber(tags_[tag].x) +
            ", y_m = " + tomlNumber(tags_[tag].y) + ", z_m = " + tomlNumber(height_) +
            " }\nslant = true\nmax_range_m = " + tomlNumber(std::ceil(farthest_)) +
            "\nrange_sigma_m = 0.2\noutliers = 0.05\nexponent = 0.1\n";
  }
  return text;
}

/// The text of `ortung import uwbpose --help`.
class UwbPoseHelp : public SourceHelp {
 public:
  explicit UwbPoseHelp(const Parameters&)
      : SourceHelp("folder with NAME_ranges.txt and README_source.md",
                   {{"run", "", "the only one", "NAME, the beginning of the files' names"},
                    {"range_bias_m", "m", "0", "bias that is subtracted from ranges"},
                    {"jitter_s", "s", "1", "how far stamps may fall back before it is an error"}}) {
  }
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("uwbpose_source", ortung::provide<ortung::Source, ortung::UwbPoseSource>("uwbpose"),
               ortung::provide<ortung::SourceHelp, ortung::UwbPoseHelp>("uwbpose"));
