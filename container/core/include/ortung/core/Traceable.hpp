#pragma once

#include <memory>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/Weigher.hpp"

namespace ortung {

/// A beam of a reading, as it lies in the field if the robot is at some pose.
struct TracedBeam {
  double x = 0.0;         ///< where it begins, field frame [m]
  double y = 0.0;         ///< [m]
  double bearing = 0.0;   ///< field frame [rad], not wrapped
  double read = 0.0;      ///< range that was read [m]; infinity: nothing within the sensor's range
  double expected = 0.0;  ///< range by what was learned [m]; infinity: nothing within range
  /// Distance from where the range that was read ends to the nearest surface learned [m]; infinity:
  /// none is near, or the range is infinite.
  double away = 0.0;
  double reach = 0.0;  ///< greatest range that the sensor can tell [m]
  double sigma = 0.0;  ///< standard deviation of a range that was read at `expected` [m]
};

/// A weigher of ranges along thin beams. By them a reading tells where the world is not what was
/// learned: a beam goes on behind a wall that is gone, and ends in front of what is new.
class ORTUNG_API Traceable {
 public:
  virtual ~Traceable();
  /// Appends all valid beams at @p pose, by ascending bearing; none where nothing was learned.
  /// Thread-safe.
  virtual void trace(const Pose2& pose, std::vector<TracedBeam>& beams) const = 0;
  /// Returns a weigher of the same reading without some beams; null if too little would be left to
  /// weigh.
  /// @param dropped whether each beam is left out, in the order of trace()
  virtual std::shared_ptr<const Weigher> without(const std::vector<bool>& dropped) const = 0;

 protected:
  Traceable() = default;
  Traceable(const Traceable&) = default;
  Traceable& operator=(const Traceable&) = default;
};

}  // namespace ortung
