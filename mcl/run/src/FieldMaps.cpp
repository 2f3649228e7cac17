#include "ortung/run/FieldMaps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
constexpr double kMostHeadings = 3600.0;

/// Cells weighed in one call: their tables stay in the nearest caches from heading to heading, and
/// the caller is asked after a tenth of a millisecond whether to wait or to stop.
constexpr std::size_t kCellsAtOnce = 1024;

/// Open cells as poses of one heading, which are weighed in one call per feature.
struct OpenCells {
  std::vector<std::size_t> index;
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> theta;
  std::vector<float> logProbability;

  explicit OpenCells(const FieldRegion& region)
      : theta(kCellsAtOnce), logProbability(kCellsAtOnce) {
    for (std::size_t cell = 0; cell < region.grid.size(); ++cell) {
      if (region.open[cell] == 0) continue;
      index.push_back(cell);
      x.push_back(static_cast<float>(region.grid.centreX(cell)));
      y.push_back(static_cast<float>(region.grid.centreY(cell)));
    }
  }

  /// Weighs some cells. @pre count <= kCellsAtOnce @returns their ln p
  std::span<const float> weigh(const Weighers& readings, double heading, std::size_t begin,
                               std::size_t count) {
    const std::span<float> some = std::span(logProbability).first(count);
    std::fill(theta.begin(), theta.end(), static_cast<float>(heading));
    std::fill(some.begin(), some.end(), 0.0F);
    const SampleView poses{std::span(x).subspan(begin, count), std::span(y).subspan(begin, count),
                           std::span(theta).first(count)};
    for (const auto& reading : readings) reading->getProbability(poses, some);
    return some;
  }
};

}  // namespace

ExpectationMap expectationMap(const FieldRegion& region, const SensorData& feature,
                              std::size_t index, double heading) {
  ExpectationMap map;
  map.values.assign(region.grid.size(), kNoValue);
  for (std::size_t cell = 0; cell < region.grid.size(); ++cell) {
    if (region.open[cell] == 0) continue;
    const std::vector<double> expected =
        feature.expectation({region.grid.centreX(cell), region.grid.centreY(cell), heading});
    map.count = std::max(map.count, expected.size());
    if (index < expected.size()) map.values[cell] = expected[index];
  }
  return map;
}

std::vector<double> mapHeadings(double headingStep, std::span<const SensorData* const> features) {
  double spacing = headingStep;
  for (const SensorData* feature : features) spacing = std::min(spacing, feature->headingSpacing());
  const int count = static_cast<int>(std::lround(std::clamp(kTurn / spacing, 1.0, kMostHeadings)));
  std::vector<double> headings;
  for (int i = 0; i < count; ++i) headings.push_back(kTurn * i / count);
  return headings;
}

FieldRegion coarsened(const FieldRegion& region, std::size_t most) {
  const FieldGrid& fine = region.grid;
  int step = 1;
  const auto cells = [&] {
    const auto columns = static_cast<std::size_t>((fine.columns + step - 1) / step);
    const auto rows = static_cast<std::size_t>((fine.rows + step - 1) / step);
    return columns * rows;
  };
  while (cells() > most && (step < fine.columns || step < fine.rows)) ++step;
  if (step == 1) return region;
  FieldRegion coarse;
  coarse.grid = {fine.originX, fine.originY, fine.cell * step, (fine.columns + step - 1) / step,
                 (fine.rows + step - 1) / step};
  for (std::size_t i = 0; i < coarse.grid.size(); ++i) {
    const std::ptrdiff_t cell = fine.cellAt(coarse.grid.centreX(i), coarse.grid.centreY(i));
    const auto at = [&](const std::vector<std::uint8_t>& mask) {
      return cell < 0 ? std::uint8_t{0} : mask[static_cast<std::size_t>(cell)];
    };
    coarse.open.push_back(at(region.open));
    coarse.standable.push_back(at(region.standable));
  }
  return coarse;
}

Weighers weighersOf(std::span<const SensorData* const> features) {
  Weighers weighers;
  for (const SensorData* feature : features)
    if (auto weigher = feature->weigher()) weighers.push_back(std::move(weigher));
  return weighers;
}

std::vector<double> logProbabilityMap(const FieldRegion& region, const Weighers& readings,
                                      std::span<const double> headings,
                                      const std::function<bool(double)>& goOn) {
  OpenCells cells(region);
  std::vector<float> best(cells.index.size(), -std::numeric_limits<float>::infinity());
  const auto all = static_cast<double>(best.size() * headings.size());
  for (std::size_t begin = 0; begin < best.size(); begin += kCellsAtOnce) {
    const std::size_t count = std::min(kCellsAtOnce, best.size() - begin);
    for (std::size_t i = 0; i < headings.size(); ++i) {
      const std::size_t done = begin * headings.size() + i * count;
      if (goOn && !goOn(static_cast<double>(done) / all)) return {};
      const std::span<const float> found = cells.weigh(readings, headings[i], begin, count);
      for (std::size_t k = 0; k < count; ++k) best[begin + k] = std::max(best[begin + k], found[k]);
    }
  }
  std::vector<double> map(region.grid.size(), kNoValue);
  for (std::size_t k = 0; k < best.size(); ++k) map[cells.index[k]] = static_cast<double>(best[k]);
  return map;
}

std::vector<double> probabilityMap(const FieldRegion& region, const Weighers& readings,
                                   std::span<const double> headings,
                                   const std::function<bool(double)>& goOn) {
  std::vector<double> map = logProbabilityMap(region, readings, headings, goOn);
  for (double& value : map) value = std::exp(value);  // exp keeps the order, so the best stays
  return map;
}

}  // namespace ortung
