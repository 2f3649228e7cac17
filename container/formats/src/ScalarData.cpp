#include "ortung/formats/ScalarData.hpp"

#include <limits>

#include "FormatTools.hpp"
#include "TableWeigher.hpp"

namespace ortung {

ScalarData::ScalarData(SensorId id, const Pose2& mount, const Config& config)
    : SensorData(std::move(id), mount),
      config_(config),
      gaussian_(config.model),
      table_(config.maxRange) {}

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

std::string ScalarData::wordsHelp() const {
  return "[distance mm], or none: looked and saw nothing";
}
double ScalarData::headingSpacing() const { return spacingOf(config_.fieldOfView); }

void ScalarData::startTables(const FieldRegion& region, double) { table_.start(region.grid); }

void ScalarData::learn(const Pose2& robotInField) {
  const Pose2 sensor = robotInField * mount();
  if (reading_ && *reading_ <= config_.maxRange) table_.learn(sensor.x, sensor.y, *reading_);
}

std::vector<double> ScalarData::expectation(const Pose2& pose) const {
  const Pose2 sensor = pose * mount();
  return {table_.at(sensor.x, sensor.y)};
}

double ScalarData::logProbabilityAt(const Pose2& pose) const {
  const Pose2 sensor = pose * mount();
  const float expected = table_.at(sensor.x, sensor.y);
  if (std::isnan(expected)) return std::numeric_limits<double>::quiet_NaN();
  return gaussian_(static_cast<float>((*reading_ - expected) / config_.model.sigmaAt(*reading_)));
}

void ScalarData::weigh(const SampleView& poses, std::span<float> logProbability) const {
  const auto reading = static_cast<float>(*reading_);
  // Sigma at the reading's range, not the expectation's: the same for all samples.
  const auto perSigma = static_cast<float>(1.0 / config_.model.sigmaAt(*reading_));
  TableWeigher weigher(table_.cells().grid());
  forEachPoseBlock<TableWeigher::kBlock>(
      poses, mount(), [&](std::size_t first, const SensorPoses& sensor, std::size_t n) {
        weigher.start(sensor, n);
        weigher.addDistance(table_, gaussian_, reading, perSigma, logProbability.data() + first);
      });
}

std::string ScalarData::learningKey() const {
  return "distance max_range_m=" + keyNumber(config_.maxRange) +
         " fov_rad=" + keyNumber(config_.fieldOfView) + " " + mountKey(mount());
}

void ScalarData::saveTables(TableWriter& file, const std::string& prefix) const {
  table_.cells().save(file, prefix + "distance");
}

void ScalarData::useTables(const TableFile& file, const std::string& prefix,
                           const FieldGrid& grid) {
  table_.cells().load(file, prefix + "distance", grid);
}

}  // namespace ortung
