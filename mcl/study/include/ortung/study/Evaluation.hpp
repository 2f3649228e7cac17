#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung {

/// One update of MCL, for evaluation.
struct EvaluationStep {
  PoseEstimate estimate;
  /// Longest computing time of an update since the step before [ms].
  double updateMilliseconds = 0.0;
  double spentMilliseconds = 0.0;  ///< total computing time since the step before [ms]
};

/// An estimate with the truth at its time.
struct EvaluationPoint {
  Timestamp stamp = 0;          ///< time of both poses [us]
  Pose2 truth;                  ///< true pose, field frame
  Pose2 estimate;               ///< estimated pose, field frame
  double positionError = 0.0;   ///< distance from the truth [m]
  double headingError = 0.0;    ///< difference of headings [rad], in [0, pi]
  std::size_t samples = 0;      ///< number of samples
  PoseCovariance covariance{};  ///< covariance of the filter's PoseEstimate
  /// Whether there is a gap longer than Options::longestGap since the point before: a drawn line
  /// breaks here. False at the first point.
  bool followsGap = false;
  double quality = 0.0;  ///< quality of the filter's PoseEstimate
  TrackStatus status = TrackStatus::kLost;
  PoseDistance protection;  ///< protection level of the filter's PoseEstimate
};

/// Errors of some estimates; NaN where there are none.
struct EvaluationErrors {
  std::size_t compared = 0;  ///< number of estimates with a known truth, also before convergence
  double positionRmse = std::numeric_limits<double>::quiet_NaN();    ///< [m]
  double positionMedian = std::numeric_limits<double>::quiet_NaN();  ///< [m]
  double positionP95 = std::numeric_limits<double>::quiet_NaN();     ///< [m]
  double positionP99 = std::numeric_limits<double>::quiet_NaN();     ///< [m]
  double positionMax = std::numeric_limits<double>::quiet_NaN();     ///< [m]
  double headingRmse = std::numeric_limits<double>::quiet_NaN();     ///< [rad]
  /// Share of estimates with an error above 1 m.
  double lostShare = std::numeric_limits<double>::quiet_NaN();
  /// Normalized estimation error squared; 3 if consistent.
  double neesMean = std::numeric_limits<double>::quiet_NaN();
  /// Share of estimates with a squared error above 16.27: 0.1 % if consistent (chi-square, 3
  /// degrees).
  double neesAboveShare = std::numeric_limits<double>::quiet_NaN();
};

/// The figures of one run. Errors are those after convergence.
struct EvaluationResult {
  std::string source;
  std::size_t steps = 0;                 ///< updates
  double duration = 0.0;                 ///< duration of the run [s]
  double particlesMean = 0.0;            ///< mean number of samples
  std::optional<double> convergedAfter;  ///< time from the first reading until convergence [s]
  double convergedDistance =
      std::numeric_limits<double>::quiet_NaN();  ///< distance travelled until convergence [m]
  /// Errors over time: at regular intervals, whether or not the filter had weighed a reading then.
  /// These are the errors of a program that uses the pose at any time.
  EvaluationErrors overTime;
  /// Errors at the times of updates only, when the filter has just weighed readings. They are
  /// smaller, as they leave out all times without readings.
  EvaluationErrors atCorrections;
  double period = 0.1;  ///< interval of overTime [s]
  /// Share of estimates over time with the status "tracking", also before convergence; NaN if
  /// nothing was compared.
  double trackingShare = std::numeric_limits<double>::quiet_NaN();
  /// Share of estimates over time with the status "tracking" but an error above 1 m, which should
  /// not happen.
  double wrongWhileTrackingShare = std::numeric_limits<double>::quiet_NaN();
  /// Share of estimates over time with the status "tracking" whose error in position or heading is
  /// beyond the protection level: at most 0.001 is promised.
  double beyondProtectionShare = std::numeric_limits<double>::quiet_NaN();
  /// The same of the status "uncertain": at most 0.01 is promised.
  double beyondProtectionUncertainShare = std::numeric_limits<double>::quiet_NaN();
  /// Median protection level of positions with the status "tracking" [m].
  double protectionMedian = std::numeric_limits<double>::quiet_NaN();
  /// That by the median position error with the status "tracking".
  double protectionRatio = std::numeric_limits<double>::quiet_NaN();
  double updateMsP50 = 0.0;             ///< median computing time of an update [ms]
  double updateMsP99 = 0.0;             ///< 99 % quantile of that time [ms]
  double updateMsMax = 0.0;             ///< longest of these times [ms]
  double realtimeFactor = 0.0;          ///< duration / time spent in updates
  std::vector<EvaluationPoint> points;  ///< all points over time that were compared
};

