#include "ortung/formats/ScalarData.hpp"

#include <limits>

#include "FormatTools.hpp"
#include "TableWeigher.hpp"

namespace ortung {

namespace {

/// Sigma is that at the reading's range, not the expectation's: the same for all samples.
class ScalarWeigher final : public Weigher {
 public:
  ScalarWeigher(std::shared_ptr<const PositionTable> table,
                std::shared_ptr<const GaussianTable> gaussian, const Pose2& mount, double reading,
                double sigma)
      : table_(std::move(table)),
        gaussian_(std::move(gaussian)),
        mount_(mount),
        reading_(reading),
        sigma_(sigma) {}

 private:
  double logProbabilityAt(const Pose2& pose) const override {
    const Pose2 sensor = pose * mount_;
    const float expected = table_->at(sensor.x, sensor.y);
    if (std::isnan(expected)) return std::numeric_limits<double>::quiet_NaN();
    return (*gaussian_)(static_cast<float>((reading_ - expected) / sigma_));
  }

  void weigh(const SampleView& poses, std::span<float> logProbability) const override {
    const auto reading = static_cast<float>(reading_);
    const auto perSigma = static_cast<float>(1.0 / sigma_);
    TableWeigher weigher(table_->cells().grid());
    forEachPoseBlock<TableWeigher::kBlock>(
        poses, mount_, [&](std::size_t first, const SensorPoses& sensor, std::size_t n) {
          weigher.start(sensor, n);
          weigher.addDistance(*table_, *gaussian_, reading, perSigma,
                              logProbability.data() + first);
        });
  }

  PoseResolution resolution() const override { return {.metres = table_->cells().grid().cell}; }

  std::shared_ptr<const PositionTable> table_;
  std::shared_ptr<const GaussianTable> gaussian_;
  Pose2 mount_;
  double reading_;  ///< [m]
  double sigma_;    ///< [m]
};

}  // namespace

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

std::vector<double> ScalarData::expectation(const Pose2& pose) const {
  const Pose2 sensor = pose * mount();
  return {table_->at(sensor.x, sensor.y)};
}

std::shared_ptr<const Weigher> ScalarData::makeWeigher() const {
  if (!reading_) return nullptr;
  return std::make_shared<ScalarWeigher>(table_, gaussian_, mount(), *reading_,
                                         config_.model.sigmaAt(*reading_));
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
