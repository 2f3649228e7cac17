#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "FieldSearch.hpp"
#include "Hypothesis.hpp"
#include "OdometryTrust.hpp"
#include "PoseSearch.hpp"
#include "Recovery.hpp"
#include "UpdateTime.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {

/// Places that compete with the belief while readings fit it badly. They are followed beside it,
/// and take its place only when they explain several readings on some way better by far: the peaks
/// of one reading's likelihood would compete as if the past said nothing, and carry a robot away
/// that tracks well (people before the scanner, furniture that the map lacks).
///
/// - Around the estimate, drawn from a ring that grows with time: wheels that slip or lie, pushes.
///   Half of them follow odometry, the other half goes anywhere near.
/// - Elsewhere: where a search of the whole field finds that one reading fits, moved by odometry.
///   The search may take several updates.
///
/// Both are drawn from one reading, and weighed by all later ones, as the belief is. A reading
/// speaks for them only where it fits as readings use to fit: in a crowd it fits nowhere.
/// Not thread-safe.
class ORTUNG_API Rivals {
 public:
  /// A reading's moment.
  struct Moment {
    Timestamp stamp = 0;
    Pose2 predicted;           ///< pose at which the belief expects the robot
    double logEvidence = 0.0;  ///< ln p(readings | belief)
    /// Distance travelled since the readings before [m]; a turn of 1 rad counts as 1 m.
    double way = 0.0;
    std::uint64_t stream = 0;  ///< stream of random numbers
    std::optional<Pose2> odometry = {};
    std::vector<std::shared_ptr<const Weigher>> readings = {};
  };
  /// Samples that take this share of the belief from now on.
  struct Takeover {
    SampleSet samples;
    double share;
    bool trustsOdometry;
  };

  /// All borrowed.
  Rivals(const MclConfig& config, const FieldRegion& region, const PoseSearch& search,
         const MotionModel& motion, const UpdateTime& time, Workers& workers)
      : config_(config),
        region_(region),
        search_(search),
        motion_(motion),
        time_(time),
        workers_(workers) {}

  void forget();
  bool isIdle() const { return !doubtSince_ && !elsewhere_ && !searching_; }
  /// Of the one that is ahead of the belief, or 0 [nats].
  double lead() const;
  /// Those to be moved as the belief is, at most two; null: not there.
  std::array<Hypothesis*, 2> hypotheses();
  bool isSearching() const { return searching_ && !searching_->job.isDone(); }
  /// Goes on with a search, though there is no reading.
  void searchOn();
  /// Weighs them. @param recovery, evidence of the same moment @returns the one that leads by far
  std::optional<Takeover> follow(const Moment& moment, const Recovery& recovery,
                                 const Evidence& evidence);

 private:
  struct Around {
    Hypothesis hypothesis;  ///< moved by odometry since the last reading
    SampleSet anchor;       ///< its samples as they were then
    Pose2 centre;
    double open = 0.0;  ///< standard deviation, of metres and radians together
    Timestamp stamp = 0;
    OdometryTrust trust = {};
  };
  struct Elsewhere {
    Hypothesis hypothesis;
    double way = 0.0;
    int readings = 0;
  };
  /// A search of the field, as of the moment of its readings.
  struct Searching {
    FieldSearch job;
    Moment moment;
  };
  std::optional<Takeover> lookAround(const Moment& moment, const Recovery& recovery,
                                     const Evidence& evidence);
  void drawAround(const Moment& moment, const Evidence& evidence);
  double weighAround(const Moment& moment, const Evidence& evidence);
  double wayAround(const Moment& moment);
  std::optional<Takeover> lookElsewhere(const Moment& moment, const Recovery& recovery,
                                        const Evidence& evidence);
  double weighElsewhere(const Moment& moment, const Evidence& evidence);
  void search(const Moment& moment, const Recovery& recovery);
  void drawElsewhere(const Moment& moment);
  SampleSet drawnFrom(const std::vector<PoseSearch::Ring>& rings, const Moment& then) const;
  void carryOn(Hypothesis& found, const Moment& then, const Moment& now) const;

  const MclConfig& config_;
  const FieldRegion& region_;
  const PoseSearch& search_;
  const MotionModel& motion_;
  const UpdateTime& time_;
  Workers& workers_;
  std::optional<Timestamp> doubtSince_;
  std::optional<Around> around_;
  std::optional<Searching> searching_;
  std::optional<Elsewhere> elsewhere_;
};

}  // namespace ortung
