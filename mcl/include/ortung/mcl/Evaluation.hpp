#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung {

/// One update of MCL, for evaluation.
struct EvaluationStep {
  PoseEstimate estimate;
  double updateMilliseconds = 0.0;
};

/// An estimate beside the truth at its time.
struct EvaluationPoint {
  Timestamp stamp = 0;
  Pose2 truth;
  Pose2 estimate;
  double positionError = 0.0;  ///< [m]
  double headingError = 0.0;   ///< [rad], in [0, pi]
  std::size_t samples = 0;
};

/// The figures of one run. Errors are over the time after convergence; NaN where there are none.
struct EvaluationResult {
  std::string source;
  std::size_t steps = 0;          ///< updates
  std::size_t comparedSteps = 0;  ///< updates at whose time the truth is known
  double duration = 0.0;          ///< of the run [s]
  double particlesMean = 0.0;
  double positionRmse = 0.0;             ///< [m]
  double positionMedian = 0.0;           ///< [m]
  double positionP95 = 0.0;              ///< [m]
  double headingRmse = 0.0;              ///< [rad]
  std::optional<double> convergedAfter;  ///< [s] from the first reading
  double lostShare = 0.0;  ///< share of the time after convergence with error above 1 m
  double updateMsP50 = 0.0;
  double updateMsP99 = 0.0;
  double realtimeFactor = 0.0;  ///< duration / time spent in updates
  double neesMean = 0.0;        ///< normalized estimation error squared; 3 if consistent
  std::vector<EvaluationPoint> points;
};

/// Compares estimates with ground truth, which is interpolated between its samples.
/// Not thread-safe.
class ORTUNG_API Evaluation {
 public:
  struct Options {
    double convergedMetres = 0.5;
    double convergedRadians = 0.2617993877991494;  ///< 15 degrees
    double convergedSeconds = 5.0;                 ///< error must stay below for this long
    double lostMetres = 1.0;
    double longestGap = 1.0;  ///< truth is not interpolated over longer gaps [s]
  };
  Evaluation() : Evaluation(Options()) {}
  explicit Evaluation(const Options& options);
  ~Evaluation();

  void addTruth(Timestamp stamp, const Pose2& pose);  ///< stamps must not fall
  void addStep(const EvaluationStep& step);           ///< stamps must not fall
  void addTime(Timestamp stamp);                      ///< any reading: the run's duration

  EvaluationResult result(const std::string& source) const;

 private:
  Options options_;
  std::vector<std::pair<Timestamp, Pose2>> truth_;
  std::vector<EvaluationStep> steps_;
  std::optional<Timestamp> first_;
  Timestamp last_ = 0;
};

/// Truth at a time, by interpolation, or nothing where it is not known.
ORTUNG_API std::optional<Pose2> interpolate(const std::vector<std::pair<Timestamp, Pose2>>& truth,
                                            Timestamp stamp, double longestGap);

}  // namespace ortung
