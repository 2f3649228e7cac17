#include "ortung/formats/ScalarData.hpp"

#include <limits>

#include "CellExpectations.hpp"

namespace ortung {
namespace {

class Distances final : public CellExpectations<PositionTable, ScalarData> {
 public:
  Distances(const ScalarData& feature, const ScalarData::Config& config)
      : CellExpectations(feature, "distance", PositionTable(config.maxRange), config.model) {}

  std::string key() const override {
    return "distance max_range_m=" + keyNumber(feature().config().maxRange) +
           " fov_rad=" + keyNumber(feature().config().fieldOfView) + " " +
           mountKey(feature().mount());
  }
  void learn(const Pose2& sensor) override {
    const ScalarData::Reading reading = feature().reading();
    if (reading && *reading <= feature().config().maxRange)
      table().learn(sensor.x, sensor.y, *reading);
  }
  std::vector<double> at(const Pose2& sensor) const override {
    return {table().at(sensor.x, sensor.y)};
  }

 private:
  double sigmaAt(double reading) const override {
    return feature().config().model.sigmaAt(reading);
  }
};

}  // namespace

ScalarData::ScalarData(SensorId id, const Pose2& mount, const Config& config)
    : LearnedData(std::move(id), mount, std::make_unique<Distances>(*this, config)),
      config_(config) {}

ScalarData::~ScalarData() = default;

ScalarData::Config ScalarData::configOf(const Format& format, std::span<const std::uint32_t>) {
  Config config;
  if (format.has("max_m")) config.maxRange = format.number("max_m");
  return config;
}

std::vector<std::uint32_t> ScalarData::encode(const Reading& reading) {
  if (!reading) return {};
  return {words::fromMetres(*reading)};
}

void ScalarData::check(std::span<const std::uint32_t> words) const {
  if (!words.empty()) checkWordCount(words, 1);
}

void ScalarData::decode(std::span<const std::uint32_t> words) {
  reading_ = words.empty() ? Reading() : Reading(words::toMetres(words[0]));
}

Format ScalarData::format() const {
  Format format(kFormat);
  if (std::isfinite(config_.maxRange)) format.with("max_m", config_.maxRange);
  return format;
}

std::string ScalarData::wordsHelp() const {
  return "[distance mm], or none: looked and saw nothing";
}

std::vector<double> ScalarData::measured(const Pose2&) const {
  return {reading_.value_or(std::numeric_limits<double>::quiet_NaN())};
}

std::vector<WordValue> ScalarData::valuesIn(std::span<const std::uint32_t> words) const {
  if (words.empty()) return {};
  return {
      {.kind = ValueKind::kRange, .value = words::toMetres(words[0]), .most = config_.maxRange}};
}

}  // namespace ortung
