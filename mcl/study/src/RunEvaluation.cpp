#include "ortung/study/RunEvaluation.hpp"

#include <optional>
#include <stdexcept>
#include <utility>

#include "ortung/run/Feeder.hpp"

namespace ortung {

void RunEvaluation::addMoment() {
  const Feeder& feeder = localization_.feeder();
  if (!any_) run_.first = feeder.stamp();
  any_ = true;
  localization_.followOdometry();
  for (const Timestamp time : evaluation_.due(feeder.stamp(), feeder.truth().has_value())) {
    const auto estimate = localization_.estimate(time);
    if (!estimate) continue;
    evaluation_.addMoment(*estimate);
    run_.path.push_back(*estimate);
  }
  evaluation_.addTime(feeder.stamp());
  if (feeder.truth()) evaluation_.addTruth(feeder.stamp(), *feeder.truth());
}

void RunEvaluation::addStep(const EvaluationStep& step) {
  evaluation_.addStep(step);
  run_.estimates.push_back(step.estimate);
  run_.path.push_back(step.estimate);
  run_.updateMs.push_back(static_cast<float>(step.updateMilliseconds));
}

EvaluatedRun RunEvaluation::result(const std::string& source) && {
  run_.figures = evaluation_.result(source);
  run_.calibration = qualityCalibration(run_.figures.points);
  return std::move(run_);
}

EvaluatedRun evaluate(Localization& localization, const std::string& source,
                      const Evaluation::Options& options, const std::function<bool(double)>& goOn) {
  RunEvaluation run(localization, options);
  while (!goOn || goOn(localization.feeder().progress())) {
    if (!localization.advance()) break;
    run.addMoment();
    if (const std::optional<PoseEstimate> estimate = localization.update())
      run.addStep({*estimate, localization.updateMilliseconds(), localization.spentMilliseconds()});
  }
  if (!localization.isStarted())
    throw std::runtime_error(source +
                             ": has no ground truth to start from, expected a feature of "
                             "type groundTruth; start globally, or at a pose");
  EvaluatedRun result = std::move(run).result(source);
  if (result.estimates.empty())
    throw std::runtime_error(source +
                             ": has no reading that depends on the pose, of a feature "
                             "that was learned, so there is nothing to localize with");
  return result;
}

}  // namespace ortung
