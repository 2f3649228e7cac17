#include "ortung/formats/BearingData.hpp"

#include "CellWeigher.hpp"
#include "FormatTools.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung {

BearingData::BearingData(SensorId id, const Pose2& mount, const Config& config)
    : SensorData(std::move(id), mount),
      config_(config),
      gaussian_(std::make_shared<GaussianTable>(config.model)),
      table_(std::make_shared<BearingTable>()) {}

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

Format BearingData::format() const { return Format(formats::kBearing); }

std::string BearingData::wordsHelp() const {
  return "[bearing 1/100 degree + 18000], or none: looked and saw nothing";
}
double BearingData::headingSpacing() const { return spacingOf(config_.fieldOfView); }

void BearingData::startTables(const FieldRegion& region, double) {
  table_ = std::make_shared<BearingTable>();
  table_->start(region.grid);
}

void BearingData::learn(const Pose2& robotInField) {
  const Pose2 sensor = robotInField * mount();
  if (reading_) table_->learn(sensor.x, sensor.y, sensor.theta + *reading_);
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

std::vector<double> BearingData::expectation(const Pose2& pose) const {
  const Pose2 sensor = pose * mount();
  return {wrapAngle(table_->at(sensor.x, sensor.y) - sensor.theta)};
}

std::shared_ptr<const Weigher> BearingData::makeWeigher() const {
  if (!reading_) return nullptr;
  return std::make_shared<CellWeigher<BearingTable>>(table_, gaussian_, config_.model, mount(),
                                                     *reading_, config_.model.sigma);
}

std::string BearingData::learningKey() const {
  return "bearing fov_rad=" + keyNumber(config_.fieldOfView) + " " + mountKey(mount());
}

void BearingData::saveTables(TableWriter& file, const std::string& prefix) const {
  table_->cells().save(file, prefix + "direction");
}

void BearingData::useTables(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
                            const FieldGrid& grid) {
  auto table = std::make_shared<BearingTable>();
  table->cells().load(file, prefix + "direction", grid);
  table_ = std::move(table);
}

}  // namespace ortung
