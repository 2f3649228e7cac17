#include <fmt/format.h>

#include <algorithm>

#include "MapSvgParts.hpp"
#include "PathSvg.hpp"
#include "Report.hpp"
#include "TimeGaps.hpp"

namespace ortung::app {
namespace {

std::string mark(const Pose2& pose, double radius, const char* kind, const char* name) {
  return fmt::format(
      R"(<circle class="{0}" cx="{1:.3f}" cy="{2:.3f}" r="{3:.3f}"><title>{4} at {1:.3f} m, {2:.3f} m</title></circle>)",
      kind, pose.x, pose.y, radius, name);
}

}  // namespace

double longestPathStep(const RunResult& run) {
  const auto& points = run.figures.points;
  return std::max(longestDrawnStepOf(run.path),
                  points.empty() ? longestDrawnStepOf(run.estimates) : longestDrawnStepOf(points));
}

std::string mapSvg(const RunResult& run) {
  const MapFrame frame(run.tableInfo.region.grid);
  const FieldModel& field = run.tableInfo.field;
  const auto& points = run.figures.points;
  std::string svg = fmt::format(
      R"(<svg id="map" viewBox="{}" role="img" aria-labelledby="map-title map-about">)"
      R"(<title id="map-title">Map with paths</title><desc id="map-about">{:.4g} m by {:.4g} m, )"
      R"({} landmarks, {} estimates{}.</desc>)",
      viewBox(frame), frame.width, frame.height, field.landmarks.size(), run.path.size(),
      points.empty() ? "" : " beside the ground truth");
  svg += regionSvg(run.tableInfo.region, frame) + axesSvg(frame);
  svg += R"x(<g transform="scale(1,-1)">)x" + linesSvg(field);
  svg += changesSvg(run.changes);
  // The truth is a broad band, the estimate a thin line over it, so that neither hides the other.
  if (!points.empty()) {
    std::vector<std::pair<Timestamp, Pose2>> truth;
    for (const EvaluationPoint& point : points) truth.emplace_back(point.stamp, point.truth);
    svg += fmt::format(R"(<path class="truth" d="{}"/>)",
                       pathCommands(truth, longestDrawnStepOf(points)));
  }
  svg += estimateSvg(run.path, longestPathStep(run));
  svg += landmarksSvg(field, frame);
  if (!points.empty()) {
    svg += mark(points.front().truth, 0.5 * frame.letter, "start", "start");
    svg += mark(points.back().truth, 0.5 * frame.letter, "end", "end");
  }
  svg += fmt::format(
      R"(<circle id="truth-now" class="now truth" r="{0:.3f}" visibility="hidden"/>)"
      R"(<circle id="estimate-now" class="now estimate" r="{1:.3f}" visibility="hidden"/></g>)",
      0.7 * frame.letter, 0.4 * frame.letter);
  return svg + "</svg>";
}

}  // namespace ortung::app
