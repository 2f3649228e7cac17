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
  double metres = 0.5;                                       ///< error below this ...
  double radians = 0.2617993877991494;                       ///< ... and below this, 15 degrees ...
  double seconds = 5.0;                                      ///< ... for at least so long
  double mostWay = std::numeric_limits<double>::infinity();  ///< begun after no more way [m]
};

/// Whether and when an estimate became right.
struct Verdict {
  enum class State : std::uint8_t {
    kOpen,   ///< it may still become right
    kRight,  ///< since `stamp`
    kWrong   ///< not within RightRule::mostWay
  };
  State state = State::kOpen;
  Timestamp stamp = 0;   ///< of the first point that was right
  double seconds = 0.0;  ///< until then, from where it was looked at on
  double way = 0.0;      ///< that the robot went until then [m]
};

/// Looks at the points with stamps in [since, until), in the order of time.
ORTUNG_API Verdict judge(std::span<const EvaluationPoint> points, Timestamp since, Timestamp until,
                         const RightRule& rule);

/// How far a robot went, in pieces of 5 cm, which leaves out how what measured it trembles.
class ORTUNG_API WayMeter {
 public:
  /// @returns the way so far [m]
  double add(const Pose2& pose);

 private:
  bool isBegun_ = false;
  Pose2 anchor_;
  double way_ = 0.0;
};

}  // namespace ortung
