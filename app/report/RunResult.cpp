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

}  // namespace

std::string toJson(const RunResult& run) {
  const EvaluationResult& figures = run.figures;
  constexpr double kNever = std::numeric_limits<double>::quiet_NaN();
  const nlohmann::ordered_json json = {
      {"source", figures.source},
      {"robot", run.robot},
      {"tables", run.tables},
      {"world", run.tableInfo.world},
      {"seed", run.seed},
      {"particles", run.particles},
      {"steps", figures.steps},
      {"compared_steps", figures.comparedSteps},
      {"duration_s", number(figures.duration)},
      {"particles_mean", number(figures.particlesMean)},
      {"position_rmse_m", number(figures.positionRmse)},
      {"position_median_m", number(figures.positionMedian)},
      {"position_p95_m", number(figures.positionP95)},
      {"heading_rmse_deg", number(degrees(figures.headingRmse))},
      {"converged_after_s", number(figures.convergedAfter.value_or(kNever))},
      {"lost_share", number(figures.lostShare)},
      {"update_ms_p50", number(figures.updateMsP50)},
      {"update_ms_p99", number(figures.updateMsP99)},
      {"realtime_factor", number(figures.realtimeFactor)},
      {"nees_mean", number(figures.neesMean)},
  };
  // File names need not be UTF-8; whoever reads the JSON may rely on it.
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::vector<Figure> figuresOf(const RunResult& run) {
  const EvaluationResult& figures = run.figures;
  const std::string converged =
      figures.convergedAfter ? show("{:.1f}", *figures.convergedAfter, " s") : "never";
  return {
      {"Duration", show("{:.1f}", figures.duration, " s")},
      {"Updates", fmt::format("{}", figures.steps)},
      {"Updates with known truth", fmt::format("{}", figures.comparedSteps)},
      {"Converged after", figures.comparedSteps == 0 ? "-" : converged},
      {"Position error, RMS", show("{:.3f}", figures.positionRmse, " m")},
      {"Position error, median", show("{:.3f}", figures.positionMedian, " m")},
      {"Position error, 95 %", show("{:.3f}", figures.positionP95, " m")},
      {"Heading error, RMS", show("{:.2f}", degrees(figures.headingRmse), " deg")},
      {"Share of time lost", show("{:.1f}", 100.0 * figures.lostShare, " %")},
      {"Consistency (NEES, 3 is right)", show("{:.2f}", figures.neesMean, "")},
      {"Samples, mean", show("{:.0f}", figures.particlesMean, "")},
      {"Time an update, median", show("{:.3f}", figures.updateMsP50, " ms")},
      {"Time an update, 99 %", show("{:.3f}", figures.updateMsP99, " ms")},
      {"Faster than real time", show("{:.0f}", figures.realtimeFactor, " x")},
  };
}

std::string toText(const RunResult& run) {
  std::string text = fmt::format("{}\n", printable(run.figures.source));
  for (const Figure& figure : figuresOf(run)) {
    text += fmt::format("  {:<32}{:>12}\n", figure.name, figure.value);
  }
  return text;
}

}  // namespace ortung::app
