#include "ortung/formats/BearingData.hpp"

#include <limits>

#include "FormatTools.hpp"
#include "TableWeigher.hpp"

namespace ortung {

BearingData::BearingData(SensorId id, const Pose2& mount, const Config& config)
    : SensorData(std::move(id), mount), config_(config), gaussian_(config.model) {}

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

std::string BearingData::wordsHelp() const {
  return "[bearing 1/100 degree + 18000], or none: looked and saw nothing";
}
double BearingData::headingSpacing() const { return spacingOf(config_.fieldOfView); }

void BearingData::startTables(const FieldRegion& region, double) { table_.start(region.grid); }

void BearingData::learn(const Pose2& robotInField) {
  const Pose2 sensor = robotInField * mount();
  if (reading_) table_.learn(sensor.x, sensor.y, sensor.theta + *reading_);
}

std::vector<double> BearingData::expectation(const Pose2& pose) const {
  const Pose2 sensor = pose * mount();
  return {wrapAngle(table_.at(sensor.x, sensor.y) - sensor.theta)};
}

double BearingData::logProbabilityAt(const Pose2& pose) const {
  const double expected = expectation(pose)[0];
  if (std::isnan(expected)) return std::numeric_limits<double>::quiet_NaN();
  return gaussian_(static_cast<float>(wrapAngle(*reading_ - expected) / config_.model.sigma));
}

void BearingData::weigh(const SampleView& poses, std::span<float> logProbability) const {
  const auto reading = static_cast<float>(*reading_);
  const auto perSigma = static_cast<float>(1.0 / config_.model.sigma);
  TableWeigher weigher(table_.cells().grid());
  forEachPoseBlock<TableWeigher::kBlock>(
      poses, mount(), [&](std::size_t first, const SensorPoses& sensor, std::size_t n) {
        weigher.start(sensor, n);
        weigher.addBearing(table_, gaussian_, reading, perSigma, logProbability.data() + first);
      });
}

std::string BearingData::learningKey() const {
  return "bearing fov_rad=" + keyNumber(config_.fieldOfView) + " " + mountKey(mount());
}

void BearingData::saveTables(TableWriter& file, const std::string& prefix) const {
  table_.cells().save(file, prefix + "direction");
}

void BearingData::useTables(const TableFile& file, const std::string& prefix,
                            const FieldGrid& grid) {
  table_.cells().load(file, prefix + "direction", grid);
}

}  // namespace ortung
