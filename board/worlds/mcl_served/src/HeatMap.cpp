#include "ortung/mcl_served/HeatMap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ortung/run/FieldMaps.hpp"
#include "ortung/run/ReadingValues.hpp"
#include "ortung/server/ServedWorld.hpp"

namespace ortung {
namespace {

constexpr double kLevels = 254.0;  // between the lowest and the highest byte

/// Levels of finite values between their own bounds; NaN is 0, what is infinite the last one.
void addLevels(const std::vector<double>& values, HeatMap& map) {
  map.low = std::numeric_limits<double>::infinity();
  map.high = -map.low;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    map.low = std::min(map.low, value);
    map.high = std::max(map.high, value);
  }
  if (map.low > map.high) map.low = map.high = 0.0;
  const double span = map.high > map.low ? map.high - map.low : 1.0;
  map.bytes.assign(values.size(), '\0');
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    const double share = std::clamp((values[i] - map.low) / span, 0.0, 1.0);
    map.bytes[i] = static_cast<char>(static_cast<unsigned char>(1.0 + std::round(kLevels * share)));
  }
}

/// The readings, and when the newest of them was taken.
Weighers takeReadings(const Robot& robot, std::vector<const SensorData*>& features,
                      Timestamp& stamp) {
  const SensorContainer::ReadLock lock = robot.container.read();
  std::erase_if(features, [](const SensorData* one) { return !one->canWeigh(); });
  for (const SensorData* one : features) stamp = std::max(stamp, one->stamp());
  return weighersOf(features);
}

/// Probabilities of a map that were computed; levels are made of them.
struct Probabilities {
  HeatMap map;                                             ///< but for its levels
  std::vector<double> logs;                                ///< ln p of each cell
  double best = -std::numeric_limits<double>::infinity();  ///< greatest of them
};

std::optional<Probabilities> probabilities(const Robot& robot,
                                           std::vector<const SensorData*> features,
                                           const HeatMapWish& wish,
                                           const std::function<bool()>& goOn) {
  const FieldRegion region = coarsened(robot.tables.region, wish.mostCells);
  Probabilities found{.map = {.grid = region.grid}, .logs = {}};
  const Weighers readings = takeReadings(robot, features, found.map.stamp);
  found.map.readings = readings.size();
  std::vector<double> headings{wish.heading.value_or(0.0)};
  if (!wish.heading && !readings.empty())
    headings = mapHeadings(robot.tables.headingStep, features);
  found.logs = logProbabilityMap(region, readings, headings, [&](double) { return goOn(); });
  if (found.logs.empty()) return std::nullopt;
  for (const double value : found.logs) found.best = std::fmax(found.best, value);
  return found;
}

/// Levels compare with the best: p itself may be too small for a number.
HeatMap mapOf(const Probabilities& found, bool isLogarithmic) {
  HeatMap map = found.map;
  std::vector<double> values = found.logs;
  for (double& value : values)
    value = isLogarithmic ? value - found.best : std::exp(value - found.best);
  addLevels(values, map);
  map.low = std::exp(found.best) * (isLogarithmic ? std::exp(map.low) : map.low);
  map.high = std::exp(found.best) * (isLogarithmic ? std::exp(map.high) : map.high);
  return map;
}

/// Row by row, so that readings that come meanwhile wait for one row at most.
std::optional<HeatMap> expectation(const Robot& robot, const SensorData& feature,
                                   const HeatMapWish& wish, const std::function<bool()>& goOn) {
  const FieldRegion region = coarsened(robot.tables.region, wish.mostCells);
  const FieldGrid& grid = region.grid;
  const auto columns = static_cast<std::size_t>(grid.columns);
  HeatMap map{.grid = grid, .isAngle = feature.isAngle(wish.index)};
  std::vector<double> values;
  FieldRegion row{{grid.originX, 0.0, grid.cell, grid.columns, 1}, {}, {}};
  for (std::size_t i = 0; i < static_cast<std::size_t>(grid.rows); ++i) {
    if (!goOn()) return std::nullopt;
    row.grid.originY = grid.originY + static_cast<double>(i) * grid.cell;
    const auto begin = region.open.begin() + static_cast<std::ptrdiff_t>(i * columns);
    row.open.assign(begin, begin + grid.columns);
    const SensorContainer::ReadLock lock = robot.container.read();
    map.stamp = feature.stamp();
    const ExpectationMap its = expectationMap(row, feature, wish.index, wish.heading.value_or(0.0));
    map.values = std::max(map.values, its.count);
    values.insert(values.end(), its.values.begin(), its.values.end());
  }
  if (wish.index >= map.values)
    throw ServeError("argument", toText(feature.id()) + " expects " + std::to_string(map.values) +
                                     " values, there is none of number " +
                                     std::to_string(wish.index));
  addLevels(values, map);
  return map;
}

}  // namespace

std::vector<const SensorData*> chosenFeatures(const Robot& robot,
                                              const std::vector<std::string>& queries) {
  std::vector<SensorQuery> wanted;
  for (const std::string& text : queries) wanted.push_back(parseSensorQuery(text));
  if (wanted.empty()) wanted.emplace_back();
  std::vector<const SensorData*> features;
  for (const auto& data : robot.container.all())
    if (data->localizes() && data->isLearned() &&
        std::any_of(wanted.begin(), wanted.end(),
                    [&](const SensorQuery& query) { return matches(query, data->id()); }))
      features.push_back(data.get());
  if (features.empty()) throw ServeError("argument", "no such feature of this robot localizes");
  return features;
}

std::optional<HeatMap> heatMap(const Robot& robot, const HeatMapWish& wish,
                               const std::function<bool()>& goOn) {
  std::vector<const SensorData*> features = chosenFeatures(robot, wish.queries);
  if (!wish.isExpectation) {
    const auto found = probabilities(robot, std::move(features), wish, goOn);
    return found ? std::optional(mapOf(*found, wish.isLogarithmic)) : std::nullopt;
  }
  if (features.size() != 1)
    throw ServeError("argument", "of=expectation is of one feature, found " +
                                     std::to_string(features.size()) +
                                     "; name it as MODEL/TYPE/FEATURE");
  return expectation(robot, *features.front(), wish, goOn);
}

std::optional<std::pair<HeatMap, HeatMap>> bothHeatMaps(const Robot& robot, const HeatMapWish& wish,
                                                        const std::function<bool()>& goOn) {
  const auto found = probabilities(robot, chosenFeatures(robot, wish.queries), wish, goOn);
  if (!found) return std::nullopt;
  return std::pair(mapOf(*found, false), mapOf(*found, true));
}

}  // namespace ortung
