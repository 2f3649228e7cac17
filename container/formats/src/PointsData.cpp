#include "ortung/formats/PointsData.hpp"

#include <cmath>
#include <limits>

#include "EndPointWeigher.hpp"
#include "FormatTools.hpp"
#include "ortung/base/OneSample.hpp"

namespace ortung {
namespace {

constexpr std::size_t kWordsAPoint = 2;

}  // namespace

struct PointsData::Prepared {
  EndPointWeigher points;
};

PointsData::PointsData(SensorId id, const Pose2& mount, const Config& config)
    : SensorData(std::move(id), mount), config_(config), prepared_(std::make_unique<Prepared>()) {
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
  if (isLearned()) prepare();
}

std::string PointsData::wordsHelp() const {
  return "[distance mm, bearing 1/100 degree + 18000] a point";
}

double PointsData::headingSpacing() const { return spacingOf(config_.fieldOfView); }

bool PointsData::isInformative() const { return !prepared_->points.empty(); }

void PointsData::startTables(const FieldRegion& region, double) {
  grid_ = region.grid;
  field_.start(region.grid, config_.cell, config_.margin);
}

void PointsData::learn(const Pose2& robotInField) {
  const Pose2 sensor = robotInField * mount();
  for (const Point& point : reading_) {
    if (point.range > config_.maxRange) continue;
    const double angle = sensor.theta + point.bearing;
    field_.mark(sensor.x + point.range * std::cos(angle), sensor.y + point.range * std::sin(angle));
  }
}

void PointsData::finishTables() {
  field_.finish();
  prepare();
}

void PointsData::useTables(const TableFile& file, const std::string& prefix,
                           const FieldGrid& grid) {
  grid_ = grid;
  field_.load(file, prefix);
  prepare();
}

void PointsData::saveTables(TableWriter& file, const std::string& prefix) const {
  field_.save(file, prefix);
}

std::string PointsData::learningKey() const {
  return "points max_range_m=" + keyNumber(config_.maxRange) +
         " fov_rad=" + keyNumber(config_.fieldOfView) + " cell_m=" + keyNumber(config_.cell) +
         " margin_m=" + keyNumber(config_.margin) + " " + mountKey(mount());
}

/// Points within range, evenly picked if they are too many.
void PointsData::prepare() {
  prepared_->points.start(config_.model, config_.maxRange, field_);
  const std::size_t count = reading_.size();
  const std::size_t most =
      config_.usedPoints > 0 ? static_cast<std::size_t>(config_.usedPoints) : kMostPoints;
  const std::size_t used = std::min(count, most);
  for (std::size_t k = 0; k < used; ++k) {
    const Point& point = reading_[k * count / used];
    if (point.range <= config_.maxRange) prepared_->points.add(mount(), point.range, point.bearing);
  }
}

std::vector<double> PointsData::expectation(const Pose2& pose) const {
  if (!isLearned()) return {};
  const Pose2 sensor = pose * mount();
  std::vector<double> distances;
  for (const Point& point : reading_) {
    const double angle = sensor.theta + point.bearing;
    const std::ptrdiff_t cell = field_.grid().cellAt(sensor.x + point.range * std::cos(angle),
                                                     sensor.y + point.range * std::sin(angle));
    distances.push_back(cell < 0 ? std::numeric_limits<double>::quiet_NaN()
                                 : field_.levels()[static_cast<std::size_t>(cell)] *
                                       field_.metresPerLevel());
  }
  return distances;
}

double PointsData::logProbabilityAt(const Pose2& pose) const {
  const Pose2 sensor = pose * mount();
  if (grid_.cellAt(sensor.x, sensor.y) < 0) return std::numeric_limits<double>::quiet_NaN();
  return weighOne(pose, [this](const SampleView& one, std::span<float> out) { weigh(one, out); });
}

void PointsData::weigh(const SampleView& poses, std::span<float> logProbability) const {
  prepared_->points.weigh(grid_, field_, mount(), poses, logProbability);
}

}  // namespace ortung
