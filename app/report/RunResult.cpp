#include "RunResult.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "Console.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung::app {
namespace {

/// JSON has no NaN and no infinity.
nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

std::string show(const char* format, double value, const char* unit) {
  if (!std::isfinite(value)) return "-";
  return fmt::format(fmt::runtime(format), value) + unit;
}

/// Times of which nothing is known, from the point before each to the point behind it.
nlohmann::ordered_json gapsOf(const RunResult& run) {
  auto gaps = nlohmann::ordered_json::array();
  const auto seconds = [&](const EvaluationPoint& p) {
    return toSeconds(p.stamp) - toSeconds(run.first);
  };
  const auto& points = run.figures.points;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i].followsGap) gaps.push_back({seconds(points[i - 1]), seconds(points[i])});
  return gaps;
}

}  // namespace

std::string toJson(const RunResult& run) {
  const EvaluationResult& figures = run.figures;
  const EvaluationErrors& overTime = figures.overTime;
  const EvaluationErrors& atCorrections = figures.atCorrections;
  constexpr double kNever = std::numeric_limits<double>::quiet_NaN();
  const nlohmann::ordered_json json = {
      {"source", figures.source},
      {"robot", run.robot},
      {"tables", run.tables},
      {"world", run.tableInfo.world},
      {"seed", run.seed},
      {"particles", run.particles},
      {"faults", run.faults},
      {"steps", figures.steps},
      {"compared_steps", atCorrections.compared},
      {"duration_s", number(figures.duration)},
      {"particles_mean", number(figures.particlesMean)},
      {"compared_moments", overTime.compared},
      {"moment_period_s", number(figures.period)},
      {"position_rmse_m", number(overTime.positionRmse)},
      {"position_median_m", number(overTime.positionMedian)},
      {"position_p95_m", number(overTime.positionP95)},
      {"heading_rmse_deg", number(degrees(overTime.headingRmse))},
      {"converged_after_s", number(figures.convergedAfter.value_or(kNever))},
      {"lost_share", number(overTime.lostShare)},
      {"update_ms_p50", number(figures.updateMsP50)},
      {"update_ms_p99", number(figures.updateMsP99)},
      {"realtime_factor", number(figures.realtimeFactor)},
      {"nees_mean", number(overTime.neesMean)},
      {"at_corrections",
       {{"position_rmse_m", number(atCorrections.positionRmse)},
        {"position_median_m", number(atCorrections.positionMedian)},
        {"position_p95_m", number(atCorrections.positionP95)},
        {"heading_rmse_deg", number(degrees(atCorrections.headingRmse))},
        {"lost_share", number(atCorrections.lostShare)},
        {"nees_mean", number(atCorrections.neesMean)}}},
      {"gaps", gapsOf(run)},
  };
  // File names need not be UTF-8; whoever reads the JSON may rely on it.
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::vector<Figure> figuresOf(const RunResult& run) {
  const EvaluationResult& figures = run.figures;
  const EvaluationErrors& errors = figures.overTime;
  const EvaluationErrors& atUpdates = figures.atCorrections;
  const std::string converged =
      figures.convergedAfter ? show("{:.1f}", *figures.convergedAfter, " s") : "never";
  return {
      {"Duration", show("{:.1f}", figures.duration, " s")},
      {"Updates", fmt::format("{}", figures.steps)},
      {"Updates with known truth", fmt::format("{}", atUpdates.compared)},
      {fmt::format("Moments compared, every {:g} s", figures.period),
       fmt::format("{}", errors.compared)},
      {"Converged after", errors.compared == 0 ? "-" : converged},
      {"Position error, RMS", show("{:.3f}", errors.positionRmse, " m")},
      {"Position error, median", show("{:.3f}", errors.positionMedian, " m")},
      {"Position error, 95 %", show("{:.3f}", errors.positionP95, " m")},
      {"Heading error, RMS", show("{:.2f}", degrees(errors.headingRmse), " deg")},
      {"Share of time lost", show("{:.1f}", 100.0 * errors.lostShare, " %")},
      {"Consistency (NEES, 3 is right)", show("{:.2f}", errors.neesMean, "")},
      {"Position error at updates, RMS", show("{:.3f}", atUpdates.positionRmse, " m")},
      {"Samples, mean", show("{:.0f}", figures.particlesMean, "")},
      {"Time an update, median", show("{:.3f}", figures.updateMsP50, " ms")},
      {"Time an update, 99 %", show("{:.3f}", figures.updateMsP99, " ms")},
      {"Faster than real time", show("{:.0f}", figures.realtimeFactor, " x")},
  };
}

std::string toText(const RunResult& run) {
  std::string text = fmt::format("{}\n", printable(run.figures.source));
  for (const std::string& fault : run.faults) text += fmt::format("  with {}\n", printable(fault));
  for (const Figure& figure : figuresOf(run)) {
    text += fmt::format("  {:<32}{:>12}\n", figure.name, figure.value);
  }
  text += fmt::format(
      "Errors are over time after convergence: every {:g} s, carried on by odometry between "
      "updates\n",
      run.figures.period);
  return text;
}

}  // namespace ortung::app
