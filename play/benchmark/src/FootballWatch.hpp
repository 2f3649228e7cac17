#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "PoseSums.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/benchmark/FootballHalf.hpp"
#include "ortung/sim/SceneRun.hpp"

namespace ortung {

/// Counts what happens in a half, from the true state. All robots stay until its end.
class ORTUNG_API FootballWatch {
 public:
  /// @param run borrowed @param first name of the first team
  /// @param keepers names of the robots that keep goals
  FootballWatch(SceneRun& run, std::string first, const std::vector<std::string>& keepers);

  /// Compares what players believe with the truth; to be called after they have acted.
  void compare();
  /// Counts a cycle; to be called after everything has moved. @param events those of the cycle
  void look(std::span<const RefereeEvent> events);
  /// Returns the figures so far.
  FootballHalf half() const;

 private:
  /// How long a robot has been at its place.
  struct Stand {
    std::string robot;
    std::size_t team = 0;
    bool isKeeper = false;
    std::optional<Pose2> anchor = std::nullopt;
    Timestamp since = 0;  ///< time at which it came there
    Timestamp idle = 0;   ///< time since which it is there and the nearest to the ball
    bool isIdle = false;
    bool touches = false;
  };
  /// The last touch of the ball.
  struct Touch {
    std::string robot;
    std::size_t team = 0;
    Pose2 ball;
  };

  void forget();
  void take(const RefereeEvent& event);
  bool lookAtTouches(const Simulation::Thing& ball);
  void touched(const Stand& stand, const Pose2& ball);
  void lookAtStands(const Pose2& ball);
  void countStand(Stand& stand, const Pose2& at, bool isNearest);
  std::size_t teamOf(const std::string& name) const { return name == first_ ? 0 : 1; }
  Timestamp now() const { return run_.simulation().now(); }

  SceneRun& run_;
  std::string first_;
  std::vector<Stand> stands_;  ///< stands of the robots in the simulation's order
  FootballHalf half_;
  std::array<PoseErrors, 2> errors_;
  std::optional<Touch> last_;
  std::array<std::optional<Timestamp>, 2> lastOf_;  ///< last touch of each team
  std::optional<Timestamp> aloneSince_;             ///< time since which nobody goes for it
  bool wasPlaying_ = false;
};

}  // namespace ortung
