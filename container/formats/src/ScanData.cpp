#include "ortung/formats/ScanData.hpp"

#include <algorithm>
#include <limits>

#include "EndPointWeigher.hpp"
#include "FormatTools.hpp"
#include "SurfaceRay.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung {
namespace {

constexpr int kMostBeams = 8192;
/// Distance between positions from which surfaces are marked [cells of the surfaces]: that is
/// enough for beams of many positions to meet in each cell.
constexpr double kCellsApart = 6.0;

std::uint32_t wordOf(double range, double maxRange) {
  if (std::isnan(range)) return 0;
  return range >= maxRange ? words::fromMetres(maxRange) + 1
                           : std::max(words::fromMetres(range), 1U);
}

/// Returns the number of headings whose scans together span a turn.
int fewestViews(const ScanData::Config& config) {
  const double span = std::min(config.beams * config.angleStep, kTurn);
  const auto views = static_cast<int>(std::ceil(kTurn / span - 1e-9));
  // With one view more than a turn needs, beams of the views interleave, so fewer directions stay
  // empty.
  return views == 1 ? 1 : views + 1;
}

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

}  // namespace

struct ScanData::Learning {
  std::vector<std::uint8_t> levelOfWord;
  int views = 0;  ///< headings a turn; 0: not known yet
  FieldGrid grid;
  /// Says for each cell of the grid whether the scan from there marks surfaces.
  std::vector<bool> showsSurfaces;
};

ScanData::ScanData(SensorId id, const Pose2& mount, const Config& config)
    : SensorData(std::move(id), mount),
      config_(config),
      scale_(config.maxRange, config.resolution),
      rays_(std::make_shared<DirectionTable>()),
      endPoints_(std::make_shared<EndPointTables>()),
      surfaces_(endPoints_->surfaces),
      learning_(std::make_unique<Learning>()) {
  if (config.beams < 1 || config.beams > kMostBeams || !(config.angleStep > 0.0) ||
      config.beams * config.angleStep > kTurn + config.angleStep) {
    throw std::invalid_argument("a scan has 1 to 8192 beams that span at most a turn");
  }
  ranges_.assign(static_cast<std::size_t>(config.beams), std::numeric_limits<float>::quiet_NaN());
}

ScanData::~ScanData() = default;

ScanData::Reading ScanData::reading() const {
  return {config_.firstAngle, config_.angleStep, ranges_};
}

void ScanData::encode(std::span<const float> ranges, double maxRange,
                      std::vector<std::uint32_t>& words) {
  words.resize(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i)
    words[i] = wordOf(static_cast<double>(ranges[i]), maxRange);
}

void ScanData::check(std::span<const std::uint32_t> words) const {
  checkWordCount(words, ranges_.size());
}

void ScanData::decode(std::span<const std::uint32_t> words) {
  for (std::size_t i = 0; i < words.size(); ++i) ranges_[i] = static_cast<float>(rangeOf(words[i]));
}

double ScanData::rangeOf(std::uint32_t word) const {
  const double range = words::toMetres(word);
  if (word == 0 || range < config_.minRange) return std::numeric_limits<double>::quiet_NaN();
  return range >= config_.maxRange ? std::numeric_limits<double>::infinity() : range;
}

Format ScanData::format() const {
  Format format(formats::kScan);
  format.with("beams", config_.beams)
      .withAngle("first_deg", config_.firstAngle)
      .withAngle("step_deg", config_.angleStep)
      .with("max_m", config_.maxRange);
  if (config_.minRange > 0.0) format.with("min_m", config_.minRange);
  return format;
}

std::string ScanData::wordsHelp() const {
  return "[distance mm] of each of " + std::to_string(config_.beams) + " beams from " +
         keyNumber(degrees(config_.firstAngle)) + " deg in steps of " +
         keyNumber(degrees(config_.angleStep)) + " deg; 0: not valid; from " +
         keyNumber(config_.maxRange * 1000) + " on: nothing seen";
}

double ScanData::headingSpacing() const {
  if (learning_->views > 0) return kTurn / learning_->views;
  return kTurn / fewestViews(config_);
}

double ScanData::positionSpacing() const {
  return config_.perception == Perception::kEndPoints ? kCellsApart * config_.endPointCell : 0.0;
}

int ScanData::runLength(int directions) const {
  const double step = kTurn / directions;
  const auto run =
      static_cast<int>(std::lround((config_.beams - 1) * config_.angleStep / step)) + 1;
  return std::min(run, directions);
}

// --- learning ------------------------------------------------------------------------------

void ScanData::startTables(const FieldRegion& region, double headingStep) {
  surfaces_ = std::make_shared<SurfaceField>();
  surfaces_->start(region, config_.endPointCell, 2 * config_.endPointCell);
  if (config_.perception == Perception::kEndPoints) {
    endPoints_ = std::make_shared<EndPointTables>();
    endPoints_->surfaces = surfaces_;
    endPoints_->region = region.grid;
    endPoints_->field.start(region.grid, config_.endPointCell, 2 * config_.endPointCell);
    return;
  }
  const int directions = std::max(1, static_cast<int>(std::lround(kTurn / headingStep)));
  rays_ = std::make_shared<DirectionTable>();
  rays_->start(region, directions, runLength(directions));
  learning_->views = viewsFor(config_, directions);
  learning_->grid = region.grid;
  learning_->showsSurfaces.assign(region.grid.size(), false);
  for (const std::size_t cell : openCellsApart(region, kCellsApart * config_.endPointCell))
    learning_->showsSurfaces[cell] = true;
  // The last word is beyond the greatest range, and stands for all such ranges.
  learning_->levelOfWord.resize(words::fromMetres(config_.maxRange) + 2);
  for (std::uint32_t word = 0; word < learning_->levelOfWord.size(); ++word) {
    learning_->levelOfWord[word] = scale_.level(words::toMetres(word));
  }
}