/// Compares estimates with ground truth, which is interpolated between its samples.
///
/// The caller calls due() before the filter weighs the next time step of a log, and adds the
/// estimates at the times that it returns by addMoment(), so that errors are over time. Results of
/// updates are added by addStep(). Not thread-safe.
class ORTUNG_API Evaluation {
 public:
  struct Options {
    double convergedMetres = 0.5;  ///< greatest position error of a converged estimate [m]
    double convergedRadians = 0.2617993877991494;  ///< greatest error in heading [rad], 15 degrees
    double convergedSeconds = 5.0;                 ///< time for which errors must stay below [s]
    double lostMetres = 1.0;  ///< position error from which on the robot is lost [m]
    double longestGap = 1.0;  ///< longest gap over which truth is interpolated [s]
    double period = 0.1;      ///< time between the moments at which estimates are compared [s]
  };
  Evaluation() : Evaluation(Options()) {}
  /// @throws std::invalid_argument if the period is not at least 1 ms
  explicit Evaluation(const Options& options);
  ~Evaluation();

  /// Returns the times at which the filter's estimate is wanted before it takes the time step @p
  /// stamp: multiples of the period since the first one. There are none within gaps of the log in
  /// which the truth can't be known. Stamps must not decrease.
  /// @param hasTruth whether the time step has ground truth: if it is the first one after a gap,
  /// its
  ///   own time is due in the next call, too, so that logs with rare truth are compared where
  ///   possible
  std::vector<Timestamp> due(Timestamp stamp, bool hasTruth = false);

  void addTruth(Timestamp stamp,
                const Pose2& pose);          ///< adds a true pose; stamps must not decrease
  void addStep(const EvaluationStep& step);  ///< adds an update; stamps must not decrease
  /// Adds an estimate at a time that was due; stamps must not decrease.
  void addMoment(const PoseEstimate& estimate);
  void addTime(Timestamp stamp);  ///< adds the time of any reading, for the run's duration

  /// Returns the estimates over time so far with the truth, as far as it is known so far.
  std::vector<EvaluationPoint> points() const { return compare(moments_); }
  /// Returns the figures of the run. @param source name of the source, for the result
  EvaluationResult result(const std::string& source) const;

 private:
  std::vector<EvaluationPoint> compare(const std::vector<PoseEstimate>& estimates) const;

  Options options_;
  std::vector<std::pair<Timestamp, Pose2>> truth_;
  std::vector<EvaluationStep> steps_;
  std::vector<PoseEstimate> moments_;
  std::optional<Timestamp> firstDue_;
  std::int64_t nextDue_ = 0;  ///< next time that is due, in periods since firstDue_
  Timestamp lastDue_ = 0;     ///< stamp of the newest moment that due() was called for
  /// Time lastDue_, if that moment was the first one with truth after a gap.
  std::optional<Timestamp> rareTruth_;
  std::optional<Timestamp> first_;
  Timestamp last_ = 0;
};

/// Returns the truth at a time, by interpolation over at most @p longestGap [s], or nothing where
/// it is not known.
ORTUNG_API std::optional<Pose2> interpolate(const std::vector<std::pair<Timestamp, Pose2>>& truth,
                                            Timestamp stamp, double longestGap);

}  // namespace ortung
