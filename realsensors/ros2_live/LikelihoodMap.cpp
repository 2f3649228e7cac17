#include "LikelihoodMap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {
namespace {

constexpr std::chrono::seconds kBetween{1};  ///< two maps

}  // namespace

void LikelihoodMap::finish() {
  if (making_.valid()) making_.wait();
}

void LikelihoodMap::connect(Participant& node) {
  node_ = &node;
  send_ = node.publish(kTopic, OccupancyGrid::kType, Qos::kLatched);
}

OccupancyGrid LikelihoodMap::of(const FieldRegion& region, const Weighers& readings,
                                double heading) {
  constexpr double kFull = 100.0;
  constexpr std::int8_t kUnknown = -1;
  const std::array headings = {heading};
  const std::vector<double> values = logProbabilityMap(region, readings, headings);
  double best = -std::numeric_limits<double>::infinity();
  for (const double value : values) best = std::fmax(best, value);
  OccupancyGrid map;
  map.resolution = static_cast<float>(region.grid.cell);
  map.width = static_cast<std::uint32_t>(region.grid.columns);
  map.height = static_cast<std::uint32_t>(region.grid.rows);
  map.origin = fromPose2({region.grid.originX, region.grid.originY, 0.0});
  map.data.reserve(values.size());
  // Levels compare with the best: p itself may be too small for a number.
  for (const double value : values)
    map.data.push_back(std::isnan(value)
                           ? kUnknown
                           : static_cast<std::int8_t>(std::lround(kFull * std::exp(value - best))));
  return map;
}

FieldRegion LikelihoodMap::partOf(const FieldRegion& region, const Floor& floor) {
  const FieldGrid& whole = region.grid;
  const auto columnAt = [&](double x) {
    const double column = std::floor((x - whole.originX) / whole.cell + 0.5);
    return static_cast<int>(std::clamp(column, 0.0, static_cast<double>(whole.columns)));
  };
  const int first = columnAt(floor.xLow);
  const int columns = columnAt(floor.xHigh) - first;
  FieldRegion part;
  part.grid = {whole.originX + first * whole.cell, whole.originY, whole.cell, columns, whole.rows};
  for (int row = 0; row < whole.rows; ++row) {
    const auto begin = static_cast<std::ptrdiff_t>(row) * whole.columns + first;
    const auto copy = [&](const std::vector<std::uint8_t>& from, std::vector<std::uint8_t>& to) {
      to.insert(to.end(), from.begin() + begin, from.begin() + begin + columns);
    };
    copy(region.open, part.open);
    copy(region.standable, part.standable);
  }
  return part;
}

void LikelihoodMap::tell(const Robot& robot, double heading, const std::optional<Floor>& floor) {
  const auto now = std::chrono::steady_clock::now();
  const bool isBusy =
      making_.valid() && making_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
  if (node_ == nullptr || now < next_ || isBusy || !node_->isHeard(kTopic)) return;
  next_ = now + kBetween;
  std::vector<const SensorData*> features;
  Timestamp stamp = 0;
  const SensorContainer::ReadLock lock = robot.container.read();
  for (const auto& data : robot.container.all()) {
    if (!data->localizes() || !data->isLearned() || !data->canWeigh()) continue;
    features.push_back(data.get());
    stamp = std::max(stamp, data->stamp());
  }
  if (features.empty()) return;
  const FieldRegion& field = robot.tables.region;
  making_ = std::async(
      std::launch::async,
      [this, stamp, heading, readings = weighersOf(features), shift = floor ? floor->shift : 0.0,
       region = coarsened(floor ? partOf(field, *floor) : field, kMostCells)] {
        OccupancyGrid map = of(region, readings, heading);
        map.origin.position.x -= shift;
        map.header = {1000 * stamp, frame_};
        map.mapLoadTime = map.header.stamp;
        send_(toCdr(map));
      });
}

}  // namespace ortung::ros2
