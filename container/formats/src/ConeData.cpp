#include "ortung/formats/ConeData.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "CellLookup.hpp"
#include "Expectations.hpp"
#include "FormatTools.hpp"
#include "TableSlope.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/core/Polishable.hpp"
#include "ortung/tables/DirectionTable.hpp"

namespace ortung {

namespace {

class ConeWeigher final : public Weigher, public Polishable {
 public:
  ConeWeigher(std::shared_ptr<const DirectionTable> table, const Pose2& mount,
              const RangeScale& scale, const SensorModel& model, double reading)
      : table_(std::move(table)),
        mount_(mount),
        scale_(scale),
        model_(model),
        reading_(reading),
        floor_(static_cast<float>(model.logFloor())) {
    for (int level = 0; level < 256; ++level) {
      logByLevel_[static_cast<std::size_t>(level)] =
          logProbabilityOf(static_cast<std::uint8_t>(level));
    }
  }

  /// Returns no slope if nothing is in sight of a neighbour of the pose's cell, or in the reading.
  Slope slopeAt(const Pose2& robot) const override {
    Slope slope;
    if (!std::isfinite(reading_)) return slope;
    const Pose2 sensor = robot * mount_;
    const double metres = 0.5 * table_->grid().cell;
    const double radians = 0.5 * table_->step();
    const auto by = [&](double x, double y, double theta) {
      return expected({sensor.x + x, sensor.y + y, sensor.theta + theta}) -
             expected({sensor.x - x, sensor.y - y, sensor.theta - theta});
    };
    addResidual(slope, reading_ - expected(sensor),
                byRobot(by(metres, 0, 0) / (2 * metres), by(0, metres, 0) / (2 * metres),
                        by(0, 0, radians) / (2 * radians), robot, sensor),
                model_.sigmaAt(reading_), model_);
    return slope;
  }

 private:
  float logProbabilityOf(std::uint8_t level) const {
    const bool sees = std::isfinite(reading_);
    const bool shouldSee = level != RangeScale::kNothing;
    if (sees && shouldSee) {
      const double sigmas = (reading_ - scale_.range(level)) / model_.sigmaAt(reading_);
      return static_cast<float>(model_.exponent * model_.logProbability(sigmas));
    }
    if (sees == shouldSee) return 0.0F;
    return static_cast<float>(model_.exponent *
                              std::log(sees ? model_.outliers : model_.maxRangeMass));
  }

  /// Returns the range interpolated between the cells and directions around a pose [m]; NaN if
  /// nothing is in sight of one of them.
  double expected(const Pose2& sensor) const {
    const FieldGrid& grid = table_->grid();
    const double column = (sensor.x - grid.originX) / grid.cell - 0.5;
    const double row = (sensor.y - grid.originY) / grid.cell - 0.5;
    const double direction = sensor.theta / table_->step();
    double sum = 0.0;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const auto near = [&](double place, unsigned bit) {
        return std::floor(place) + ((corner & bit) != 0 ? 1.0 : 0.0);
      };
      const auto share = [&](double place, unsigned bit) {
        return 1.0 - std::abs(place - near(place, bit));
      };
      const std::uint8_t* levels = table_->row(grid.originX + (near(column, 1) + 0.5) * grid.cell,
                                               grid.originY + (near(row, 2) + 0.5) * grid.cell);
      if (levels == nullptr) return std::numeric_limits<double>::quiet_NaN();
      const std::uint8_t level = levels[table_->directionOf(near(direction, 4) * table_->step())];
      if (level == RangeScale::kNothing) return std::numeric_limits<double>::quiet_NaN();
      sum += share(column, 1) * share(row, 2) * share(direction, 4) * scale_.range(level);
    }
    return sum;
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
  RangeScale scale_;
  SensorModel model_;
  double reading_;  ///< [m]
  float floor_;
  std::array<float, 256> logByLevel_{};  ///< ln p of the reading by expected level
};

class ConeRanges final : public Expectations {
 public:
  ConeRanges(const ConeData& cone, const ConeData::Config& config)
      : cone_(cone),
        scale_(config.maxRange, config.resolution),
        table_(std::make_shared<DirectionTable>()) {}

