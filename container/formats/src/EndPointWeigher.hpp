#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "FramedLevels.hpp"
#include "ScanTrace.hpp"
#include "SurfaceFit.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/BlurrableWeigher.hpp"
#include "ortung/core/Polishable.hpp"
#include "ortung/core/Traceable.hpp"
#include "ortung/tables/EndPointField.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

/// An end-point field with all that weighing points against it needs, whatever the reading.
struct EndPointTables {
  using LogByLevel = std::array<float, 256>;
  FieldGrid region;     ///< cells in which the sensor may be
  EndPointField field;  ///< distances to the places where points should lie
  /// The same, finer than cells; empty: nobody learned it.
  std::shared_ptr<const SurfaceField> surfaces = std::make_shared<SurfaceField>();
  double maxRange = 1.0;  ///< greatest range of points [m]; their sigma grows with range
  float floor = 0.0F;     ///< ln p of a point that fits nowhere

  /// Computes ln p by distance, once the field is complete.
  void complete(const SensorModel& model, double greatestRange);
  /// ln p by level of the field, of points at a range [m].
  const float* logByLevel(double range) const;
  /// The field's levels, for loops over points; once it is complete.
  const FramedLevels& framed() const { return framed_; }
  const SensorModel& model() const { return model_; }
  /// Standard deviation of where points at a range [m] are [m].
  double sigmaAt(double range) const;
  /// The same of points with noise of @p sigma [m], so many times as much.
  LogByLevel logByLevelOf(double sigma, double times) const;

 private:
  static constexpr std::size_t kRangeClasses = 8;
  SensorModel model_;
  FramedLevels framed_;
  std::array<LogByLevel, kRangeClasses> logByLevel_{};
};

/// Weighs samples by points that should lie where an end-point field was marked: ends of a scan's
/// beams, points on lines.
class EndPointWeigher final : public BlurrableWeigher, public Polishable, public Traceable {
 public:
  /// @param mount of the sensor that sees the points
  EndPointWeigher(std::shared_ptr<const EndPointTables> tables, const Pose2& mount);
  void add(double range, double bearing);
  bool isEmpty() const { return endX_.empty(); }
  /// Sets the reading's beams as they lie in the field, if points end beams.
  void setTrace(ScanTrace trace) { trace_.emplace(std::move(trace)); }

  /// Points are rounded to cells of the field: of headings, that is a cell's width seen from as far
  /// as they are. Positions are told no better than by other tables, since what was marked is as
  /// coarse as they are.
  PoseResolution resolution() const override;
  /// Points far from the robot, which a turn moves far, say little; of many, every n-th one stays.
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
  /// The floor for each point where the sensor is outside of the region.
  void weigh(const SampleView& poses, std::span<float> logProbability) const override;
  double logProbabilityAt(const Pose2& pose) const override;

  std::shared_ptr<const EndPointTables> tables_;
  Pose2 mount_;
  // In the robot frame.
  std::vector<float> endX_;           ///< [m]
  std::vector<float> endY_;           ///< [m]
  std::vector<const float*> endLog_;  ///< ln p by level, for its range
  std::vector<float> ranges_;         ///< ranges from the sensor [m]
  float floor_;                       ///< ln p of a point that fits nowhere
  SurfaceFit fit_;
  std::optional<ScanTrace> trace_;
  /// Of a blurred one, by noise in steps: endLog_ points here.
  std::map<int, EndPointTables::LogByLevel> ownLogs_;
};

}  // namespace ortung
