#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <stdexcept>

#include "Commands.hpp"
#include "Console.hpp"
#include "HeatMap.hpp"
#include "Interrupt.hpp"
#include "Localization.hpp"
#include "Numbers.hpp"
#include "OutputFile.hpp"
#include "Progress.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung::app {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

SensorQuery readQuery(const std::string& feature) {
  try {
    return parseSensorQuery(feature);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("--feature: {}", error.what()));
  }
}

/// All features with a perceptual model, in the container's order.
std::vector<SensorData*> localizingFeatures(const Robot& robot) {
  std::vector<SensorData*> features;
  for (const auto& feature : robot.container.all()) {
    if (feature->localizes()) features.push_back(feature.get());
  }
  return features;
}

std::string namesOf(const std::vector<SensorData*>& features) {
  std::string names;
  for (const SensorData* feature : features) {
    names += (names.empty() ? "" : ", ") + toText(feature->id());
  }
  return names;
}

/// The features that the arguments name. @throws std::runtime_error where nothing matches
std::vector<SensorData*> featuresOf(const Robot& robot, const ShowArguments& arguments) {
  const std::vector<SensorData*> all = localizingFeatures(robot);
  std::set<const SensorData*> wanted;
  for (const std::string& text : arguments.features) {
    const std::vector<SensorData*> matches = robot.container.findAll(readQuery(text));
    const bool any =
        std::any_of(matches.begin(), matches.end(), [](auto* f) { return f->localizes(); });
    if (!any) {
      throw std::runtime_error(
          fmt::format("{}: no feature with a perceptual model matches '{}', expected one of {}",
                      arguments.robot.string(), text, namesOf(all)));
    }
    wanted.insert(matches.begin(), matches.end());
  }
  std::vector<SensorData*> features;
  std::copy_if(all.begin(), all.end(), std::back_inserter(features),
               [&](const SensorData* feature) { return wanted.contains(feature); });
  return features;
}

/// What one of a feature's values is, by its format.
struct Unit {
  const char* name = "";
  double factor = 1.0;
};

Unit unitOf(const SensorData& feature, std::size_t index) {
  const Unit metres{"m", 1.0};
  const Unit angle{"deg", 180.0 / kPi};
  if (dynamic_cast<const BearingData*>(&feature) != nullptr) return angle;
  if (dynamic_cast<const LandmarksData*>(&feature) != nullptr)
    return index % 2 == 0 ? metres : angle;
  if (dynamic_cast<const ScalarData*>(&feature) != nullptr ||
      dynamic_cast<const ScanData*>(&feature) != nullptr ||
      dynamic_cast<const ConeData*>(&feature) != nullptr) {
    return metres;
  }
  return {};
}

/// What one feature is expected to read all over the field (Fig. 7a).
HeatMap expectationMap(const Robot& robot, const SensorData& feature,
                       const ShowArguments& arguments) {
  const FieldRegion& region = robot.tables.region;
  const double heading = wrapAngle(radians(arguments.headingDeg.value_or(0.0)));
  const Unit unit = unitOf(feature, arguments.beam);
  HeatMap map;
  map.region = &region;
  map.values.assign(region.grid.size(), kNoValue);
  std::size_t most = 0;
  for (std::size_t cell = 0; cell < region.grid.size(); ++cell) {
    if (region.open[cell] == 0) continue;
    const std::vector<double> expected =
        feature.expectation({region.grid.centreX(cell), region.grid.centreY(cell), heading});
    most = std::max(most, expected.size());
    if (arguments.beam < expected.size()) map.values[cell] = unit.factor * expected[arguments.beam];
  }
  if (arguments.beam >= most) {
    throw std::runtime_error(
        most == 0
            ? fmt::format("{}: {} keeps no expected values that could be drawn; with a reading "
                          "(--record) its probability can be",
                          arguments.tables.string(), toText(feature.id()))
            : fmt::format("{}: --beam is {}, but {} has {} values", arguments.tables.string(),
                          arguments.beam, toText(feature.id()), most));
  }
  map.unit = unit.name;
  map.caption = fmt::format("expectation of {}", toText(feature.id()));
  if (most > 1) map.caption += fmt::format(" [{}]", arguments.beam);
  if (feature.headingSpacing() < 6.28)
    map.caption += fmt::format(", heading {:.4g} deg", degrees(heading));
  return map;
}

/// Opens the source that the arguments name; "" if they name none.
std::string sourceText(const ShowArguments& arguments) {
  return arguments.record.empty() ? arguments.source : "record:" + arguments.record.string();
}

/// Fills the container with the readings up to the wanted moment; returns the newest truth.
std::optional<Pose2> fillUntil(const ShowArguments& arguments, Robot& robot) {
  const std::string name = sourceText(arguments);
  const std::unique_ptr<Source> source = openSource(name, arguments.robot, robot.factory);
  Feeder feeder(name, *source, robot.container);
  std::optional<Pose2> truth;
  double last = 0.0;
  while (feeder.next()) {
    checkInterrupt();
    last = feeder.seconds();
    if (feeder.truth()) truth = feeder.truth();
    if (last >= arguments.at) return truth;
  }
  throw std::runtime_error(
      fmt::format("{}: ends after {:.3f} s, but --at is {}", name, last, arguments.at));
}