/// Returns whether surfaces are marked from there. A ray table is learned in every cell, but scans
/// from all of them would add no information about a surface.
bool ScanData::marksFrom(const Pose2& sensor) const {
  if (config_.perception == Perception::kEndPoints) return true;
  const std::ptrdiff_t cell = learning_->grid.cellAt(sensor.x, sensor.y);
  return cell >= 0 && learning_->showsSurfaces[static_cast<std::size_t>(cell)];
}

void ScanData::learn(const Pose2& robotInField) {
  const Pose2 sensor = robotInField * mount();
  const std::span<const std::uint32_t> words = getData();
  const bool marks = marksFrom(sensor);
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    const double angle =
        sensor.theta + config_.firstAngle + static_cast<double>(i) * config_.angleStep;
    const auto range = static_cast<double>(ranges_[i]);
    if (std::isnan(range)) continue;
    if (config_.perception == Perception::kRays) {
      const std::size_t word = std::min<std::size_t>(words[i], learning_->levelOfWord.size() - 1);
      rays_->learn(sensor.x, sensor.y, angle, learning_->levelOfWord[word]);
    }
    if (!marks || !std::isfinite(range)) continue;
    const double x = sensor.x + range * std::cos(angle);
    const double y = sensor.y + range * std::sin(angle);
    if (config_.perception == Perception::kEndPoints) endPoints_->field.mark(x, y);
    surfaces_->mark(x, y);
  }
}

void ScanData::finishTables() {
  surfaces_->finish();
  learning_->levelOfWord = {};
  learning_->showsSurfaces = {};
  if (config_.perception == Perception::kRays) {
    rays_->finish();
  } else {
    endPoints_->field.finish();
    endPoints_->complete(config_.model, config_.maxRange);
  }
}

std::string ScanData::learningKey() const {
  const bool rays = config_.perception == Perception::kRays;
  std::string key = "scan beams=" + std::to_string(config_.beams) +
                    " first_rad=" + keyNumber(config_.firstAngle) +
                    " step_rad=" + keyNumber(config_.angleStep) +
                    " max_range_m=" + keyNumber(config_.maxRange) +
                    " perception=" + (rays ? "rays" : "endpoints");
  key += rays ? " scale=" + keyNumber(config_.resolution.metres) + "," +
                    keyNumber(config_.resolution.perMetre)
              : " cell_m=" + keyNumber(config_.endPointCell);
  return key + " " + mountKey(mount());
}

void ScanData::saveTables(TableWriter& file, const std::string& prefix) const {
  surfaces_->save(file, prefix);
  if (config_.perception == Perception::kRays) {
    rays_->save(file, prefix);
  } else {
    endPoints_->field.save(file, prefix);
  }
}

void ScanData::useTables(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
                         const FieldGrid& grid) {
  surfaces_ = std::make_shared<SurfaceField>();
  surfaces_->load(file, prefix);
  if (config_.perception == Perception::kRays) {
    auto rays = std::make_shared<DirectionTable>();
    rays->load(file, prefix, grid, [this](int directions) { return runLength(directions); });
    rays_ = std::move(rays);
  } else {
    auto endPoints = std::make_shared<EndPointTables>();
    endPoints->region = grid;
    endPoints->surfaces = surfaces_;
    endPoints->field.load(file, prefix);
    endPoints->complete(config_.model, config_.maxRange);
    endPoints_ = std::move(endPoints);
  }
}

ExpectationGrain ScanData::grain() const {
  return config_.perception == Perception::kEndPoints ? ExpectationGrain::kExact
                                                      : ExpectationGrain::kCellsAndDirections;
}

std::vector<double> ScanData::measured(const Pose2&) const {
  if (sequence() == 0) return {};
  return {ranges_.begin(), ranges_.end()};
}

std::vector<WordValue> ScanData::valuesIn(std::span<const std::uint32_t> words) const {
  std::vector<WordValue> values;
  values.reserve(words.size());
  for (std::size_t i = 0; i < words.size(); ++i)
    values.push_back({.word = i,
                      .entry = i,
                      .kind = ValueKind::kRange,
                      .value = rangeOf(words[i]),
                      .least = config_.minRange,
                      .most = config_.maxRange});
  return values;
}

void ScanData::store(const WordValue& value, std::span<std::uint32_t> words) const {
  words[value.word] = wordOf(value.value, config_.maxRange);
}

std::vector<double> ScanData::expectation(const Pose2& pose) const {
  const Pose2 sensor = pose * mount();
  std::vector<double> expected;
  if (config_.perception == Perception::kEndPoints) {  // these keep surfaces instead of ranges
    if (surfaces_->isEmpty() || surfaces_->grid().cellAt(sensor.x, sensor.y) < 0) return {};
    for (int i = 0; i < config_.beams; ++i)
      expected.push_back(rangeAlong(
          *surfaces_,
          {sensor.x, sensor.y, sensor.theta + config_.firstAngle + i * config_.angleStep},
          config_.maxRange));
    return expected;
  }
  const std::uint8_t* row = rays_->row(sensor.x, sensor.y);
  if (row == nullptr) return {};
  for (int i = 0; i < config_.beams; ++i) {
    expected.push_back(scale_.range(
        row[rays_->directionOf(sensor.theta + config_.firstAngle + i * config_.angleStep)]));
  }
  return expected;
}

}  // namespace ortung
