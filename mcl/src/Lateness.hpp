#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "Lead.hpp"
#include "PoseSearch.hpp"
#include "Recovery.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {

/// By how much the stamps of all readings are late against odometry's: clocks that are apart, a
/// driver that stamps what it has kept for long. A reading that is late by d is one of d before its
/// stamp, so the belief that it weighs is of then, and odometry carries it on to now.
///
/// Delays of 0 to 3 s compete, while readings fit badly or one of them is ahead:
/// - From reading to reading odometry tells another motion for each of them where the robot turns,
///   starts or stops. A few samples of the belief are moved by each, and the next reading weighs
///   them. On a straight way nothing can be known.
/// - At a moment when the delay changes, the place changes with it: the belief's samples moved by
///   the way between the old delay's time and the new one's are followed beside the belief, as
///   rivals are. Readings are taken one after the other, so a delay that has grown leaves a gap.
///
/// What odometry gets wrong speaks for a delay when it begins and against it as much when that
/// delay has passed, so the readings of 3 s, all together, count 8 nats at most, and a delay needs
/// 20: it is seen in three events at least. To have no delay is the rule: 8 bring back that.
/// Not thread-safe.
class ORTUNG_API Lateness {
 public:
  static constexpr double kStep = 0.25;       ///< between delays that are told apart [s]
  static constexpr std::size_t kDelays = 13;  ///< up to 3 s
  using Fit = std::function<double(const SampleSet&)>;
  /// A reading's moment, as the belief met it.
  struct Moment {
    Timestamp stamp = 0;
    double logEvidence = 0.0;  ///< ln p(readings | belief)
    bool isDoubtful = false;   ///< the belief did not fit
    Pose2 pose;                ///< its mean, now that they have weighed it
    std::uint64_t stream = 0;  ///< of random numbers
  };
  /// Another delay is in force from now on.
  struct Change {
    /// Take the belief's place. Nothing: it stays, though it is of another time.
    std::optional<SampleSet> samples;
  };

  /// All borrowed.
  Lateness(const MclConfig& config, const MotionModel& motion) : config_(config), motion_(motion) {}

  /// The delay in force [s].
  double seconds() const { return secondsOf(inForce_); }
  /// Whether a delay is in force, or one is far ahead.
  bool isSuspected() const;
  /// Of the delay that is most ahead of the one in force, or 0 [nats].
  double lead() const;
  /// What stands in odometry for where the robot was at a reading with this stamp.
  std::optional<Pose2> odometryAt(Timestamp stamp) const { return odometryAt(stamp, inForce_); }
  void forget();
  /// Of another belief: the delay stays, for that is of the devices.
  void forgetBelief();
  /// Takes the belief that a reading has weighed. @param weights sum 1
  void keep(const SampleSet& belief, std::span<const double> weights, const Pose2& pose,
            Timestamp stamp);
  /// @param recovery, weigh, fit of the moment's readings
  std::optional<Change> follow(const Moment& moment, const Recovery& recovery,
                               const PoseSearch::Weigh& weigh, const Fit& fit);

 private:
  /// What readings say for one delay, against the one in force.
  struct Case {
    double nats = 0.0;
    double ofEvent = 0.0;  ///< of them, in the last seconds
    double sharp = 0.0;    ///< nearly unbounded: tells delays apart that are all far ahead
  };
  /// Samples that follow another delay since it may have begun.
  struct Jump {
    std::size_t delay;
    SampleSet samples;
    Pose2 odometry;
    Lead lead = {};
    double sharp = 0.0;
  };
  struct Anchor {
    Timestamp stamp;
    Pose2 pose;
    SampleSet samples;
    std::array<Pose2, kDelays> odometry;  ///< then, by delay
    bool isDoubtful;                      ///< one since then was
  };
  static double secondsOf(std::size_t delay) { return kStep * static_cast<double>(delay); }
  std::optional<Pose2> odometryAt(Timestamp stamp, std::size_t delay) const;
  bool isOpen() const;
  SampleSet moved(const SampleSet& from, const Pose2& change, const Moment& moment) const;
  void compare(const Moment& moment, const Recovery& recovery, const PoseSearch::Weigh& weigh,
               const Fit& fit);
  void count(std::size_t delay, double ratio, double part);
  void begin(const Moment& moment, double gap, const PoseSearch::Weigh& weigh);
  void goOn(const Moment& moment, const Recovery& recovery, const PoseSearch::Weigh& weigh,
            const Fit& fit);
  bool weighJump(Jump& jump, const Moment& moment, const PoseSearch::Weigh& weigh, double part,
                 const Recovery* recovery, const Fit* fit) const;
  std::optional<Change> decide();
  void change(std::size_t delay);

  const MclConfig& config_;
  const MotionModel& motion_;
  std::size_t inForce_ = 0;
  std::array<Case, kDelays> cases_{};
  Timestamp eventSince_ = 0;
  std::optional<Timestamp> before_;  ///< of the last reading
  double usualGap_ = 0.0;            ///< between readings [s]
  std::optional<Anchor> anchor_;
  std::vector<Jump> jumps_;
};

}  // namespace ortung
