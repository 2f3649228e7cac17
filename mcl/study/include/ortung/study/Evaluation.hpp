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
  double updateMilliseconds = 0.0;  ///< of the longest one since the step before
  double spentMilliseconds = 0.0;   ///< of all of them
};

/// An estimate beside the truth at its time.
struct EvaluationPoint {
  Timestamp stamp = 0;
  Pose2 truth;
  Pose2 estimate;
  double positionError = 0.0;  ///< [m]
  double headingError = 0.0;   ///< [rad], in [0, pi]
  std::size_t samples = 0;
  PoseCovariance covariance{};  ///< that the filter claims, as of PoseEstimate
  /// Whether nothing is known of the time since the point before it, longer than
  /// Options::longestGap: a drawn line breaks here. Not at the first point.
  bool followsGap = false;
  double quality = 0.0;  ///< that the filter claims, as of PoseEstimate
  TrackStatus status = TrackStatus::kLost;
};

/// Errors of some estimates; NaN where there are none.
struct EvaluationErrors {
  std::size_t compared = 0;  ///< estimates at whose time the truth is known, before convergence too
  double positionRmse = std::numeric_limits<double>::quiet_NaN();    ///< [m]
  double positionMedian = std::numeric_limits<double>::quiet_NaN();  ///< [m]
  double positionP95 = std::numeric_limits<double>::quiet_NaN();     ///< [m]
  double positionP99 = std::numeric_limits<double>::quiet_NaN();     ///< [m]
  double positionMax = std::numeric_limits<double>::quiet_NaN();     ///< [m]
  double headingRmse = std::numeric_limits<double>::quiet_NaN();     ///< [rad]
  double lostShare = std::numeric_limits<double>::quiet_NaN();       ///< with error above 1 m
  /// Normalized estimation error squared; 3 if consistent.
  double neesMean = std::numeric_limits<double>::quiet_NaN();
  /// Share with that above 16.27, which 0.1 % are if it is consistent (chi-square, 3 degrees).
  double neesAboveShare = std::numeric_limits<double>::quiet_NaN();
};

/// The figures of one run. Errors are those after convergence.
struct EvaluationResult {
  std::string source;
  std::size_t steps = 0;  ///< updates
  double duration = 0.0;  ///< of the run [s]
  double particlesMean = 0.0;
  std::optional<double> convergedAfter;  ///< [s] from the first reading
  double convergedWay =
      std::numeric_limits<double>::quiet_NaN();  ///< that the robot went until then [m]
  /// Over the time: at even moments, whether the filter had weighed a reading then or not. This is
  /// what a program gets that wants to know where the robot is.
  EvaluationErrors overTime;
  /// At the times of updates alone, when the filter has just seen something. Smaller, as it leaves
  /// out all times in which the robot saw nothing.
  EvaluationErrors atCorrections;
  double period = 0.1;  ///< between the moments of overTime [s]
  /// Over the time, before convergence, too; NaN if nothing was compared.
  double trackingShare = std::numeric_limits<double>::quiet_NaN();
  /// The same, with an error above 1 m all the same: what must not be.
  double wrongWhileTrackingShare = std::numeric_limits<double>::quiet_NaN();
  double updateMsP50 = 0.0;
  double updateMsP99 = 0.0;
  double updateMsMax = 0.0;
  double realtimeFactor = 0.0;          ///< duration / time spent in updates
  std::vector<EvaluationPoint> points;  ///< over the time, all that were compared
};

/// Compares estimates with ground truth, which is interpolated between its samples.
///
/// Whoever feeds it asks due() before it lets the filter weigh the next moment of a log, and tells
/// the estimates of those times with addMoment(): then errors are over time. What updates gave goes
/// into addStep(). Not thread-safe.
class ORTUNG_API Evaluation {
 public:
  struct Options {
    double convergedMetres = 0.5;
    double convergedRadians = 0.2617993877991494;  ///< 15 degrees
    double convergedSeconds = 5.0;                 ///< error must stay below for this long
    double lostMetres = 1.0;
    double longestGap = 1.0;  ///< truth is not interpolated over longer gaps [s]
    double period = 0.1;      ///< between the moments at which estimates are compared [s]
  };
  Evaluation() : Evaluation(Options()) {}
  /// @throws std::invalid_argument if the period is not at least 1 ms
  explicit Evaluation(const Options& options);
  ~Evaluation();

  /// Times at which the filter's estimate is wanted, before it sees a moment of @p stamp: multiples
  /// of the period since the first one. None within gaps of the log in which the truth can't be
  /// known. Stamps must not fall.
  /// @param hasTruth whether the moment has ground truth: if it is the first one after a gap, the
  ///   moment's own time is due next time, too, so that logs with rare truth are compared where
  ///   they can be
  std::vector<Timestamp> due(Timestamp stamp, bool hasTruth = false);

  void addTruth(Timestamp stamp, const Pose2& pose);  ///< stamps must not fall
  void addStep(const EvaluationStep& step);           ///< an update; stamps must not fall
  void addMoment(const PoseEstimate& estimate);       ///< at a time that was due; must not fall
  void addTime(Timestamp stamp);                      ///< any reading: the run's duration

  /// The moments so far, beside the truth as far as it is known so far.
  std::vector<EvaluationPoint> points() const { return compare(moments_); }
  EvaluationResult result(const std::string& source) const;

 private:
  std::vector<EvaluationPoint> compare(const std::vector<PoseEstimate>& estimates) const;

  Options options_;
  std::vector<std::pair<Timestamp, Pose2>> truth_;
  std::vector<EvaluationStep> steps_;
  std::vector<PoseEstimate> moments_;
  std::optional<Timestamp> firstDue_;
  std::int64_t nextDue_ = 0;            ///< in periods since firstDue_
  Timestamp lastDue_ = 0;               ///< of the newest moment that due() was asked for
  std::optional<Timestamp> rareTruth_;  ///< at lastDue_, if that was the first one after a gap
  std::optional<Timestamp> first_;
  Timestamp last_ = 0;
};

/// Truth at a time, by interpolation, or nothing where it is not known.
ORTUNG_API std::optional<Pose2> interpolate(const std::vector<std::pair<Timestamp, Pose2>>& truth,
                                            Timestamp stamp, double longestGap);

}  // namespace ortung
