#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/base/SampleView.hpp"
#include "ortung/tables/EndPointField.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

/// Weighs samples by points that should lie where an end-point field was marked: ends of a scan's
/// beams, points on lines.
class EndPointWeigher {
 public:
  /// Computes ln p by distance, and forgets all points.
  /// @param maxRange of the points; their sigma grows with range [m]
  void start(const SensorModel& model, double maxRange, const EndPointField& field);
  /// A point seen by a sensor mounted at @p mount.
  void add(const Pose2& mount, double range, double bearing);

  bool empty() const { return endX_.empty(); }

  /// Adds ln p of all points, or the floor for each where the sensor is outside of @p region.
  void weigh(const FieldGrid& region, const EndPointField& field, const Pose2& mount,
             const SampleView& poses, std::span<float> logProbability) const;

 private:
  static constexpr std::size_t kRangeClasses = 8;  ///< of end points: sigma grows with range
  double maxRange_ = 1.0;                          ///< [m]
  float floor_ = 0.0F;                             ///< ln p of a point that fits nowhere
  // In the robot frame.
  std::vector<float> endX_;           ///< [m]
  std::vector<float> endY_;           ///< [m]
  std::vector<const float*> endLog_;  ///< entry of logByLevel_ for its range
  std::array<std::array<float, 256>, kRangeClasses> logByLevel_{};
};

}  // namespace ortung
