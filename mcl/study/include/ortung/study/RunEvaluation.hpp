#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/run/Localization.hpp"
#include "ortung/study/Calibration.hpp"
#include "ortung/study/Evaluation.hpp"

namespace ortung {

/// What was measured in one run of a localization over a source.
struct EvaluatedRun {
  EvaluationResult figures;
  Timestamp first = 0;                  ///< stamp of the first reading
  std::vector<PoseEstimate> estimates;  ///< estimates of all updates, with or without truth
  /// Estimates in the order of time: at all updates and at the even times at which figures.points
  /// are taken, with or without ground truth.
  std::vector<PoseEstimate> path;
  std::vector<float> updateMs;  ///< duration of each update [ms]
  Calibration calibration;      ///< calibration of the claimed quality
};

/// Follows a localization through its source and compares the poses that a program would get at
/// even times. Between two readings of odometry it interpolates odometry, since logs have fewer of
/// its readings than the robot had. Not thread-safe.
class ORTUNG_API RunEvaluation {
 public:
  /// @param localization borrowed; has a source @throws std::invalid_argument as Evaluation
  RunEvaluation(Localization& localization, const Evaluation::Options& options)
      : localization_(localization), evaluation_(options) {}

  /// Takes the moment that Localization::advance() has filled in, before its update().
  void addMoment();
  /// Takes the estimate of an update.
  void addStep(const EvaluationStep& step);

  const Evaluation& evaluation() const { return evaluation_; }
  /// Returns what was measured so far. @param source the source's name, for the figures
  EvaluatedRun result(const std::string& source) &&;

 private:
  Localization& localization_;
  Evaluation evaluation_;
  EvaluatedRun run_;
  bool any_ = false;
};

/// Evaluates a whole run.
/// @param localization at its beginning; has a source @param source the source's name
/// @param goOn called before each moment with the share of the source that is done, in [0, 1];
///   false ends the run
/// @throws std::runtime_error of the source, and if nothing in it could be localized with
ORTUNG_API EvaluatedRun evaluate(Localization& localization, const std::string& source,
                                 const Evaluation::Options& options,
                                 const std::function<bool(double)>& goOn = {});

}  // namespace ortung
