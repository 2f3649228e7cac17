#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "MapSvgParts.hpp"
#include "Report.hpp"
#include "TimeGaps.hpp"

namespace ortung::app {
namespace {

// A path is not drawn over steps that are longer and faster than this: nobody drove them.
constexpr double kJump = 1.0;       ///< [m]
constexpr double kJumpSpeed = 3.0;  ///< [m/s]
constexpr std::size_t kMaxPoints = 20000;

/// Collects the commands of an SVG path, which breaks at jumps and gaps.
class Path {
 public:
  explicit Path(double longestStep) : longestStep_(longestStep) {}

  void add(Timestamp stamp, const Pose2& pose) {
    if (!isFinite(pose)) return;
    const double way = distance(last_, pose);
    const double seconds = toSeconds(stamp) - toSeconds(lastStamp_);
    const bool jumps = way > kJump && way > kJumpSpeed * seconds;
    const bool begins = empty_ || jumps || seconds > longestStep_;
    // "h0" makes a lonely point visible: its round cap is drawn.
    text_ +=
        fmt::format(fmt::runtime(begins ? "M{:.3f} {:.3f}h0" : "L{:.3f} {:.3f}"), pose.x, pose.y);
    last_ = pose;
    lastStamp_ = stamp;
    empty_ = false;
  }
  const std::string& text() const { return text_; }

 private:
  double longestStep_;  ///< [s]
  std::string text_;
  Pose2 last_;
  Timestamp lastStamp_ = 0;
  bool empty_ = true;
};

template <class Element, class PoseOf>
std::string pathOf(const std::vector<Element>& elements, PoseOf poseOf) {
  const std::size_t every = elements.size() / kMaxPoints + 1;
  std::vector<Timestamp> stamps;
  for (std::size_t i = 0; i < elements.size(); i += every) stamps.push_back(elements[i].stamp);
  Path path(longestDrawnStep(std::move(stamps)));
  for (std::size_t i = 0; i < elements.size(); i += every)
    path.add(elements[i].stamp, poseOf(elements[i]));
  return path.text();
}

std::string mark(const Pose2& pose, double radius, const char* kind, const char* name) {
  return fmt::format(
      R"(<circle class="{0}" cx="{1:.3f}" cy="{2:.3f}" r="{3:.3f}"><title>{4} at {1:.3f} m, {2:.3f} m</title></circle>)",
      kind, pose.x, pose.y, radius, name);
}

}  // namespace

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
  // The truth is a broad band, the estimate a thin line above it: neither hides the other.
  if (!points.empty()) {
    svg += fmt::format(R"(<path class="truth" d="{}"/>)",
                       pathOf(points, [](const auto& point) { return point.truth; }));
  }
  svg += fmt::format(R"(<path class="estimate" d="{}"/>)",
                     pathOf(run.path, [](const auto& estimate) { return estimate.pose; }));
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
