#include "ortung/formats/PointsData.hpp"

#include <cmath>
#include <limits>

#include "EndPointWeigher.hpp"
#include "FormatTools.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung {
namespace {

constexpr std::size_t kWordsAPoint = 2;

}  // namespace

PointsData::PointsData(SensorId id, const Pose2& mount, const Config& config)
    : SensorData(std::move(id), mount),
      config_(config),
      tables_(std::make_shared<EndPointTables>()) {
  if (!(config.maxRange > 0.0) || !(config.cell > 0.0) || !(config.margin >= 0.0))
    throw std::invalid_argument("points need a greatest range and cells of positive size");
}

PointsData::~PointsData() = default;

std::vector<std::uint32_t> PointsData::encode(std::span<const Point> points) {
  std::vector<std::uint32_t> out;
  encode(points, out);
  return out;
}

void PointsData::encode(std::span<const Point> points, std::vector<std::uint32_t>& out) {
  out.clear();
  out.reserve(points.size() * kWordsAPoint);
  for (const Point& point : points) {
    out.push_back(words::fromMetres(point.range));
    out.push_back(words::fromAngle(point.bearing));
  }
}

void PointsData::check(std::span<const std::uint32_t> words) const {
  checkEntries(words, kWordsAPoint, kMostPoints, "two a point and at most 4096 points");
  for (std::size_t i = 1; i < words.size(); i += kWordsAPoint) checkAngleWord(words[i]);
}

void PointsData::decode(std::span<const std::uint32_t> words) {
  reading_.clear();
  for (std::size_t i = 0; i < words.size(); i += kWordsAPoint)
    reading_.push_back({words::toMetres(words[i]), words::toAngle(words[i + 1])});
}

Format PointsData::format() const { return Format(formats::kPoints); }

std::string PointsData::wordsHelp() const {
  return "[distance mm, bearing 1/100 degree + 18000] a point, or none: looked and saw nothing";
}

double PointsData::headingSpacing() const { return spacingOf(config_.fieldOfView); }

void PointsData::startTables(const FieldRegion& region, double) {
  tables_ = std::make_shared<EndPointTables>();
  tables_->region = region.grid;
  tables_->field.start(region.grid, config_.cell, config_.margin);
  tables_->surfaces->start(region, config_.cell, config_.margin);
}

void PointsData::learn(const Pose2& robotInField) {
  const Pose2 sensor = robotInField * mount();
  for (const Point& point : reading_) {
    if (point.range > config_.maxRange) continue;
    const double angle = sensor.theta + point.bearing;
    const double x = sensor.x + point.range * std::cos(angle);
    const double y = sensor.y + point.range * std::sin(angle);
    tables_->field.mark(x, y);
    tables_->surfaces->mark(x, y);
  }
}

void PointsData::finishTables() {
  tables_->field.finish();
  tables_->surfaces->finish();
  tables_->complete(config_.model, config_.maxRange);
}

void PointsData::useTables(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
                           const FieldGrid& grid) {
  auto tables = std::make_shared<EndPointTables>();
  tables->region = grid;
  tables->field.load(file, prefix);
  tables->surfaces->load(file, prefix);
  tables->complete(config_.model, config_.maxRange);
  tables_ = std::move(tables);
}

void PointsData::saveTables(TableWriter& file, const std::string& prefix) const {
  tables_->field.save(file, prefix);
  tables_->surfaces->save(file, prefix);
}

std::string PointsData::learningKey() const {
  return "points max_range_m=" + keyNumber(config_.maxRange) +
         " fov_rad=" + keyNumber(config_.fieldOfView) + " cell_m=" + keyNumber(config_.cell) +
         " margin_m=" + keyNumber(config_.margin) + " " + mountKey(mount());
}

/// Returns the points within range, evenly picked if there are too many.
std::shared_ptr<const Weigher> PointsData::makeWeigher() const {
  auto weigher = std::make_shared<EndPointWeigher>(tables_, mount());
  const std::size_t count = reading_.size();
  const std::size_t most =
      config_.usedPoints > 0 ? static_cast<std::size_t>(config_.usedPoints) : kMostPoints;
  const std::size_t used = std::min(count, most);
  for (std::size_t k = 0; k < used; ++k) {
    const Point& point = reading_[k * count / used];
    if (point.range <= config_.maxRange) weigher->add(point.range, point.bearing);
  }
  return weigher->isEmpty() ? nullptr : weigher;
}

std::vector<WordValue> PointsData::valuesIn(std::span<const std::uint32_t> words) const {
  std::vector<WordValue> values;
  const double half = halfViewOf(config_.fieldOfView);
  for (std::size_t i = 0; i + 2 <= words.size(); i += 2) {
    values.push_back(
        {i, i / 2, ValueKind::kRange, words::toMetres(words[i]), 0.0, config_.maxRange});
    values.push_back(
        {i + 1, i / 2, ValueKind::kBearing, words::toAngle(words[i + 1]), -half, half});
  }
  return values;
}

std::vector<double> PointsData::expectation(const Pose2& pose) const {
  if (!isLearned()) return {};
  const Pose2 sensor = pose * mount();
  const EndPointField& field = tables_->field;
  std::vector<double> distances;
  for (const Point& point : reading_) {
    const double angle = sensor.theta + point.bearing;
    const std::ptrdiff_t cell = field.grid().cellAt(sensor.x + point.range * std::cos(angle),
                                                    sensor.y + point.range * std::sin(angle));
    distances.push_back(cell < 0 ? std::numeric_limits<double>::quiet_NaN()
                                 : field.levels()[static_cast<std::size_t>(cell)] *
                                       field.metresPerLevel());
  }
  return distances;
}

}  // namespace ortung
