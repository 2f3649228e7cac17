#include "ortung/formats/ConeData.hpp"

#include <limits>

#include "CellLookup.hpp"
#include "FormatTools.hpp"

namespace ortung {

ConeData::ConeData(SensorId id, const Pose2& mount, const Config& config)
    : SensorData(std::move(id), mount),
      config_(config),
      scale_(config.maxRange, config.model.sigma, config.model.sigmaPerMetre),
      logByLevel_(256, 0.0F) {}

ConeData::~ConeData() = default;

std::uint32_t ConeData::encode(Reading reading, double maxRange) {
  if (std::isnan(reading)) return 0;
  // One millimetre above the greatest range: "nothing seen" survives any rounding.
  if (reading >= maxRange) return words::fromMetres(maxRange) + 1;
  return std::max(words::fromMetres(reading), 1U);
}

void ConeData::check(std::span<const std::uint32_t> words) const { checkWordCount(words, 1); }

void ConeData::decode(std::span<const std::uint32_t> words) {
  const double range = words::toMetres(words[0]);
  if (words[0] == 0) {
    reading_ = std::numeric_limits<double>::quiet_NaN();
  } else {
    reading_ = range >= config_.maxRange ? std::numeric_limits<double>::infinity() : range;
  }
  if (isLearned()) prepare();
}

void ConeData::prepare() {
  for (int level = 0; level < 256; ++level) {
    logByLevel_[static_cast<std::size_t>(level)] =
        logProbabilityOf(static_cast<std::uint8_t>(level));
  }
}

float ConeData::logProbabilityOf(std::uint8_t level) const {
  const SensorModel& model = config_.model;
  const bool sees = std::isfinite(reading_);
  const bool shouldSee = level != RangeScale::kNothing;
  if (sees && shouldSee) {
    const double sigmas = (reading_ - scale_.range(level)) / model.sigmaAt(reading_);
    return static_cast<float>(model.exponent * model.logProbability(sigmas));
  }
  if (sees == shouldSee) return 0.0F;
  return static_cast<float>(model.exponent * std::log(sees ? model.outliers : model.maxRangeMass));
}

bool ConeData::isInformative() const { return !std::isnan(reading_); }

std::string ConeData::wordsHelp() const {
  return "[distance mm]; 0: not valid; from " + keyNumber(config_.maxRange * 1000) +
         " on: nothing seen";
}

void ConeData::startTables(const FieldRegion& region, double headingStep) {
  const int directions = std::max(1, static_cast<int>(std::lround(kFullTurn / headingStep)));
  headingStep_ = kFullTurn / directions;
  table_.start(region, directions, 1);
}

void ConeData::learn(const Pose2& robotInField) {
  const Pose2 sensor = robotInField * mount();
  if (!std::isnan(reading_)) table_.learn(sensor.x, sensor.y, sensor.theta, scale_.level(reading_));
}

void ConeData::finishTables() {
  table_.finish();
  prepare();
}

std::vector<double> ConeData::expectation(const Pose2& pose) const {
  const Pose2 sensor = pose * mount();
  const std::uint8_t* row = table_.row(sensor.x, sensor.y);
  if (row == nullptr) return {};
  return {scale_.range(row[table_.directionOf(sensor.theta)])};
}

double ConeData::logProbabilityAt(const Pose2& pose) const {
  const Pose2 sensor = pose * mount();
  const std::uint8_t* row = table_.row(sensor.x, sensor.y);
  if (row == nullptr) return std::numeric_limits<double>::quiet_NaN();
  return logByLevel_[row[table_.directionOf(sensor.theta)]];
}

void ConeData::weigh(const SampleView& poses, std::span<float> logProbability) const {
  const CellLookup lookup(table_.grid());
  const auto floor = static_cast<float>(config_.model.logFloor());
  forEachSensorPose(poses, mount(), [&](std::size_t i, float x, float y, float theta) {
    const std::ptrdiff_t cell = lookup(x, y);
    const std::uint8_t* row = cell < 0 ? nullptr : table_.rowOfCell(cell);
    logProbability[i] += row == nullptr ? floor : logByLevel_[row[table_.directionOf(theta)]];
  });
}

std::string ConeData::learningKey() const {
  return "cone opening_rad=" + keyNumber(config_.openingAngle) +
         " max_range_m=" + keyNumber(config_.maxRange) +
         " scale=" + keyNumber(config_.model.sigma) + "," + keyNumber(config_.model.sigmaPerMetre) +
         " " + mountKey(mount());
}

void ConeData::saveTables(TableWriter& file, const std::string& prefix) const {
  table_.save(file, prefix);
}

void ConeData::useTables(const TableFile& file, const std::string& prefix, const FieldGrid& grid) {
  table_.load(file, prefix, grid, [](int) { return 1; });
  headingStep_ = table_.step();
  prepare();
}

}  // namespace ortung