/// Cells and their poses for one heading, as the container's fast path wants them.
struct Cells {
  std::vector<std::size_t> index;
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> theta;
  std::vector<float> logProbability;

  explicit Cells(const FieldRegion& region) {
    for (std::size_t cell = 0; cell < region.grid.size(); ++cell) {
      if (region.open[cell] == 0) continue;
      index.push_back(cell);
      x.push_back(static_cast<float>(region.grid.centreX(cell)));
      y.push_back(static_cast<float>(region.grid.centreY(cell)));
    }
    theta.resize(index.size());
    logProbability.resize(index.size());
  }
};

std::vector<double> headingsOf(const Robot& robot, const std::vector<SensorData*>& features,
                               const ShowArguments& arguments) {
  if (arguments.headingDeg) return {radians(*arguments.headingDeg)};
  double spacing = robot.tables.headingStep;
  for (const SensorData* feature : features) spacing = std::min(spacing, feature->headingSpacing());
  constexpr double kMostHeadings = 3600.0;
  const int count =
      static_cast<int>(std::lround(std::clamp(2.0 * kPi / spacing, 1.0, kMostHeadings)));
  std::vector<double> headings;
  for (int i = 0; i < count; ++i) headings.push_back(2.0 * kPi * i / count);
  return headings;
}

/// p(s given l) all over the field, the best heading of each cell (Fig. 7b).
HeatMap probabilityMap(const Robot& robot, std::vector<SensorData*> features,
                       const ShowArguments& arguments) {
  std::erase_if(features, [](const SensorData* feature) { return !feature->canWeigh(); });
  if (features.empty()) {
    throw std::runtime_error(
        fmt::format("{}: no feature that matches '{}' has a reading that says anything by {} s; "
                    "try a later --at",
                    sourceText(arguments), fmt::join(arguments.features, "', '"), arguments.at));
  }
  const FieldRegion& region = robot.tables.region;
  HeatMap map;
  map.region = &region;
  map.values.assign(region.grid.size(), kNoValue);
  Cells cells(region);
  Progress progress("weighing", arguments.progress);
  const std::vector<double> headings = headingsOf(robot, features, arguments);
  for (std::size_t i = 0; i < headings.size(); ++i) {
    checkInterrupt();
    progress.update(static_cast<double>(i) / static_cast<double>(headings.size()));
    std::fill(cells.theta.begin(), cells.theta.end(), static_cast<float>(headings[i]));
    std::fill(cells.logProbability.begin(), cells.logProbability.end(), 0.0F);
    for (const SensorData* feature : features) {
      feature->getProbability(SampleView{cells.x, cells.y, cells.theta}, cells.logProbability);
    }
    for (std::size_t k = 0; k < cells.index.size(); ++k) {
      double& best = map.values[cells.index[k]];
      best = std::fmax(best, std::exp(static_cast<double>(cells.logProbability[k])));
    }
  }
  map.caption = fmt::format("p({}) at {:g} s", fmt::join(arguments.features, ", "), arguments.at);
  if (features.size() > 1) map.caption += fmt::format(", {} features", features.size());
  map.logarithmic = arguments.logarithmic;
  return map;
}

void print(const HeatMap& map) {
  constexpr int kSteps = 5;
  fmt::print("{}\n", printable(map.caption));
  const std::vector<double> values = map.legend(kSteps);
  for (std::size_t i = 0; i < values.size(); ++i) {
    fmt::print("  grey {:3} %: {:.4g} {}\n", 100 * i / (kSteps - 1), values[i], map.unit);
  }
  if (map.truth) {
    fmt::print("  true pose: {:.3f} m, {:.3f} m, {:.1f} deg\n", map.truth->x, map.truth->y,
               degrees(map.truth->theta));
  }
}

}  // namespace

int runShow(const ShowArguments& arguments) {
  if (!arguments.record.empty() && !arguments.source.empty()) {
    throw UsageError("--record and --source exclude each other");
  }
  checkOutput(arguments.out);
  const std::unique_ptr<Robot> robot = openRobot(arguments.robot, arguments.tables);
  const std::vector<SensorData*> features = featuresOf(*robot, arguments);
  HeatMap map;
  if (sourceText(arguments).empty()) {
    if (features.size() > 1) {
      throw UsageError(
          fmt::format("--feature matches {} features, expected one (or a reading, by "
                      "--record): {}",
                      features.size(), namesOf(features)));
    }
    map = expectationMap(*robot, *features[0], arguments);
  } else {
    const std::optional<Pose2> truth = fillUntil(arguments, *robot);
    map = probabilityMap(*robot, features, arguments);
    map.truth = truth;
  }
  writeFile(arguments.out, draw(map).png());
  print(map);
  return 0;
}

}  // namespace ortung::app
