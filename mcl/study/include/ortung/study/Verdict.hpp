#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/study/Evaluation.hpp"

namespace ortung {

/// When an estimate counts as right.
struct RightRule {
  double metres = 0.5;                  ///< greatest error in position [m]
  double radians = 0.2617993877991494;  ///< greatest error in heading [rad], 15 degrees
  double seconds = 5.0;                 ///< least time for which both errors stay below [s]
  /// Longest distance travelled before that [m].
  double mostTravelled = std::numeric_limits<double>::infinity();
};

/// Whether and when an estimate became right.
struct Verdict {
  enum class State : std::uint8_t {
    kOpen,   ///< it may still become right
    kRight,  ///< it is right since `stamp`
    kWrong   ///< it did not become right within RightRule::mostTravelled
  };
  State state = State::kOpen;
  Timestamp stamp = 0;     ///< time of the first point that was right [us]
  double seconds = 0.0;    ///< time until then since the beginning of the judged interval [s]
  double travelled = 0.0;  ///< distance travelled until then [m]
};

/// Judges the points with stamps in [since, until), in the order of time.
ORTUNG_API Verdict judge(std::span<const EvaluationPoint> points, Timestamp since, Timestamp until,
                         const RightRule& rule);

/// Measures how far a robot went, in pieces of 5 cm, so that noise of the poses does not count.
class ORTUNG_API DistanceMeter {
 public:
  /// Adds the next pose. @returns the distance travelled so far [m]
  double add(const Pose2& pose);

 private:
  bool isBegun_ = false;
  Pose2 anchor_;
  double travelled_ = 0.0;
};

}  // namespace ortung
