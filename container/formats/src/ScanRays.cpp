/// A scan against the ranges that its beams should have.

#include <algorithm>
#include <cmath>

#include "FormatTools.hpp"
#include "LevelDifference.hpp"
#include "RayWeigher.hpp"
#include "ScanExpectations.hpp"
#include "ortung/tables/SurfaceField.hpp"

namespace ortung {
namespace {

/// Returns whether beams of so many evenly spaced views fall on each of @p directions per turn.
bool meetAll(const ScanData::Config& config, int views, int directions) {
  std::vector<bool> met(static_cast<std::size_t>(directions), false);
  for (int view = 0; view < views; ++view) {
    for (int beam = 0; beam < config.beams; ++beam) {
      const double turns =
          static_cast<double>(view) / views + (config.firstAngle + beam * config.angleStep) / kTurn;
      const long direction = std::lround((turns - std::floor(turns)) * directions);
      met[static_cast<std::size_t>(direction % directions)] = true;
    }
  }
  return std::find(met.begin(), met.end(), false) == met.end();
}

/// Returns the number of headings that learn every direction of a table, even if beams are sparser
/// than its directions.
int viewsFor(const ScanData::Config& config, int directions) {
  int views = fewestViews(config);
  if (config.angleStep <= 1.01 * kTurn / directions) return views;  // the table fills single holes
  views = std::max(views, directions / config.beams);
  while (views < directions && !meetAll(config, views, directions)) views += 1 + views / 8;
  return std::min(views, directions);
}

/// Returns how many of the table's directions a scan spans.
int runLength(const ScanData::Config& config, int directions) {
  const double step = kTurn / directions;
  const auto run = static_cast<int>(std::lround((config.beams - 1) * config.angleStep / step)) + 1;
  return std::min(run, directions);
}

/// What a weigher needs of what was learned.
struct Learned {
  std::shared_ptr<const DirectionTable> rays;
  std::shared_ptr<const SurfaceField> surfaces;
  RangeScale scale;

  /// Returns null if no beam has information.
  std::shared_ptr<RayWeigher> weigherOf(const Pose2& mount, const ScanData::Config& config,
                                        std::span<const float> ranges) const;
};

std::shared_ptr<RayWeigher> Learned::weigherOf(const Pose2& mount, const ScanData::Config& config,
                                               std::span<const float> ranges) const {
  const int run = runLength(config, rays->directions());
  SurfaceFit fit(surfaces, mount, config.model);
  for (int i = 0; i < config.beams; ++i) {
    const float range = ranges[static_cast<std::size_t>(i)];
    if (std::isfinite(range))
      fit.add(static_cast<double>(range), config.firstAngle + i * config.angleStep);
  }
  auto weigher = std::make_shared<RayWeigher>(rays, mount, config.firstAngle, config.model,
                                              static_cast<std::size_t>(run), std::move(fit));
  const int thin = config.usedBeams > 0 ? std::max(1, run / config.usedBeams) : 1;
  for (int j = 0; j < run; j += thin) {
    const double place = j * rays->step() / config.angleStep;
    const auto beam = std::min<long>(std::lround(place), config.beams - 1);
    if (std::abs(place - static_cast<double>(beam)) * config.angleStep > 0.51 * rays->step())
      continue;
    const float range = ranges[static_cast<std::size_t>(beam)];
    if (!std::isnan(range))
      weigher->add(static_cast<std::size_t>(j), static_cast<double>(range), scale);
  }
  return weigher->complete() ? weigher : nullptr;
}

/// A ray table, and surfaces that refine it.
class ScanRays final : public Expectations {
 public:
  ScanRays(const ScanData& scan, const ScanData::Config& config)
      : scan_(scan), scale_(config.maxRange, config.resolution) {}

  std::string key() const override {
    const RangeResolution& resolution = scan_.config().resolution;
    return scanKey(
        scan_, "rays scale=" + keyNumber(resolution.metres) + "," + keyNumber(resolution.perMetre));
  }
  double headingSpacing() const override {
    return kTurn / (views_ > 0 ? views_ : fewestViews(scan_.config()));
  }

  void start(const FieldRegion& region, double headingStep) override;
  void learn(const Pose2& sensor) override;
  void finish() override {
    sweep_.surfaces->finish();
    rays_->finish();
    sweep_ = {};
  }
  void save(TableWriter& file, const std::string& prefix) const override {
    surfaces_->save(file, prefix);
    rays_->save(file, prefix);
  }
  void load(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
            const FieldGrid& grid) override;
  std::vector<double> at(const Pose2& sensor) const override;
  std::shared_ptr<const Weigher> weigher() const override;

