#include "KeptMaps.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "Base64.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/mcl_served/HeatMap.hpp"
#include "ortung/mcl_served/Why.hpp"

namespace ortung::app {
namespace {

using nlohmann::json;

constexpr std::size_t kCells = 20'000;      // of the map of all features
constexpr std::size_t kSmallCells = 3'000;  // of that of one
constexpr std::size_t kPlaces = 100;        // at which a moment says why
constexpr Timestamp kNextTo = 100'000;      // events that are nearer to each other are one [us]
const SensorId kEstimate{"mcl", "LOCALIZATION", "pose"};
const SensorId kOdometry{"odometry", "odometry", "pose"};

template <class Data>
std::optional<typename Data::Reading> readingOf(Data data, const Message& message) {
  try {
    data.setData(message.stamp, message.words);
  } catch (const std::invalid_argument&) {
    return std::nullopt;  // another format under the same name
  }
  return data.reading();
}

/// Where the robot is at the moment: truly, as it estimates, and by odometry alone.
struct Poses {
  std::optional<Pose2> truth, estimate, odometry;
  explicit Poses(std::span<const Message> readings) {
    for (const Message& message : readings) {
      if (message.id.type == "groundTruth") {
        if (const auto found = readingOf(PoseData(message.id), message)) truth = *found;
      } else if (message.id == kEstimate) {
        const auto found = readingOf(PoseFixData(message.id, {}), message);
        if (found && !found->empty()) estimate = found->front().pose;
      } else if (message.id == kOdometry) {
        if (const auto found = readingOf(OdometryData(message.id), message)) odometry = found->pose;
      }
    }
  }
  /// The heading that a page asks with (FieldPainter.ts).
  double heading() const {
    return truth.value_or(estimate.value_or(odometry.value_or(Pose2{}))).theta;
  }
};

/// A number in JSON, which has no infinite ones; @p unit: what one step of it is.
json rounded(const std::optional<double>& value, double unit) {
  if (!value || std::isnan(*value)) return nullptr;
  if (std::isinf(*value)) return "inf";
  return std::lround(*value / unit);
}

constexpr double kMillimetre = 0.001;  // [m]
double unitOf(bool isAngle) { return isAngle ? radians(0.01) : kMillimetre; }

json jsonOf(const std::string& feature, const char* scale, const HeatMap& map) {
  const FieldGrid& grid = map.grid;
  return {{"feature", feature},       {"scale", scale},
          {"stamp", map.stamp},       {"columns", grid.columns},
          {"rows", grid.rows},        {"x_min_m", grid.originX},
          {"y_min_m", grid.originY},  {"step_m", grid.cell},
          {"low", map.low},           {"high", map.high},
          {"readings", map.readings}, {"bytes", base64(std::as_bytes(std::span(map.bytes)))}};
}

/// @param feature "": all together
void addMaps(const Robot& robot, const std::string& feature, json& maps) {
  HeatMapWish wish{.mostCells = kCells};
  if (!feature.empty()) {
    wish.queries = {feature};
    wish.mostCells = kSmallCells;
  }
  const auto both = bothHeatMaps(robot, wish, [] { return true; });
  maps.push_back(jsonOf(feature, "linear", both->first));
  maps.push_back(jsonOf(feature, "log", both->second));
}

/// What was measured is the same everywhere, so it stands once.
json measuredOf(const Why& why) {
  json features = json::array();
  for (const Why::Feature& one : why.features) {
    json values = json::array();
    json units = json::array();
    for (const ReadingValue& value : one.values) {
      values.push_back(rounded(value.measured, unitOf(value.isAngle)));
      units.push_back(value.isAngle ? 1 : 0);
    }
    features.push_back({{"name", toText(one.id)}, {"measured", values}, {"angles", units}});
  }
  return features;
}

json placeOf(const Pose2& pose, const Why& why) {
  json ps = json::array();
  json expected = json::array();
  for (const Why::Feature& one : why.features) {
    ps.push_back(one.p);
    json values = json::array();
    for (const ReadingValue& value : one.values)
      values.push_back(rounded(value.expected, unitOf(value.isAngle)));
    expected.push_back(values);
  }
  return {{"x", std::lround(pose.x / kMillimetre)},
          {"y", std::lround(pose.y / kMillimetre)},
          {"theta", std::lround(degrees(pose.theta) * 100.0)},
          {"p", why.p},
          {"ps", ps},
          {"expected", expected}};
}

/// The poses at which a moment says why: where the robot is, and all over the field.
std::vector<Pose2> placesOf(const Robot& robot, const Poses& poses) {
  std::vector<Pose2> places;
  for (const auto& pose : {poses.truth, poses.estimate})
    if (pose) places.push_back(*pose);
  const FieldRegion& region = robot.tables.region;
  const auto open = static_cast<double>(
      std::count_if(region.open.begin(), region.open.end(), [](auto is) { return is != 0; }));
  double spacing = region.grid.cell * std::sqrt(open / kPlaces);
  std::vector<std::size_t> cells = openCellsApart(region, spacing);
  // Where a field is all nooks, there is one in each block.
  for (; cells.size() > 2 * kPlaces; cells = openCellsApart(region, spacing)) spacing *= 1.3;
  for (const std::size_t cell : cells)
    places.push_back({region.grid.centreX(cell), region.grid.centreY(cell), poses.heading()});
  return places;
}

json momentOf(PerceivedPlayback& world, RobotId id, Timestamp stamp) {
  world.seek(stamp);
  const std::shared_ptr<const Robot> robot = world.perceiver(id);
  json maps = json::array();
  addMaps(*robot, "", maps);
  for (const SensorData* feature : chosenFeatures(*robot, {}))
    addMaps(*robot, toText(feature->id()), maps);
  json why = {{"features", json::array()}, {"places", json::array()}};
  for (const Pose2& pose : placesOf(*robot, Poses(world.readings(id)))) {
    const Why its = whyAt(*robot, {}, pose);
    if (why["places"].empty()) why["features"] = measuredOf(its);
    why["places"].push_back(placeOf(pose, its));
  }
  return {{"maps", maps}, {"why", why}};
}

/// @p count numbers from 0 on in an order in which any first ones of them lie evenly: by their bits
/// read backwards (van der Corput).
std::vector<std::size_t> evenOrder(std::size_t count) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; order.size() < count; ++i) {
    double place = 0.0;
    double share = 0.5;
    for (std::size_t bits = i; bits > 0; bits >>= 1U, share /= 2.0)
      if ((bits & 1U) != 0) place += share;
    order.emplace_back(place, i);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> numbers(count);
  for (std::size_t rank = 0; rank < count; ++rank) numbers[order[rank].second] = rank;
  return numbers;
}

}  // namespace

