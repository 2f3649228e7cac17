#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "TableSlope.hpp"
#include "TableWeigher.hpp"
#include "ortung/core/Polishable.hpp"
#include "ortung/core/Weigher.hpp"

namespace ortung {

/// Weighs samples by one table over the position: a PositionTable or a BearingTable. Sigma is that
/// at the reading, not at the expectation: the same for all samples.
template <class Table>
class CellWeigher final : public Weigher, public Polishable, public Correctable {
 public:
  CellWeigher(std::shared_ptr<const Table> table, std::shared_ptr<const GaussianTable> gaussian,
              const SensorModel& model, const Pose2& mount, double reading, double sigma)
      : table_(std::move(table)),
        gaussian_(std::move(gaussian)),
        model_(model),
        mount_(mount),
        reading_(reading),
        sigma_(sigma) {}

  Slope slopeAt(const Pose2& robot) const override {
    Slope slope;
    addReading(slope, *table_, reading_, sigma_, model_, robot, robot * mount_);
    return slope;
  }

  void residualsAt(const Pose2& robot, std::vector<ReadingResidual>& residuals) const override {
    if (const auto one = residualOf(*table_, reading_, sigma_, model_, robot, robot * mount_))
      residuals.push_back(*one);
  }

  std::shared_ptr<const Weigher> corrected(const DeviceBias& bias) const override {
    const double without = kIsBearing ? bias.bearing(reading_) : bias.distance(reading_);
    return std::make_shared<CellWeigher>(table_, gaussian_, model_, mount_, without, sigma_);
  }

 private:
  static constexpr bool kIsBearing = std::is_same_v<Table, BearingTable>;

  double logProbabilityAt(const Pose2& pose) const override {
    const Pose2 sensor = pose * mount_;
    double residual = table_->at(sensor.x, sensor.y);
    if constexpr (kIsBearing)
      residual = wrapAngle(reading_ - wrapAngle(residual - sensor.theta));
    else
      residual = reading_ - residual;
    if (std::isnan(residual)) return std::numeric_limits<double>::quiet_NaN();
    return (*gaussian_)(static_cast<float>(residual / sigma_));
  }

  void weigh(const SampleView& poses, std::span<float> logProbability) const override {
    const auto reading = static_cast<float>(reading_);
    const auto perSigma = static_cast<float>(1.0 / sigma_);
    TableWeigher weigher(table_->cells().grid());
    forEachPoseBlock<TableWeigher::kBlock>(
        poses, mount_, [&](std::size_t first, const SensorPoses& sensor, std::size_t n) {
          weigher.start(sensor, n, logProbability.data() + first);
          if constexpr (kIsBearing)
            weigher.addBearing(*table_, *gaussian_, reading, perSigma);
          else
            weigher.addDistance(*table_, *gaussian_, reading, perSigma);
          weigher.finish();
        });
  }

  std::shared_ptr<const Table> table_;
  std::shared_ptr<const GaussianTable> gaussian_;
  SensorModel model_;
  Pose2 mount_;
  double reading_;  ///< [m] or [rad]
  double sigma_;    ///< [m] or [rad]
};

}  // namespace ortung