 private:
  /// Data that only a sweep needs.
  struct Sweep {
    std::vector<std::uint8_t> levelOfWord;
    FieldGrid grid;
    /// Says for each cell of the grid whether the scan from there marks surfaces.
    std::vector<bool> showsSurfaces;
    std::shared_ptr<SurfaceField> surfaces;  ///< the same as surfaces_
  };
  bool showsSurfaces(const Pose2& sensor) const;

  const ScanData& scan_;
  RangeScale scale_;
  std::shared_ptr<DirectionTable> rays_ = std::make_shared<DirectionTable>();
  std::shared_ptr<const SurfaceField> surfaces_ = std::make_shared<SurfaceField>();
  int views_ = 0;  ///< headings a turn of the sweep; 0: not known yet
  Sweep sweep_;
};

void ScanRays::start(const FieldRegion& region, double headingStep) {
  const ScanData::Config& config = scan_.config();
  sweep_.surfaces = std::make_shared<SurfaceField>();
  sweep_.surfaces->start(region, config.endPointCell, marginOf(config));
  surfaces_ = sweep_.surfaces;
  const int directions = std::max(1, static_cast<int>(std::lround(kTurn / headingStep)));
  rays_ = std::make_shared<DirectionTable>();
  rays_->start(region, directions, runLength(config, directions));
  views_ = viewsFor(config, directions);
  sweep_.grid = region.grid;
  sweep_.showsSurfaces.assign(region.grid.size(), false);
  for (const std::size_t cell : openCellsApart(region, kCellsApart * config.endPointCell))
    sweep_.showsSurfaces[cell] = true;
  // The last word is beyond the greatest range, and stands for all such ranges.
  sweep_.levelOfWord.resize(words::fromMetres(config.maxRange) + 2);
  for (std::uint32_t word = 0; word < sweep_.levelOfWord.size(); ++word)
    sweep_.levelOfWord[word] = scale_.level(words::toMetres(word));
}

/// Returns whether surfaces are marked from there. The table is learned in every cell, but scans
/// from all of them would add no information about a surface.
bool ScanRays::showsSurfaces(const Pose2& sensor) const {
  const std::ptrdiff_t cell = sweep_.grid.cellAt(sensor.x, sensor.y);
  return cell >= 0 && sweep_.showsSurfaces[static_cast<std::size_t>(cell)];
}

void ScanRays::learn(const Pose2& sensor) {
  const ScanData::Config& config = scan_.config();
  const std::span<const std::uint32_t> words = scan_.getData();
  const bool marks = showsSurfaces(sensor);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const double angle =
        sensor.theta + config.firstAngle + static_cast<double>(i) * config.angleStep;
    const auto range = static_cast<double>(scan_.ranges()[i]);
    if (std::isnan(range)) continue;
    const std::size_t word = std::min<std::size_t>(words[i], sweep_.levelOfWord.size() - 1);
    rays_->learn(sensor.x, sensor.y, angle, sweep_.levelOfWord[word]);
    if (marks && std::isfinite(range))
      sweep_.surfaces->mark(sensor.x + range * std::cos(angle), sensor.y + range * std::sin(angle));
  }
}

void ScanRays::load(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
                    const FieldGrid& grid) {
  auto surfaces = SurfaceField::of(file, prefix);
  auto rays = std::make_shared<DirectionTable>();
  rays->load(file, prefix, grid,
             [this](int directions) { return runLength(scan_.config(), directions); });
  surfaces_ = std::move(surfaces);
  rays_ = std::move(rays);
}

std::vector<double> ScanRays::at(const Pose2& sensor) const {
  const ScanData::Config& config = scan_.config();
  std::vector<double> expected;
  for (int i = 0; i < config.beams; ++i) {
    const double bearing = config.firstAngle + i * config.angleStep;
    const auto range = rangeBetween(*rays_, scale_, {sensor.x, sensor.y, sensor.theta + bearing});
    if (!range) return {};
    expected.push_back(*range);
  }
  return expected;
}

std::shared_ptr<const Weigher> ScanRays::weigher() const {
  const Learned learned{rays_, surfaces_, scale_};
  auto weigher = learned.weigherOf(scan_.mount(), scan_.config(), scan_.ranges());
  if (weigher)
    weigher->setTrace(
        {surfaces_, scan_.mount(), scan_.config(), scan_.ranges(),
         [learned, mount = scan_.mount(), config = scan_.config()](std::span<const float> ranges) {
           return learned.weigherOf(mount, config, ranges);
         }});
  return weigher;
}

}  // namespace

std::unique_ptr<Expectations> expectedRays(const ScanData& scan, const ScanData::Config& config) {
  return std::make_unique<ScanRays>(scan, config);
}

}  // namespace ortung
