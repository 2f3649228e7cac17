#include "ortung/formats/ConeData.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "CellLookup.hpp"
#include "FormatTools.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung {

namespace {

class ConeWeigher final : public Weigher {
 public:
  ConeWeigher(std::shared_ptr<const DirectionTable> table, const Pose2& mount,
              const RangeScale& scale, const SensorModel& model, double reading)
      : table_(std::move(table)), mount_(mount), floor_(static_cast<float>(model.logFloor())) {
    for (int level = 0; level < 256; ++level) {
      logByLevel_[static_cast<std::size_t>(level)] =
          logProbabilityOf(static_cast<std::uint8_t>(level), scale, model, reading);
    }
  }

 private:
  static float logProbabilityOf(std::uint8_t level, const RangeScale& scale,
                                const SensorModel& model, double reading) {
    const bool sees = std::isfinite(reading);
    const bool shouldSee = level != RangeScale::kNothing;
    if (sees && shouldSee) {
      const double sigmas = (reading - scale.range(level)) / model.sigmaAt(reading);
      return static_cast<float>(model.exponent * model.logProbability(sigmas));
    }
    if (sees == shouldSee) return 0.0F;
    return static_cast<float>(model.exponent *
                              std::log(sees ? model.outliers : model.maxRangeMass));
  }

  double logProbabilityAt(const Pose2& pose) const override {
    const Pose2 sensor = pose * mount_;
    const std::uint8_t* row = table_->row(sensor.x, sensor.y);
    if (row == nullptr) return std::numeric_limits<double>::quiet_NaN();
    return logByLevel_[row[table_->directionOf(sensor.theta)]];
  }

  void weigh(const SampleView& poses, std::span<float> logProbability) const override {
    const CellLookup lookup(table_->grid());
    forEachSensorPose(poses, mount_, [&](std::size_t i, float x, float y, float theta) {
      const std::ptrdiff_t cell = lookup(x, y);
      const std::uint8_t* row = cell < 0 ? nullptr : table_->rowOfCell(cell);
      logProbability[i] += row == nullptr ? floor_ : logByLevel_[row[table_->directionOf(theta)]];
    });
  }

  PoseResolution resolution() const override {
    return {.metres = table_->grid().cell, .radians = table_->step()};
  }

  std::shared_ptr<const DirectionTable> table_;
  Pose2 mount_;
  float floor_;
  std::array<float, 256> logByLevel_{};  ///< ln p of the reading by expected level
};

}  // namespace

ConeData::ConeData(SensorId id, const Pose2& mount, const Config& config)
    : SensorData(std::move(id), mount),
      config_(config),
      scale_(config.maxRange, config.resolution),
      table_(std::make_shared<DirectionTable>()) {}

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
}

std::string ConeData::wordsHelp() const {
  return "[distance mm]; 0: not valid; from " + keyNumber(config_.maxRange * 1000) +
         " on: nothing seen, within " + keyNumber(degrees(config_.openingAngle)) + " deg";
}

void ConeData::startTables(const FieldRegion& region, double headingStep) {
  const int directions = std::max(1, static_cast<int>(std::lround(kTurn / headingStep)));
  headingStep_ = kTurn / directions;
  table_ = std::make_shared<DirectionTable>();
  table_->start(region, directions, 1);
}

void ConeData::learn(const Pose2& robotInField) {
  const Pose2 sensor = robotInField * mount();
  if (!std::isnan(reading_))
    table_->learn(sensor.x, sensor.y, sensor.theta, scale_.level(reading_));
}

void ConeData::finishTables() { table_->finish(); }

std::vector<double> ConeData::expectation(const Pose2& pose) const {
  const Pose2 sensor = pose * mount();
  const std::uint8_t* row = table_->row(sensor.x, sensor.y);
  if (row == nullptr) return {};
  return {scale_.range(row[table_->directionOf(sensor.theta)])};
}

std::shared_ptr<const Weigher> ConeData::makeWeigher() const {
  if (std::isnan(reading_)) return nullptr;
  return std::make_shared<ConeWeigher>(table_, mount(), scale_, config_.model, reading_);
}

std::string ConeData::learningKey() const {
  return "cone opening_rad=" + keyNumber(config_.openingAngle) +
         " max_range_m=" + keyNumber(config_.maxRange) +
         " scale=" + keyNumber(config_.resolution.metres) + "," +
         keyNumber(config_.resolution.perMetre) + " " + mountKey(mount());
}

void ConeData::saveTables(TableWriter& file, const std::string& prefix) const {
  table_->save(file, prefix);
}

void ConeData::useTables(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
                         const FieldGrid& grid) {
  auto table = std::make_shared<DirectionTable>();
  table->load(file, prefix, grid, [](int) { return 1; });
  table_ = std::move(table);
  headingStep_ = table_->step();
}

}  // namespace ortung
