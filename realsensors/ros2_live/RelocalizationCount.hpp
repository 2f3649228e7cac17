#pragma once

#include <cstdint>
#include <optional>

#include "ortung/base/Pose2.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung::ros2 {

/// Counts how often the robot was put elsewhere in the map, so that no step of what is told is
/// without an announcement: what the filter counts as relocalizations, over filters that follow one
/// another, and steps of the transform that it does not count, as when the transform stood still
/// while the robot was lost. Not thread-safe.
class RelocalizationCount {
 public:
  /// What is going to be told of a moment.
  struct Placed {
    Pose2 odomInMap;
    Pose2 robotInOdom;  ///< makes the transform's step that of the robot
  };

  /// Another filter begins, which counts anew.
  void beginFilter() { ofFilter_ = 0; }
  /// Takes what the filter says of a moment, and the transform that will be told, if it will.
  /// @return whether the count has risen
  bool follow(const PoseEstimate& filter, const std::optional<Placed>& placed);

  std::uint32_t count() const { return count_; }
  Relocalization cause() const { return cause_; }  ///< cause of the newest one

 private:
  std::uint32_t ofFilter_ = 0, count_ = 0;
  Relocalization cause_ = Relocalization::kNone;
  std::optional<Pose2> odomInMap_;  ///< what was told last
};

}  // namespace ortung::ros2
