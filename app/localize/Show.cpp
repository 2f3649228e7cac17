#include "Show.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

#include "Console.hpp"
#include "HeatMap.hpp"
#include "Interrupt.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "SourceArguments.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/run/Feeder.hpp"
#include "ortung/run/FieldMaps.hpp"
#include "ortung/run/Robot.hpp"

namespace ortung::app {
namespace {

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

/// What one feature is expected to read all over the field (Fig. 7a).
HeatMap drawnExpectation(const Robot& robot, const SensorData& feature,
                         const ShowArguments& arguments) {
  const double heading = wrapAngle(radians(arguments.headingDeg.value_or(0.0)));
  const bool isAngle = feature.isAngle(arguments.beam);
  HeatMap map;
  map.region = &robot.tables.region;
  ExpectationMap expected = expectationMap(*map.region, feature, arguments.beam, heading);
  const std::size_t most = expected.count;
  if (arguments.beam >= most) {
    throw std::runtime_error(
        most == 0
            ? fmt::format("{}: {} keeps no expected values that could be drawn; with a reading "
                          "(--record) its probability can be",
                          arguments.tables.string(), toText(feature.id()))
            : fmt::format("{}: --beam is {}, but {} has {} values", arguments.tables.string(),
                          arguments.beam, toText(feature.id()), most));
  }
  map.values = std::move(expected.values);
  if (isAngle)
    for (double& value : map.values) value = degrees(value);
  map.unit = isAngle ? "deg" : "m";
  map.quantity = isAngle ? "expected bearing" : "expected distance";
  map.field = &robot.tables.field;
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
  const std::unique_ptr<Source> source = openSourceArgument(name, arguments.robot, robot.factory);
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

std::vector<double> headingsOf(const Robot& robot, const std::vector<SensorData*>& features,
                               const ShowArguments& arguments) {
  if (arguments.headingDeg) return {radians(*arguments.headingDeg)};
  return mapHeadings(robot.tables.headingStep, features);
}

/// A map of p(s given l) and what it was made from.
struct ProbabilityMap {
  HeatMap map;
  Weighers weighers;
  std::vector<double> headings;  ///< [rad]
};

/// p(s given l) all over the field, the best heading of each cell (Fig. 7b).
ProbabilityMap drawnProbability(const Robot& robot, std::vector<SensorData*> features,
                                const ShowArguments& arguments) {
  std::erase_if(features, [](const SensorData* feature) { return !feature->canWeigh(); });
  if (features.empty()) {
    throw std::runtime_error(
        fmt::format("{}: no feature that matches '{}' has a reading that says anything by {} s; "
                    "try a later --at",
                    sourceText(arguments), fmt::join(arguments.features, "', '"), arguments.at));
  }
  HeatMap map;
  map.region = &robot.tables.region;
  map.field = &robot.tables.field;
  Progress progress("weighing", arguments.progress);
  const Weighers weighers = weighersOf(features);
  const std::vector<double> headings = headingsOf(robot, features, arguments);
  map.values = probabilityMap(*map.region, weighers, headings, [&](double share) {
    checkInterrupt();
    progress.update(share);
    return true;
  });
  map.caption = fmt::format("p({}) at {:g} s", fmt::join(arguments.features, ", "), arguments.at);
  if (features.size() > 1) map.caption += fmt::format(", {} features", features.size());
  map.note = headings.size() == 1
                 ? fmt::format("heading {:.4g} deg", degrees(headings[0]))
                 : fmt::format("each cell: the best of {} headings", headings.size());
  map.quantity = "p(s given l)";
  map.marksBest = true;
  map.logarithmic = arguments.logarithmic || arguments.scale == "log" ||
                    (arguments.scale == "auto" && map.isPeaked());
  return {std::move(map), weighers, headings};
}

void print(const HeatMap& map) {
  constexpr int kSteps = 5;
  fmt::print("{}{}{}\n", printable(map.caption), map.note.empty() ? "" : "; ", map.note);
  const std::vector<double> values = map.legend(kSteps);
  for (std::size_t i = 0; i < values.size(); ++i) {
    fmt::print("  colour {:3} %: {:.4g} {}\n", 100 * i / (kSteps - 1), values[i], map.unit);
  }
}

void printPose(const char* what, const Pose2& pose, const std::optional<double>& value) {
  fmt::print("  {}: {:.3f} m, {:.3f} m, {:.1f} deg{}\n", what, pose.x, pose.y, degrees(pose.theta),
             value ? fmt::format(", p = {:.4g}", *value) : "");
}

/// The product of p(s given l) at one pose.
double probabilityAt(const Weighers& weighers, const Pose2& pose) {
  const float x = static_cast<float>(pose.x);
  const float y = static_cast<float>(pose.y);
  const float theta = static_cast<float>(pose.theta);
  float logarithm = 0.0F;
  for (const auto& weigher : weighers)
    weigher->getProbability(SampleView{{&x, 1}, {&y, 1}, {&theta, 1}}, {&logarithm, 1});
  return std::exp(static_cast<double>(logarithm));
}

/// Where the reading is most probable, and how probable it is where the robot was.
void printPoses(const ProbabilityMap& drawn) {
  const auto best = drawn.map.best();
  if (best) {
    const FieldGrid& grid = drawn.map.region->grid;
    Pose2 pose{grid.centreX(*best), grid.centreY(*best), 0.0};
    double greatest = -1.0;
    for (const double heading : drawn.headings) {
      const double p = probabilityAt(drawn.weighers, {pose.x, pose.y, heading});
      if (p > greatest) pose.theta = wrapAngle(heading);
      greatest = std::max(greatest, p);
    }
    printPose("most probable pose", pose, greatest);
  }
  if (drawn.map.truth)
    printPose("true pose", *drawn.map.truth, probabilityAt(drawn.weighers, *drawn.map.truth));
}

}  // namespace

int runShow(const ShowArguments& arguments) {
  if (!arguments.record.empty() && !arguments.source.empty()) {
    throw UsageError("--record and --source exclude each other");
  }
  Outputs outputs(arguments.force);
  outputs.reads(arguments.tables);
  outputs.reads(arguments.robot);
  outputs.readsSource(sourceText(arguments));
  outputs.writes("--out", arguments.out, OutputKind::kPicture);
  const std::unique_ptr<Robot> robot = openRobot(arguments.robot, arguments.tables);
  const std::vector<SensorData*> features = featuresOf(*robot, arguments);
  if (sourceText(arguments).empty()) {
    if (features.size() > 1) {
      throw UsageError(
          fmt::format("--feature matches {} features, expected one (or a reading, by "
                      "--record): {}",
                      features.size(), namesOf(features)));
    }
    const HeatMap map = drawnExpectation(*robot, *features[0], arguments);
    outputs.write(arguments.out, draw(map).png());
    print(map);
    return 0;
  }
  const std::optional<Pose2> truth = fillUntil(arguments, *robot);
  ProbabilityMap drawn = drawnProbability(*robot, features, arguments);
  drawn.map.truth = truth;
  outputs.write(arguments.out, draw(drawn.map).png());
  print(drawn.map);
  printPoses(drawn);
  return 0;
}

}  // namespace ortung::app
