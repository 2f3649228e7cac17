#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ScanCost.hpp"
#include "ScanTrace.hpp"
#include "SurfaceFit.hpp"
#include "ortung/core/BlurrableWeigher.hpp"
#include "ortung/core/Polishable.hpp"
#include "ortung/core/Traceable.hpp"
#include "ortung/tables/DirectionTable.hpp"
#include "ortung/tables/RangeScale.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

/// A scan in the terms of a ray table: for each direction of the run the nearest beam. Expectations
/// are interpolated between the table's cells and directions, unless the poses are spread anyway.
class RayWeigher final : public BlurrableWeigher, public Polishable, public Traceable {
 public:
  /// @param run number of the table's directions that the scan spans
  /// @param spread standard deviations of the poses that each sample stands for
  RayWeigher(std::shared_ptr<const DirectionTable> rays, const Pose2& mount, double firstAngle,
             const SensorModel& model, std::size_t run, SurfaceFit fit,
             const PoseResolution& spread = {});

  /// Adds a beam at place @p at of the run. @param range [m]; +infinity: nothing is in sight
  void add(std::size_t at, double range, const RangeScale& scale);
  /// Is called when all beams are added. @returns whether any of them has information
  bool complete();
  /// Sets the reading's beams as they lie in the field.
  void setTrace(ScanTrace trace) { trace_.emplace(std::move(trace)); }

  std::shared_ptr<const BlurrableWeigher> blurred(const PoseResolution& spread) const override;
  double nominalNanoseconds() const override;
  Slope slopeAt(const Pose2& pose) const override { return fit_.slopeAt(pose); }
  void trace(const Pose2& pose, std::vector<TracedBeam>& beams) const override {
    if (trace_) trace_->trace(pose, beams);
  }
  std::shared_ptr<const Weigher> without(const std::vector<bool>& dropped) const override {
    return trace_ ? trace_->without(dropped) : nullptr;
  }

 private:
  struct Beam {
    std::size_t at;  ///< place in the run
    double range;    ///< [m]
  };
  bool isSpread() const { return spread_.metres > 0.0 || spread_.radians > 0.0; }
  void setSteps(double entries, double least);
  std::uint8_t quantize(double logProbability) const;
  void weigh(const SampleView& poses, std::span<float> logProbability) const override;
  void weighByCells(const SampleView& poses, std::span<float> logProbability) const;
  void weighBetweenCells(const SampleView& poses, std::span<float> logProbability) const;
  double logProbabilityAt(const Pose2& pose) const override;
  PoseResolution resolution() const override {
    return {.metres = rays_->grid().cell, .radians = rays_->step()};
  }

  std::shared_ptr<const DirectionTable> rays_;
  Pose2 mount_;
  float firstAngle_;
  SensorModel model_;
  PoseResolution spread_;  ///< standard deviations of the poses
  RangeScale scale_;
  std::vector<Beam> beams_;
  std::size_t run_;  ///< directions that the scan spans
  double unit_;      ///< nats of a cost of 1
  float nats_;       ///< ln p of a cost of 1, exponent included (negative)
  /// Levels of the reading, by direction from the first beam on, padded. Between cells they are
  /// zero, as rows hold differences from the reading then.
  std::vector<std::uint8_t> levels_;
  std::vector<std::int16_t> parts_;  ///< the reading [parts of a level], for use between cells
  std::vector<std::uint8_t> caps_;
  std::vector<std::uint8_t> steps_;  ///< none: all of 1
  int shift_ = 0;
  std::array<std::uint8_t, kLevelDifferences> costs_{};
  std::uint8_t farCost_;  ///< greatest cost of a beam that met nothing
  SurfaceFit fit_;
  std::optional<ScanTrace> trace_;
  std::uint32_t floorCost_ = 0;  ///< cost of a sample without expectation
  /// Levels, or parts of a level, per sigma, by direction; zero: no beam.
  std::vector<double> levelsPerSigma_;
};

}  // namespace ortung
