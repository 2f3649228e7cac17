#pragma once

#include <optional>
#include <string>

#include "LiveFloors.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/run/Localization.hpp"

namespace ortung::ros2 {

/// Brings a belief to the floor that somebody has named, who knows it. Not thread-safe.
class FloorSeeker {
 public:
  /// @param floors where the robot's floor is kept, which outlive this
  explicit FloorSeeker(LiveFloors& floors) : floors_(floors) {}

  /// Goes on on a floor: in the likeliest place there or, if the belief has none, at the same place
  /// as on the floor where it is. If the robot is lost, or can't stand there, it is searched for.
  /// @param odometry newest one that was taken; nothing: it has not begun yet
  /// @param start where it begins
  void goTo(const std::string& floor, Localization& localization,
            const std::optional<Message>& odometry, const LocalizationStart& start);
  /// Once there is an estimate, takes the likeliest place on a floor that was named before or, if
  /// the belief has none there, the same place as on the floor where it is.
  void onEstimate(Localization& localization);
  /// Names a floor of another building, where the robot has yet to be found; "": none.
  void seek(const std::string& floor) { sought_ = floor; }

 private:
  LiveFloors& floors_;  ///< borrowed
  std::string sought_;  ///< floor that was named, until a search has ended
};

}  // namespace ortung::ros2