std::vector<Timestamp> momentsOf(const ServedPlayback& playback, RobotId robot, std::size_t most) {
  if (most == 0) return {};
  const std::string its = playback.residents().at(robot - 1).name + ": ";
  std::vector<Timestamp> events;
  for (const ServedPlayback::Mark& mark : playback.marks())
    if (mark.text.starts_with(its) && (events.empty() || mark.stamp - events.back() > kNextTo))
      events.push_back(mark.stamp);
  const std::size_t marked = std::min(events.size(), most / 2);
  std::set<Timestamp> moments;
  for (std::size_t i = 0; i < marked; ++i) moments.insert(events[i * events.size() / marked]);
  const auto even = static_cast<Timestamp>(most - marked);
  for (Timestamp i = 0; i < even; ++i)
    moments.insert(even == 1 ? playback.length() / 2 : i * playback.length() / (even - 1));
  return {moments.begin(), moments.end()};
}

KeptMaps keptMaps(PerceivedPlayback& world, RobotId robot, const std::vector<Timestamp>& stamps,
                  std::size_t room, const std::function<std::string(const std::string&)>& packed,
                  const std::function<bool(double)>& progress) {
  KeptMaps kept;
  std::size_t done = 0;
  for (const std::size_t i : evenOrder(stamps.size())) {
    if (!progress(static_cast<double>(done) / static_cast<double>(stamps.size()))) break;
    std::string text = packed(momentOf(world, robot, stamps[i]).dump());
    if (text.size() > room) break;
    room -= text.size();
    kept.moments.push_back({stamps[i], std::move(text)});
    ++done;
  }
  kept.leftOut = stamps.size() - kept.moments.size();
  std::sort(kept.moments.begin(), kept.moments.end(),
            [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  return kept;
}

}  // namespace ortung::app
