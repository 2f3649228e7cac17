#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung {

/// Follows the steps of an estimate: how far an update moves the pose of one and the same moment.
/// Small ones are corrections, which the smooth pose takes up over time: what is left of them falls
/// exponentially. Large ones are relocalizations, which are counted. Not thread-safe.
class ORTUNG_API Steps {
 public:
  /// An update begins. @param pose the pose that was told for its time until now
  void expect(const Pose2& pose) { expected_ = pose; }
  /// Says why the pose may move in this update. The first one that is said counts.
  void because(Relocalization cause) {
    if (cause_ == Relocalization::kNone) cause_ = cause;
  }
  /// An update ends. @param pose the pose that it tells for its time @p stamp
  void follow(const Pose2& pose, Timestamp stamp);
  /// Another belief begins: there is nothing to blend.
  void begin(Relocalization cause);
  /// Adds the smooth pose and the relocalizations to an estimate, whose pose and time are set.
  void apply(PoseEstimate& estimate) const;

 private:
  Pose2 offsetAt(Timestamp stamp) const;

  std::optional<Pose2> expected_;
  Relocalization cause_ = Relocalization::kNone;
  Pose2 offset_;         ///< the smooth pose from the exact one, at time since_
  Timestamp since_ = 0;  ///< time of the newest step
  std::uint32_t count_ = 0;
  Relocalization newest_ = Relocalization::kNone;
};

}  // namespace ortung
