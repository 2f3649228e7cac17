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
#include "Sightings.hpp"
#include "UpdateTime.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {

/// Alternative hypotheses of the place, tracked beside the belief while readings fit it badly. They
/// take over only once they explain several readings over some distance travelled far better than
/// the belief. To add samples at the peaks of a single reading's likelihood, as sensor resetting
/// does, would ignore the past and lose a robot that is tracked well (people in front of the
/// scanner, furniture that is not in the map).
///
/// - Around the estimate, drawn from a ring that grows with time: for wheels that slip, wrong
///   odometry, and pushes. Half of the samples follow odometry, the other half spreads by process
///   noise.
/// - Elsewhere, drawn around the places where a search of the whole field finds that one time
///   step's readings fit, and moved by odometry. The search may take several updates. It tells how
///   many places explain the readings about as well, and so how much they may count.
///
/// Both are drawn by one time step's readings, and weighed by all later ones, as the belief is. A
/// reading counts in their favour only if it fits as well as usual: in a crowd it fits nowhere. Not
/// thread-safe.
class ORTUNG_API Rivals {
 public:
  /// A time step's readings, and what the belief predicts.
  struct Moment {
    Timestamp stamp = 0;
    Pose2 predicted;           ///< pose at which the belief expects the robot
    double logEvidence = 0.0;  ///< ln p(readings | belief)
    double fit = 0.0;          ///< how well they fit the belief, once they have weighed it
    /// Distance travelled since the readings before [m]; a turn of 1 rad counts as 1 m.
    double travelled = 0.0;
    std::uint64_t stream = 0;  ///< stream of random numbers
    std::optional<Pose2> odometry = {};
    std::vector<std::shared_ptr<const Weigher>> readings = {};
  };
  /// What a hypothesis that has explained the readings says of odometry.
  enum class Odometry {
    kRight,    ///< it leads from one reading to the next
    kWrong,    ///< it does not lead where the robot is
    kUnheard,  ///< nothing: the robot was somewhere else all the time
  };
  /// Samples that take this share of the belief.
  struct Takeover {
    SampleSet samples;
    double share;
    Odometry odometry;
    bool isConfirmed = true;  ///< whether as many readings support it as confirm a place
  };

  /// All arguments are borrowed.
  Rivals(const MclConfig& config, const FieldRegion& region, const PoseSearch& search,
         const MotionModel& motion, UpdateTime& time, Workers& workers)
      : config_(config),
        region_(region),
        search_(search),
        motion_(motion),
        time_(time),
        workers_(workers) {}

  void forget();
  bool isIdle() const { return !doubtSince_ && !elsewhere_ && !searching_; }
  /// Returns the greatest lead of a hypothesis over the belief, at least 0 [nats].
  double lead() const;
  /// Returns the hypotheses that are to be moved as the belief is, at most two; null: there is
  /// none.
  std::array<Hypothesis*, 2> hypotheses();
  bool isSearching() const { return searching_ && !searching_->job.isDone(); }
  /// Continues a search without new readings.
  void searchOn();
  /// Weighs the hypotheses. @param recovery, evidence of the same readings @returns the one that
  /// takes over, if any
  std::optional<Takeover> follow(const Moment& moment, const Recovery& recovery,
                                 const Evidence& evidence);

 private:
  struct Around {
    Hypothesis hypothesis;  ///< samples, moved by odometry since the last reading
    SampleSet anchor;       ///< its samples as they were then
    Pose2 centre;
    double open = 0.0;  ///< standard deviation of metres and radians together
    Timestamp stamp = 0;
    OdometryTrust trust = {};
    double waited = 0.0;  ///< travelled since readings counted [m]
  };
  struct Elsewhere {
    Hypothesis hypothesis;
    /// Whether the search's readings count, too, since hardly any other place explains them, or
    /// two searches have found it.
    bool isDistinct = false;
    double travelled = 0.0;
    double waited = 0.0;  ///< travelled since readings counted [m]
    int readings = 0;
    Lead before = Lead();  ///< its lead before the newest readings counted
    bool isConfirmed() const;
  };
  /// A search of the field, for the time of its readings.
  struct Searching {
    FieldSearch job;
    Moment moment;
    Lead before;  ///< lead of the place elsewhere before its readings counted
  };
  /// What a search says for the place that it has found.
  struct Finding {
    Lead lead = Lead();
    bool isDistinct = false;
  };
  std::optional<Takeover> lookAround(const Moment& moment, const Recovery& recovery,
                                     const Evidence& evidence);
  void drawAround(const Moment& moment, const Evidence& evidence);
  double weighAround(const Moment& moment, const Evidence& evidence);
  /// Returns how long the readings take for so many poses.
  double timeOf(double poses, const Moment& moment) const;
  /// Returns the share of so many poses that there is time for, at least @p least and at most 1.
  double shareInTime(double poses, double least, const Moment& moment) const;
  double travelledAround();
  std::optional<Takeover> lookElsewhere(const Moment& moment, const Recovery& recovery,
                                        const Evidence& evidence);
  std::optional<Takeover> followElsewhere(const Moment& moment, const Recovery& recovery,
                                          const Evidence& evidence);
  std::optional<Takeover> takeOver(const Moment& moment);
  double weighElsewhere(const Moment& moment, const Evidence& evidence);
  bool mayFindBetter() const;
  void search(const Moment& moment, const Recovery& recovery);
  Finding judge(const Searching& done, const Recovery& recovery);
  void drawElsewhere(const Moment& moment, const Recovery& recovery);
  void drawIfDone(const Moment& moment, const Recovery& recovery);
  SampleSet drawnFrom(const std::vector<PoseSearch::Ring>& rings, const Moment& then) const;
  void carryOn(Hypothesis& drawn, const Moment& then, const Moment& now) const;

  const MclConfig& config_;
  const FieldRegion& region_;
  const PoseSearch& search_;
  const MotionModel& motion_;
  UpdateTime& time_;
  Workers& workers_;
  std::optional<Timestamp> doubtSince_;
  std::optional<Around> around_;
  std::optional<Searching> searching_;
  double travelledSinceSearch_ = 0.0;  ///< [m]
  /// Searches since doubts began that found no place where their readings fit.
  int inVain_ = 0;
  Sightings sightings_;
  std::optional<Elsewhere> elsewhere_;
};

}  // namespace ortung
