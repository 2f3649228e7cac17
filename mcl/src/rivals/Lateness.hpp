#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "Delays.hpp"
#include "Hypothesis.hpp"
#include "Recovery.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {

/// Estimates the delay of all readings' stamps against odometry's. Its cause is clocks that are not
/// synchronized, or a driver that stamps readings only after buffering them. A reading with delay d
/// was taken d before its stamp, so it weighs the belief of that time, and odometry predicts the
/// present estimate from there.
///
/// - The probability of each delay follows from the motion between readings (Delays). The most
///   probable one is in force; the uncertainty of the delay is part of every estimate.
/// - When the delay changes, the pose at the readings changes with it: the belief's samples, moved
///   by odometry from the old delay's time to the new one's, are tracked as hypotheses beside the
///   belief. Readings are taken in order, so a delay that has grown leaves a gap between them.
///
/// Not thread-safe.
class ORTUNG_API Lateness {
 public:
  /// A time step's readings, and how they fit the belief.
  struct Moment {
    Timestamp stamp = 0;
    double logEvidence = 0.0;  ///< ln p(readings | belief)
    bool isDoubtful = false;   ///< whether the belief does not fit them
    PoseEstimate estimate;     ///< estimate after they were weighed
    std::uint64_t stream = 0;  ///< stream of random numbers
    IsOver isOver = {};        ///< hastens annealing
  };
  /// A change of the delay in force.
  struct Change {
    /// Samples that replace the belief. Nothing: the belief stays, though it is for another time.
    std::optional<SampleSet> samples;
  };

  /// All arguments are borrowed.
  Lateness(const MclConfig& config, const MotionModel& motion) : config_(config), motion_(motion) {}

  /// Returns the delay in force [s].
  double seconds() const { return Delays::secondsOf(inForce_); }
  double probability(std::size_t delay) const { return delays_.probability(delay); }
  /// Whether readings are late.
  enum class Suspicion : std::uint8_t {
    kNone,
    /// Delays for which the pose would be another one are too probable to be left out, but nothing
    /// says that there is one.
    kPossible,
    /// A delay of more than one step is in force, a change of the delay is probable, or delays for
    /// which the pose would be another one are more probable than before anything is known.
    kTold,
  };
  Suspicion suspicion(Timestamp stamp) const;
  /// Adds the uncertainty of the delay to an estimate for @p stamp that was made with the one in
  /// force.
  PoseEstimate widened(const PoseEstimate& e, Timestamp stamp) const;
  /// Returns odometry's pose at the time when a reading with this stamp was taken.
  std::optional<Pose2> odometryAt(Timestamp stamp) const { return odometryAt(stamp, inForce_); }
  /// Records that there is odometry of this time.
  void hear(Timestamp odometry);
  /// Forgets everything, as the clock was set or the log began anew.
  void forgetAll();
  /// Forgets what belongs to the belief. The delay stays, since it belongs to the devices.
  void forget();
  /// Takes the belief after it was weighed. @param weights weights with sum 1
  /// @param estimate estimate of the belief
  void keep(const SampleSet& belief, std::span<const double> weights, const PoseEstimate& estimate,
            Timestamp stamp);
  /// Returns the greatest number of poses that follow() weighs, unless there is time for more.
  std::size_t posesFor(const Moment& moment) const;
  /// Follows the delay by one time step's readings. @returns the change of the delay in force, if
  ///   any
  /// @param recovery, evidence of the same readings
  std::optional<Change> follow(const Moment& moment, const Recovery& recovery,
                               const Evidence& evidence);

 private:
  /// The hypothesis that another delay has begun.
  struct Jump {
    std::size_t delay;
    Hypothesis hypothesis;
    Pose2 odometry;
    double sharp = 0.0;  ///< its lead with a higher bound per reading [nats]
  };
  /// Odometry's pose for each delay.
  using Odometry = std::array<std::optional<Pose2>, Delays::kCount>;
  struct Anchor {
    Timestamp stamp;
    PoseEstimate estimate;
    SampleSet samples;
    Odometry odometry;
  };
  /// What belongs to one belief, and is reset for another one.
  struct OfBelief {
    std::optional<Timestamp> before;  ///< stamp of the last reading
    Odometry odometry;                ///< odometry at that time
    double usualGap = 0.0;            ///< usual time between readings [s]
    std::optional<Anchor> anchor;
    std::vector<Jump> jumps;
  };
  std::optional<Pose2> odometryAt(Timestamp stamp, std::size_t delay) const;
  double gapTo(Timestamp stamp) const;
  bool isLongGap(double gap) const;
  Odometry odometryByDelay(Timestamp stamp) const;
  std::array<Pose2, Delays::kCount> placesAt(Timestamp stamp, const Pose2& inForce) const;
  void move(Hypothesis& hypothesis, const Pose2& change, const Moment& moment) const;
  void compare(const Moment& moment);
  void begin(const Moment& moment, double gap, const Evidence& evidence);
  bool mayBegin(std::size_t delay, double gap) const;
  void goOn(const Moment& moment, const Recovery& recovery, const Evidence& evidence);
  double weigh(Jump& jump, const Moment& moment, const Evidence& evidence) const;
  static void count(Jump& jump, double ratio, double part, bool isUsual);
  const Jump* leading() const;
  Change jumpTo(const Jump& jump);
  std::optional<Change> decide();

  const MclConfig& config_;
  const MotionModel& motion_;
  Delays delays_;
  std::size_t inForce_ = 0;
  std::optional<Timestamp> odometrySince_;
  OfBelief belief_;
};

}  // namespace ortung
