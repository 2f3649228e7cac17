#include "RunResult.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "Console.hpp"
#include "RunJson.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/study/Figures.hpp"

namespace ortung::app {
namespace {

std::string show(const char* format, double value, const char* unit) {
  if (!std::isfinite(value)) return "-";
  return fmt::format(fmt::runtime(format), value) + unit;
}

/// Returns gaps in the estimates, each from the point before it to the point after it.
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

nlohmann::ordered_json caseOf(const RunResult& run) {
  auto events = nlohmann::ordered_json::array();
  for (const CaseEvent& event : run.events) {
    const auto ifRight = [&](auto value) {
      return event.isRight ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
    };
    events.push_back({{"at_s", event.at},
                      {"x_m", event.place.x},
                      {"y_m", event.place.y},
                      {"heading_deg", degrees(event.place.theta)},
                      {"right", event.isRight},
                      {"after_s", ifRight(event.after)},
                      {"after_m", ifRight(event.travelled)},
                      {"after_readings", ifRight(event.readings)}});
  }
  return {{"kind", nameOf(run.kind)}, {"number", run.number}, {"events", std::move(events)}};
}

nlohmann::ordered_json jsonOf(const Calibration& calibration) {
  nlohmann::ordered_json bins = nlohmann::ordered_json::array();
  for (const ReliabilityBin& bin : calibration.bins)
    bins.push_back({{"moments", bin.count},
                    {"claimed", jsonNumber(bin.claimed)},
                    {"right_share", jsonNumber(bin.share)}});
  return {{"calibration_error", jsonNumber(calibration.error)},
          {"area_under_curve", jsonNumber(calibration.area)},
          {"bins", bins}};
}

/// Returns medians over updates after convergence; NaN without such updates.
GridComparison besideGridOf(const RunResult& run) {
  std::vector<double> divergences;
  std::vector<double> distances;
  for (const GridComparison& one : run.besideGrid) {
    if (!run.figures.convergedAfter ||
        one.stamp < run.first + fromSeconds(*run.figures.convergedAfter))
      continue;
    divergences.push_back(one.divergence);
    distances.push_back(one.distance);
  }
  const auto median = [](std::vector<double>& values) {
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  return {0, median(divergences), median(distances)};
}

void addFigures(const NamedFigures& figures, nlohmann::ordered_json& json) {
  for (const NamedFigure& one : figures) {
    json[one.name] = jsonNumber(one.value);
    if (one.isCount) json[one.name] = static_cast<std::size_t>(one.value);
  }
}

void addChanges(const MapChanges& changes, nlohmann::ordered_json& json) {
  json["map_gone_cells"] = changes.sure(MapChange::Kind::kGone);
  json["map_new_cells"] = changes.sure(MapChange::Kind::kNew);
}

}  // namespace

const char* nameOf(RunKind kind) {
  switch (kind) {
    case RunKind::kKidnap:
      return "kidnap";
    case RunKind::kWakeUp:
      return "wake-up";
    case RunKind::kTeleports:
      return "teleports";
    default:
      return "whole";
  }
}

nlohmann::ordered_json jsonNumber(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

std::string jsonText(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

nlohmann::ordered_json jsonOf(const RunResult& run) {
  const EvaluationResult& figures = run.figures;
  const EvaluationErrors& atCorrections = figures.atCorrections;
  nlohmann::ordered_json json = {
      {"source", figures.source},     {"robot", run.robot},   {"tables", run.tables},
      {"world", run.tableInfo.world}, {"seed", run.seed},     {"particles", run.particles},
      {"start", run.start},           {"faults", run.faults},
  };
  addFigures(errorFigures(figures), json);
  json["quality"] = jsonOf(run.calibration);
  addFigures(timeFigures(figures), json);
  addFigures(consistencyFigures(figures), json);
  addFigures(correctionFigures(figures), json["at_corrections"]);
  json["gaps"] = gapsOf(run);
  const BoundFigures bound = run.bound.value_or(BoundFigures());
  json["bound_median_m"] = jsonNumber(bound.positionMedian);
  json["bound_rmse_m"] = jsonNumber(bound.positionRmse);
  json["bound_heading_rmse_deg"] = jsonNumber(degrees(bound.headingRmse));
  json["ratio_median"] = jsonNumber(atCorrections.positionMedian / bound.positionMedian);
  json["ratio_rmse"] = jsonNumber(atCorrections.positionRmse / bound.positionRmse);
  const GridComparison besideGrid = besideGridOf(run);
  json["grid_divergence_median"] = jsonNumber(besideGrid.divergence);
  json["grid_distance_median_m"] = jsonNumber(besideGrid.distance);
  addFigures(protectionFigures(figures), json);
  addChanges(run.changes, json);
  if (run.kind != RunKind::kWhole) json["case"] = caseOf(run);
  return json;
}

std::string toJson(const RunResult& run) { return jsonText(jsonOf(run)); }

std::vector<Figure> figuresOf(const RunResult& run) {
  const EvaluationResult& figures = run.figures;
  const EvaluationErrors& errors = figures.overTime;
  const EvaluationErrors& atUpdates = figures.atCorrections;
  const std::string converged =
      figures.convergedAfter ? show("{:.1f}", *figures.convergedAfter, " s") : "never";
  std::vector<Figure> all = {
      {"Duration", show("{:.1f}", figures.duration, " s")},
      {"Updates", fmt::format("{}", figures.steps)},
      {"Updates with known truth", fmt::format("{}", atUpdates.compared)},
      {fmt::format("Times compared, every {:g} s", figures.period),
       fmt::format("{}", errors.compared)},
      {"Converged after", errors.compared == 0 ? "-" : converged},
      {"Position error, RMS", show("{:.3f}", errors.positionRmse, " m")},
      {"Position error, median", show("{:.3f}", errors.positionMedian, " m")},
      {"Position error, 95 %", show("{:.3f}", errors.positionP95, " m")},
      {"Position error, 99 %", show("{:.3f}", errors.positionP99, " m")},
      {"Position error, max", show("{:.3f}", errors.positionMax, " m")},
      {"Heading error, RMS", show("{:.2f}", degrees(errors.headingRmse), " deg")},
      {"Share of time lost", show("{:.1f}", 100.0 * errors.lostShare, " %")},
      {"Time with status tracking", show("{:.1f}", 100.0 * figures.trackingShare, " %")},
      {"... with an error above 1 m",
       show("{:.2f}", 100.0 * figures.wrongWhileTrackingShare, " %")},
      {"... with one beyond the bound",
       show("{:.2f}", 100.0 * figures.beyondProtectionShare, " %")},
      {"... bound of the position error, median", show("{:.3f}", figures.protectionMedian, " m")},
      {"Consistency (NEES, 3 is right)", show("{:.2f}", errors.neesMean, "")},
      {"Position error at updates, RMS", show("{:.3f}", atUpdates.positionRmse, " m")},
      {"Samples, mean", show("{:.0f}", figures.particlesMean, "")},
      {"Time per update, median", show("{:.3f}", figures.updateMsP50, " ms")},
      {"Time per update, 99 %", show("{:.3f}", figures.updateMsP99, " ms")},
      {"Time per update, max", show("{:.3f}", figures.updateMsMax, " ms")},
      {"Speed relative to real time", show("{:.0f}", figures.realtimeFactor, " x")},
  };
  if (!run.besideGrid.empty()) {
    const GridComparison besideGrid = besideGridOf(run);
    all.push_back(
        {"Divergence from the grid, median", show("{:.3f}", besideGrid.divergence, " nats")});
    all.push_back({"Distance from the grid, median", show("{:.3f}", besideGrid.distance, " m")});
  }
  if (!run.bound) return all;
  const BoundFigures& bound = *run.bound;
  all.push_back({"Cramer-Rao bound, median", show("{:.4f}", bound.positionMedian, " m")});
  all.push_back({"Cramer-Rao bound, RMS", show("{:.4f}", bound.positionRmse, " m")});
  all.push_back({"Median at updates / bound",
                 show("{:.1f}", atUpdates.positionMedian / bound.positionMedian, " x")});
  all.push_back({"RMS at updates / bound",
                 show("{:.1f}", atUpdates.positionRmse / bound.positionRmse, " x")});
  return all;
}

std::string toText(const RunResult& run) {
  std::string text = fmt::format("{}\n", printable(run.figures.source));
  for (const std::string& fault : run.faults) text += fmt::format("  with {}\n", printable(fault));
  for (const Figure& figure : figuresOf(run)) {
    text += fmt::format("  {:<32}{:>12}\n", figure.name, figure.value);
  }
  text += fmt::format(
      "Errors are taken every {:g} s after convergence; odometry predicts poses between updates\n",
      run.figures.period);
  return text;
}

}  // namespace ortung::app
