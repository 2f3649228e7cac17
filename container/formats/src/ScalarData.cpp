#include "ortung/formats/ScalarData.hpp"

#include "CellWeigher.hpp"
#include "FormatTools.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung {

ScalarData::ScalarData(SensorId id, const Pose2& mount, const Config& config)
    : SensorData(std::move(id), mount),
      config_(config),
      gaussian_(std::make_shared<GaussianTable>(config.model)),
      table_(std::make_shared<PositionTable>(config.maxRange)) {}

ScalarData::~ScalarData() = default;

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
  Format format(formats::kRange);
  if (std::isfinite(config_.maxRange)) format.with("max_m", config_.maxRange);
  return format;
}

std::string ScalarData::wordsHelp() const {
  return "[distance mm], or none: looked and saw nothing";
}
double ScalarData::headingSpacing() const { return spacingOf(config_.fieldOfView); }

void ScalarData::startTables(const FieldRegion& region, double) {
  table_ = std::make_shared<PositionTable>(config_.maxRange);
  table_->start(region.grid);
}

void ScalarData::learn(const Pose2& robotInField) {
  const Pose2 sensor = robotInField * mount();
  if (reading_ && *reading_ <= config_.maxRange) table_->learn(sensor.x, sensor.y, *reading_);
}

std::vector<double> ScalarData::measured(const Pose2&) const {
  return {reading_.value_or(std::numeric_limits<double>::quiet_NaN())};
}

std::vector<WordValue> ScalarData::valuesIn(std::span<const std::uint32_t> words) const {
  if (words.empty()) return {};
  return {
      {.kind = ValueKind::kRange, .value = words::toMetres(words[0]), .most = config_.maxRange}};
}

std::vector<double> ScalarData::expectation(const Pose2& pose) const {
  const Pose2 sensor = pose * mount();
  return {table_->at(sensor.x, sensor.y)};
}

std::shared_ptr<const Weigher> ScalarData::makeWeigher() const {
  if (!reading_) return nullptr;
  return std::make_shared<CellWeigher<PositionTable>>(table_, gaussian_, config_.model, mount(),
                                                      *reading_, config_.model.sigmaAt(*reading_));
}

std::string ScalarData::learningKey() const {
  return "distance max_range_m=" + keyNumber(config_.maxRange) +
         " fov_rad=" + keyNumber(config_.fieldOfView) + " " + mountKey(mount());
}

void ScalarData::saveTables(TableWriter& file, const std::string& prefix) const {
  table_->cells().save(file, prefix + "distance");
}

void ScalarData::useTables(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
                           const FieldGrid& grid) {
  auto table = std::make_shared<PositionTable>(config_.maxRange);
  table->cells().load(file, prefix + "distance", grid);
  table_ = std::move(table);
}

}  // namespace ortung
