#include "ortung/formats/ConeData.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "CellLookup.hpp"
#include "DirectionCorners.hpp"
#include "Expectations.hpp"
#include "FormatTools.hpp"
#include "LevelDifference.hpp"
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
        parts_(partsOf(scale, reading)),
        floor_(static_cast<float>(model.logFloor())) {
    const double known = std::min(reading, scale.maxRange());
    const double levels = scale.levelsPerSigma(known, model.sigmaAt(known));
    const double partsPerSigma = kPartsALevel * std::hypot(levels, kRoundingOfLevels);
    for (std::size_t parts = 0; parts < logByParts_.size(); ++parts) {
      const double sigmas = static_cast<double>(parts) / partsPerSigma;
      logByParts_[parts] = static_cast<float>(model.exponent * model.logProbability(sigmas));
    }
    logUnseen_ = static_cast<float>(model.exponent * std::log(model.maxRangeMass));
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
  float logProbabilityOf(const LevelMix& mix) const {
    if (std::isinf(reading_)) return mix.high() == RangeScale::kNothing ? 0.0F : logUnseen_;
    if (mix.low() == RangeScale::kNothing) return floor_;
    return logByParts_[static_cast<std::size_t>(
        std::min<int>(mix.differenceTo(parts_), static_cast<int>(logByParts_.size()) - 1))];
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
    const bool expects = table_->row(sensor.x, sensor.y) != nullptr;
    return expects ? Weigher::logProbabilityAt(pose) : std::numeric_limits<double>::quiet_NaN();
  }

  void weigh(const SampleView& poses, std::span<float> logProbability) const override {
    DirectionCorners corners(*table_, 0.0F);
    forEachPoseBlock<DirectionCorners::kBlock>(
        poses, mount_, [&](std::size_t first, const SensorPoses& sensor, std::size_t n) {
          corners.start(sensor, n);
          LevelsAround levels;
          for (std::size_t k = 0; k < n; ++k) {
            logProbability[first + k] +=
                corners.around(k, levels) ? logProbabilityOf(mixAround(*table_, corners, k, levels))
                                          : floor_;
          }
        });
  }

  PoseResolution resolution() const override {
    return {.metres = table_->grid().cell, .radians = table_->step()};
  }

  std::shared_ptr<const DirectionTable> table_;
  Pose2 mount_;
  RangeScale scale_;
  SensorModel model_;
  double reading_;      ///< [m]
  std::int16_t parts_;  ///< the reading [parts of a level]
  float floor_;
  float logUnseen_;                      ///< ln p of seeing nothing of a surface in sight
  std::array<float, 512> logByParts_{};  ///< ln p by difference [parts of a level]
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
    const std::optional<double> range = rangeBetween(*table_, scale_, sensor);
    if (!range) return {};
    return {*range};
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
