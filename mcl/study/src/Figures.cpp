#include "ortung/study/Figures.hpp"

#include <limits>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

NamedFigure count(const char* name, std::size_t number) {
  return {name, static_cast<double>(number), true};
}

}  // namespace

NamedFigures errorFigures(const EvaluationResult& run) {
  constexpr double kNever = std::numeric_limits<double>::quiet_NaN();
  const EvaluationErrors& errors = run.overTime;
  return {
      count("steps", run.steps),
      count("compared_steps", run.atCorrections.compared),
      {"duration_s", run.duration},
      {"particles_mean", run.particlesMean},
      count("compared_moments", errors.compared),
      {"moment_period_s", run.period},
      {"position_rmse_m", errors.positionRmse},
      {"position_median_m", errors.positionMedian},
      {"position_p95_m", errors.positionP95},
      {"position_p99_m", errors.positionP99},
      {"position_max_m", errors.positionMax},
      {"heading_rmse_deg", degrees(errors.headingRmse)},
      {"converged_after_s", run.convergedAfter.value_or(kNever)},
      {"converged_after_m", run.convergedDistance},
      {"lost_share", errors.lostShare},
      {"tracking_share", run.trackingShare},
      {"wrong_while_tracking_share", run.wrongWhileTrackingShare},
  };
}

NamedFigures timeFigures(const EvaluationResult& run) {
  return {{"update_ms_p50", run.updateMsP50},
          {"update_ms_p99", run.updateMsP99},
          {"update_ms_max", run.updateMsMax},
          {"realtime_factor", run.realtimeFactor}};
}

NamedFigures consistencyFigures(const EvaluationResult& run) {
  return {{"nees_mean", run.overTime.neesMean}, {"nees_above_share", run.overTime.neesAboveShare}};
}

NamedFigures correctionFigures(const EvaluationResult& run) {
  const EvaluationErrors& errors = run.atCorrections;
  return {
      {"position_rmse_m", errors.positionRmse}, {"position_median_m", errors.positionMedian},
      {"position_p95_m", errors.positionP95},   {"heading_rmse_deg", degrees(errors.headingRmse)},
      {"lost_share", errors.lostShare},         {"nees_mean", errors.neesMean}};
}

NamedFigures protectionFigures(const EvaluationResult& run) {
  return {{"beyond_protection_share", run.beyondProtectionShare},
          {"beyond_protection_uncertain_share", run.beyondProtectionUncertainShare},
          {"protection_median_m", run.protectionMedian},
          {"protection_ratio", run.protectionRatio}};
}

}  // namespace ortung
