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

/// By how much the stamps of all readings are late against odometry's: clocks that are apart, a
/// driver that stamps what it has kept for long. A reading that is late by d is one of d before its
/// stamp, so the belief that it weighs is of then, and odometry carries it on to now.
///
/// - How probable each delay is comes from the motion between readings (Delays). The most probable
///   one is in force; what is open is part of every estimate.
/// - At a moment when the delay changes, the place changes with it: the belief's samples moved by
///   the way between the old delay's time and the new one's are followed beside the belief, as
///   rivals are. Readings are taken one after the other, so a delay that has grown leaves a gap.
/// Not thread-safe.
class ORTUNG_API Lateness {
 public:
  /// A reading's moment, as the belief met it.
  struct Moment {
    Timestamp stamp = 0;
    double logEvidence = 0.0;  ///< ln p(readings | belief)
    bool isDoubtful = false;   ///< the belief did not fit
    PoseEstimate estimate;     ///< now that they have weighed it
    std::uint64_t stream = 0;  ///< stream of random numbers
  };
  /// Another delay is in force from now on.
  struct Change {
    /// Take the belief's place. Nothing: it stays, though it is of another time.
    std::optional<SampleSet> samples;
  };

  /// All borrowed.
  Lateness(const MclConfig& config, const MotionModel& motion) : config_(config), motion_(motion) {}

  /// The delay in force [s].
  double seconds() const { return Delays::secondsOf(inForce_); }
  double probability(std::size_t delay) const { return delays_.probability(delay); }
  /// Whether a delay of more than a step is in force, one may have just begun, or the place at @p
  /// stamp would be another one for delays that can't be left out.
  bool isSuspected(Timestamp stamp) const;
  /// Adds what is open of the delay to an estimate for @p stamp, made with the one in force.
  PoseEstimate widened(const PoseEstimate& e, Timestamp stamp) const;
  /// What stands in odometry for where the robot was at a reading with this stamp.
  std::optional<Pose2> odometryAt(Timestamp stamp) const { return odometryAt(stamp, inForce_); }
  /// There is odometry of this time.
  void hear(Timestamp odometry);
  /// Time begins anew.
  void forgetAll();
  /// Of another belief: the delay stays, for that is of the devices.
  void forget();
  /// Takes the belief that a reading has weighed. @param weights sum 1
  /// @param estimate of it
  void keep(const SampleSet& belief, std::span<const double> weights, const PoseEstimate& estimate,
            Timestamp stamp);
  /// @param recovery, evidence of the moment's readings
  std::optional<Change> follow(const Moment& moment, const Recovery& recovery,
                               const Evidence& evidence);

 private:
  /// Another delay, followed since it may have begun.
  struct Jump {
    std::size_t delay;
    Hypothesis hypothesis;
    Pose2 odometry;
    double sharp = 0.0;  ///< its lead as a reading counts that is sharper [nats]
  };
  /// Odometry by delay.
  using Odometry = std::array<std::optional<Pose2>, Delays::kCount>;
  struct Anchor {
    Timestamp stamp;
    PoseEstimate estimate;
    SampleSet samples;
    Odometry odometry;
  };
  /// What belongs to a belief, and is made anew with it.
  struct OfBelief {
    std::optional<Timestamp> before;  ///< stamp of the last reading
    Odometry odometry;                ///< odometry at that time
    double usualGap = 0.0;            ///< usual time between readings [s]
    std::optional<Anchor> anchor;
    std::vector<Jump> jumps;
  };
  std::optional<Pose2> odometryAt(Timestamp stamp, std::size_t delay) const;
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
