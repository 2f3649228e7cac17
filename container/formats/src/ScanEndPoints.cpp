/// A scan against the places where its beams should end.

#include <algorithm>
#include <cmath>

#include "EndPointExpectations.hpp"
#include "FormatTools.hpp"
#include "ScanExpectations.hpp"
#include "SurfaceRay.hpp"

namespace ortung {
namespace {

/// Returns null if no beam has an end.
std::shared_ptr<EndPointWeigher> weigherOf(const std::shared_ptr<const EndPointTables>& tables,
                                           const Pose2& mount, const ScanData::Config& config,
                                           std::span<const float> ranges) {
  auto weigher = std::make_shared<EndPointWeigher>(tables, mount);
  const int thin = config.usedBeams > 0 ? std::max(1, config.beams / config.usedBeams) : 1;
  for (int i = 0; i < config.beams; i += thin) {
    const float range = ranges[static_cast<std::size_t>(i)];
    if (!std::isfinite(range)) continue;  // a beam without a hit has no end
    weigher->add(static_cast<double>(range), config.firstAngle + i * config.angleStep);
  }
  return weigher->isEmpty() ? nullptr : weigher;
}

class ScanEndPoints final : public EndPointExpectations {
 public:
  ScanEndPoints(const ScanData& scan, const ScanData::Config& config)
      : EndPointExpectations({.cell = config.endPointCell,
                              .margin = marginOf(config),
                              .maxRange = config.maxRange,
                              .model = config.model}),
        scan_(scan) {}

  std::string key() const override {
    return scanKey(scan_, "endpoints cell_m=" + keyNumber(scan_.config().endPointCell));
  }
  double headingSpacing() const override { return kTurn / fewestViews(scan_.config()); }
  double positionSpacing() const override { return kCellsApart * scan_.config().endPointCell; }
  ExpectationGrain grain() const override { return ExpectationGrain::kExact; }

  void learn(const Pose2& sensor) override {
    for (std::size_t i = 0; i < scan_.ranges().size(); ++i) {
      const auto range = static_cast<double>(scan_.ranges()[i]);
      if (!std::isfinite(range)) continue;
      const double angle = sensor.theta + scan_.config().firstAngle +
                           static_cast<double>(i) * scan_.config().angleStep;
      mark(sensor.x + range * std::cos(angle), sensor.y + range * std::sin(angle));
    }
  }

  /// Writes surfaces first, as files of scans have them with either perception.
  void save(TableWriter& file, const std::string& prefix) const override {
    tables()->surfaces->save(file, prefix);
    tables()->field.save(file, prefix);
  }

  std::vector<double> at(const Pose2& sensor) const override {
    const ScanData::Config& config = scan_.config();
    const SurfaceField& surfaces = *tables()->surfaces;
    if (surfaces.isEmpty() || surfaces.grid().cellAt(sensor.x, sensor.y) < 0) return {};
    std::vector<double> expected;
    for (int i = 0; i < config.beams; ++i)
      expected.push_back(rangeAlong(
          surfaces, {sensor.x, sensor.y, sensor.theta + config.firstAngle + i * config.angleStep},
          config.maxRange));
    return expected;
  }

  std::shared_ptr<const Weigher> weigher() const override {
    const auto weigher = weigherOf(tables(), scan_.mount(), scan_.config(), scan_.ranges());
    if (weigher)
      weigher->setTrace({tables()->surfaces, scan_.mount(), scan_.config(), scan_.ranges(),
                         [tables = tables(), mount = scan_.mount(),
                          config = scan_.config()](std::span<const float> ranges) {
                           return weigherOf(tables, mount, config, ranges);
                         }});
    return weigher;
  }

 private:
  const ScanData& scan_;
};

}  // namespace

std::unique_ptr<Expectations> expectedEndPoints(const ScanData& scan,
                                                const ScanData::Config& config) {
  return std::make_unique<ScanEndPoints>(scan, config);
}

}  // namespace ortung
