#include "ortung/formats/PointsData.hpp"

#include <cmath>
#include <limits>

#include "EndPointExpectations.hpp"
#include "FormatTools.hpp"

namespace ortung {
namespace {

constexpr std::size_t kWordsAPoint = 2;

class SeenPoints final : public EndPointExpectations {
 public:
  SeenPoints(const PointsData& points, const PointsData::Config& config)
      : EndPointExpectations({.cell = config.cell,
                              .margin = config.margin,
                              .maxRange = config.maxRange,
                              .model = config.model}),
        points_(points) {}

  std::string key() const override {
    const PointsData::Config& config = points_.config();
    return "points max_range_m=" + keyNumber(config.maxRange) +
           " fov_rad=" + keyNumber(config.fieldOfView) + " cell_m=" + keyNumber(config.cell) +
           " margin_m=" + keyNumber(config.margin) + " " + mountKey(points_.mount());
  }
  double headingSpacing() const override { return spacingOf(points_.config().fieldOfView); }

  void learn(const Pose2& sensor) override {
    for (const PointsData::Point& point : points_.reading()) {
      if (point.range > points_.config().maxRange) continue;
      const double angle = sensor.theta + point.bearing;
      mark(sensor.x + point.range * std::cos(angle), sensor.y + point.range * std::sin(angle));
    }
  }

  std::vector<double> at(const Pose2& sensor) const override {
    if (!points_.isLearned()) return {};
    const EndPointField& field = tables()->field;
    std::vector<double> distances;
    for (const PointsData::Point& point : points_.reading()) {
      const double angle = sensor.theta + point.bearing;
      const std::ptrdiff_t cell = field.grid().cellAt(sensor.x + point.range * std::cos(angle),
                                                      sensor.y + point.range * std::sin(angle));
      distances.push_back(cell < 0 ? std::numeric_limits<double>::quiet_NaN()
                                   : field.levels()[static_cast<std::size_t>(cell)] *
                                         field.metresPerLevel());
    }
    return distances;
  }

  /// Weighs by the points within range, evenly picked if there are too many.
  std::shared_ptr<const Weigher> weigher() const override {
    auto weigher = std::make_shared<EndPointWeigher>(tables(), points_.mount());
    const PointsData::Config& config = points_.config();
    const PointsData::Reading& reading = points_.reading();
    const std::size_t count = reading.size();
    const std::size_t most = config.usedPoints > 0 ? static_cast<std::size_t>(config.usedPoints)
                                                   : PointsData::kMostPoints;
    const std::size_t used = std::min(count, most);
    for (std::size_t k = 0; k < used; ++k) {
      const PointsData::Point& point = reading[k * count / used];
      if (point.range <= config.maxRange) weigher->add(point.range, point.bearing);
    }
    return weigher->isEmpty() ? nullptr : weigher;
  }

 private:
  const PointsData& points_;
};

}  // namespace

PointsData::PointsData(SensorId id, const Pose2& mount, const Config& config)
    : LearnedData(std::move(id), mount, std::make_unique<SeenPoints>(*this, config)),
      config_(config) {
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

Format PointsData::format() const { return Format(kFormat); }

std::string PointsData::wordsHelp() const {
  return "[distance mm, bearing 1/100 degree + 18000] a point, or none: looked and saw nothing";
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

}  // namespace ortung