  std::string key() const override {
    const ConeData::Config& config = cone_.config();
    return "cone opening_rad=" + keyNumber(config.openingAngle) +
           " max_range_m=" + keyNumber(config.maxRange) +
           " scale=" + keyNumber(config.resolution.metres) + "," +
           keyNumber(config.resolution.perMetre) + " " + mountKey(cone_.mount());
  }
  double headingSpacing() const override { return headingStep_; }
  ExpectationGrain grain() const override { return ExpectationGrain::kCellsAndDirections; }

  void start(const FieldRegion& region, double headingStep) override {
    const int directions = std::max(1, static_cast<int>(std::lround(kTurn / headingStep)));
    headingStep_ = kTurn / directions;
    table_ = std::make_shared<DirectionTable>();
    table_->start(region, directions, 1);
  }
  void learn(const Pose2& sensor) override {
    const double range = cone_.reading();
    if (!std::isnan(range)) table_->learn(sensor.x, sensor.y, sensor.theta, scale_.level(range));
  }
  void finish() override { table_->finish(); }

  void save(TableWriter& file, const std::string& prefix) const override {
    table_->save(file, prefix);
  }
  void load(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
            const FieldGrid& grid) override {
    auto table = std::make_shared<DirectionTable>();
    table->load(file, prefix, grid, [](int) { return 1; });
    table_ = std::move(table);
    headingStep_ = table_->step();
  }

  std::vector<double> at(const Pose2& sensor) const override {
    const std::uint8_t* row = table_->row(sensor.x, sensor.y);
    if (row == nullptr) return {};
    return {scale_.range(row[table_->directionOf(sensor.theta)])};
  }
  std::shared_ptr<const Weigher> weigher() const override {
    const double range = cone_.reading();
    if (std::isnan(range)) return nullptr;
    return std::make_shared<ConeWeigher>(table_, cone_.mount(), scale_, cone_.config().model,
                                         range);
  }

 private:
  const ConeData& cone_;
  RangeScale scale_;
  std::shared_ptr<DirectionTable> table_;
  double headingStep_ = 0.1;  ///< [rad]
};

}  // namespace

ConeData::ConeData(SensorId id, const Pose2& mount, const Config& config)
    : LearnedData(std::move(id), mount, std::make_unique<ConeRanges>(*this, config)),
      config_(config) {}

ConeData::~ConeData() = default;

ConeData::Config ConeData::configOf(const Format& format, std::span<const std::uint32_t>) {
  Config config;
  config.openingAngle = format.angle("opening_deg");
  config.maxRange = format.number("max_m");
  return config;
}

std::uint32_t ConeData::encode(Reading reading, double maxRange) {
  if (std::isnan(reading)) return 0;
  // "Nothing seen" is one millimetre above the greatest range, so that it survives any rounding.
  if (reading >= maxRange) return words::fromMetres(maxRange) + 1;
  return std::max(words::fromMetres(reading), 1U);
}

void ConeData::check(std::span<const std::uint32_t> words) const { checkWordCount(words, 1); }

void ConeData::decode(std::span<const std::uint32_t> words) { reading_ = rangeOf(words[0]); }

ConeData::Reading ConeData::rangeOf(std::uint32_t word) const {
  const double range = words::toMetres(word);
  if (word == 0) return std::numeric_limits<double>::quiet_NaN();
  return range >= config_.maxRange ? std::numeric_limits<double>::infinity() : range;
}

Format ConeData::format() const {
  return Format(kFormat)
      .withAngle("opening_deg", config_.openingAngle)
      .with("max_m", config_.maxRange);
}

std::string ConeData::wordsHelp() const {
  return "[distance mm]; 0: not valid; from " + keyNumber(config_.maxRange * 1000) +
         " on: nothing seen, within " + keyNumber(degrees(config_.openingAngle)) + " deg";
}

std::vector<double> ConeData::measured(const Pose2&) const {
  if (sequence() == 0) return {};
  return {reading_};
}

std::vector<WordValue> ConeData::valuesIn(std::span<const std::uint32_t> words) const {
  return {{.kind = ValueKind::kRange, .value = rangeOf(words[0]), .most = config_.maxRange}};
}

void ConeData::store(const WordValue& value, std::span<std::uint32_t> words) const {
  words[value.word] = encode(value.value, config_.maxRange);
}

}  // namespace ortung
