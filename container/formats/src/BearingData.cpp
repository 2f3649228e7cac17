#include "ortung/formats/BearingData.hpp"

#include <limits>

#include "CellExpectations.hpp"

namespace ortung {
namespace {

class Bearings final : public CellExpectations<BearingTable, BearingData> {
 public:
  Bearings(const BearingData& feature, const BearingData::Config& config)
      : CellExpectations(feature, "direction", BearingTable(), config.model) {}

  std::string key() const override {
    return "bearing fov_rad=" + keyNumber(feature().config().fieldOfView) + " " +
           mountKey(feature().mount());
  }
  void learn(const Pose2& sensor) override {
    if (const BearingData::Reading reading = feature().reading())
      table().learn(sensor.x, sensor.y, sensor.theta + *reading);
  }
  std::vector<double> at(const Pose2& sensor) const override {
    return {wrapAngle(table().at(sensor.x, sensor.y) - sensor.theta)};
  }

 private:
  double sigmaAt(double) const override { return feature().config().model.sigma; }
};

}  // namespace

BearingData::BearingData(SensorId id, const Pose2& mount, const Config& config)
    : LearnedData(std::move(id), mount, std::make_unique<Bearings>(*this, config)),
      config_(config) {}

BearingData::~BearingData() = default;

std::vector<std::uint32_t> BearingData::encode(const Reading& reading) {
  if (!reading) return {};
  return {words::fromAngle(*reading)};
}

void BearingData::check(std::span<const std::uint32_t> words) const {
  if (words.empty()) return;
  checkWordCount(words, 1);
  checkAngleWord(words[0]);
}

void BearingData::decode(std::span<const std::uint32_t> words) {
  reading_ = words.empty() ? Reading() : Reading(words::toAngle(words[0]));
}

Format BearingData::format() const { return Format(kFormat); }

std::string BearingData::wordsHelp() const {
  return "[bearing 1/100 degree + 18000], or none: looked and saw nothing";
}

std::vector<double> BearingData::measured(const Pose2&) const {
  return {reading_.value_or(std::numeric_limits<double>::quiet_NaN())};
}

std::vector<WordValue> BearingData::valuesIn(std::span<const std::uint32_t> words) const {
  if (words.empty()) return {};
  const double half = halfViewOf(config_.fieldOfView);
  return {{.kind = ValueKind::kBearing,
           .value = words::toAngle(words[0]),
           .least = -half,
           .most = half}};
}

}  // namespace ortung
