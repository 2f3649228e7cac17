#include "ortung/formats/BearingData.hpp"

#include <limits>

#include "FormatTools.hpp"
#include "TableWeigher.hpp"

namespace ortung {

namespace {

class BearingWeigher final : public Weigher {
 public:
  BearingWeigher(std::shared_ptr<const BearingTable> table,
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
    const double expected = wrapAngle(table_->at(sensor.x, sensor.y) - sensor.theta);
    if (std::isnan(expected)) return std::numeric_limits<double>::quiet_NaN();
    return (*gaussian_)(static_cast<float>(wrapAngle(reading_ - expected) / sigma_));
  }

  void weigh(const SampleView& poses, std::span<float> logProbability) const override {
    const auto reading = static_cast<float>(reading_);
    const auto perSigma = static_cast<float>(1.0 / sigma_);
    TableWeigher weigher(table_->cells().grid());
    forEachPoseBlock<TableWeigher::kBlock>(
        poses, mount_, [&](std::size_t first, const SensorPoses& sensor, std::size_t n) {
          weigher.start(sensor, n);
          weigher.addBearing(*table_, *gaussian_, reading, perSigma, logProbability.data() + first);
        });
  }

  PoseResolution resolution() const override { return {.metres = table_->cells().grid().cell}; }

  std::shared_ptr<const BearingTable> table_;
  std::shared_ptr<const GaussianTable> gaussian_;
  Pose2 mount_;
  double reading_;  ///< [rad]
  double sigma_;    ///< [rad]
};

}  // namespace

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

std::vector<double> BearingData::expectation(const Pose2& pose) const {
  const Pose2 sensor = pose * mount();
  return {wrapAngle(table_->at(sensor.x, sensor.y) - sensor.theta)};
}

std::shared_ptr<const Weigher> BearingData::makeWeigher() const {
  if (!reading_) return nullptr;
  return std::make_shared<BearingWeigher>(table_, gaussian_, mount(), *reading_,
                                          config_.model.sigma);
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
