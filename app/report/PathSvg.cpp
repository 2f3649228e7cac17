#include "PathSvg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "Palette.hpp"
#include "TimeGaps.hpp"

namespace ortung::app {
namespace {

// A path is broken at steps that are longer and faster than this, which no robot can drive.
constexpr double kJump = 1.0;       ///< length of such a step [m]
constexpr double kJumpSpeed = 3.0;  ///< speed of such a step [m/s]
constexpr std::size_t kMaxPoints = 20000;
constexpr std::size_t kBands = 10;  ///< number of colours of quality

/// A point of a path, and whether a line leads to it from the one before.
struct PathPoint {
  Timestamp stamp = 0;
  Pose2 pose;
  bool begins = true;
};

std::vector<PathPoint> connected(const std::vector<std::pair<Timestamp, Pose2>>& poses,
                                 double longestStep) {
  std::vector<PathPoint> points;
  for (const auto& [stamp, pose] : poses) {
    PathPoint point{stamp, pose};
    if (!points.empty()) {
      const PathPoint& last = points.back();
      const double way = distance(last.pose, pose);
      const double seconds = toSeconds(stamp) - toSeconds(last.stamp);
      point.begins = (way > kJump && way > kJumpSpeed * seconds) || seconds > longestStep;
    }
    points.push_back(point);
  }
  return points;
}

/// Returns the longest step for thinned points, whose usual step is longer.
double longestOf(const std::vector<std::pair<Timestamp, Pose2>>& kept, double longestStep) {
  std::vector<Timestamp> stamps;
  for (const auto& [stamp, pose] : kept) stamps.push_back(stamp);
  return std::max(longestStep, longestDrawnStep(std::move(stamps)));
}

void moveTo(std::string& text, const Pose2& pose) {
  // "h0" makes a single point visible: its round cap is drawn.
  fmt::format_to(std::back_inserter(text), "M{:.3f} {:.3f}h0", pose.x, pose.y);
}

void lineTo(std::string& text, const Pose2& pose) {
  fmt::format_to(std::back_inserter(text), "L{:.3f} {:.3f}", pose.x, pose.y);
}

/// Makes a path for each kind of points. A line has the kind of the point to which it leads.
template <std::size_t kinds, class KindOf>
std::array<std::string, kinds> pathsByKind(const std::vector<PathPoint>& points, KindOf kindOf) {
  std::array<std::string, kinds> texts;
  std::size_t drawing = kinds;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t kind = kindOf(i);
    std::string& text = texts[kind];
    if (points[i].begins) {
      moveTo(text, points[i].pose);
    } else {
      if (kind != drawing) moveTo(text, points[i - 1].pose);
      lineTo(text, points[i].pose);
    }
    drawing = kind;
  }
  return texts;
}

/// Returns at most kMaxPoints points, each the least trusted one of those that it replaces.
std::vector<PoseEstimate> thinned(const std::vector<PoseEstimate>& path) {
  const std::size_t every = path.size() / kMaxPoints + 1;
  std::vector<PoseEstimate> kept;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i % every == 0) {
      kept.push_back(path[i]);
    } else {
      kept.back().quality = std::min(kept.back().quality, path[i].quality);
      kept.back().status = std::max(kept.back().status, path[i].status);
    }
  }
  std::erase_if(kept, [](const PoseEstimate& estimate) { return !isFinite(estimate.pose); });
  return kept;
}

/// Returns "#rrggbb".
std::string colourOf(std::size_t band) {
  const Colour c = palette::quality((static_cast<double>(band) + 0.5) / kBands);
  return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue);
}

}  // namespace

std::string pathCommands(const std::vector<std::pair<Timestamp, Pose2>>& poses,
                         double longestStep) {
  const std::size_t every = poses.size() / kMaxPoints + 1;
  std::vector<std::pair<Timestamp, Pose2>> kept;
  for (std::size_t i = 0; i < poses.size(); i += every)
    if (isFinite(poses[i].second)) kept.push_back(poses[i]);
  return pathsByKind<1>(connected(kept, longestOf(kept, longestStep)),
                        [](std::size_t) { return 0; })[0];
}

std::string estimateSvg(const std::vector<PoseEstimate>& path, double longestStep) {
  const std::vector<PoseEstimate> kept = thinned(path);
  std::vector<std::pair<Timestamp, Pose2>> poses;
  for (const PoseEstimate& estimate : kept) poses.emplace_back(estimate.stamp, estimate.pose);
  longestStep = longestOf(poses, longestStep);
  const std::vector<PathPoint> points = connected(poses, longestStep);
  const auto statuses = pathsByKind<3>(
      points, [&](std::size_t i) { return static_cast<std::size_t>(kept[i].status); });
  std::string svg;
  for (const TrackStatus status : {TrackStatus::kUncertain, TrackStatus::kLost}) {
    const std::string& text = statuses[static_cast<std::size_t>(status)];
    if (!text.empty()) svg += fmt::format(R"(<path class="{}" d="{}"/>)", nameOf(status), text);
  }
  svg += fmt::format(R"(<path class="estimate" d="{}"/>)", pathCommands(poses, longestStep));
  const auto bands = pathsByKind<kBands>(points, [&](std::size_t i) {
    const double quality = std::isfinite(kept[i].quality) ? kept[i].quality : 0.0;
    return std::min(static_cast<std::size_t>(std::clamp(quality, 0.0, 1.0) * kBands), kBands - 1);
  });
  for (std::size_t band = 0; band < kBands; ++band) {
    if (!bands[band].empty())
      svg +=
          fmt::format(R"(<path class="quality" stroke="{}" d="{}"/>)", colourOf(band), bands[band]);
  }
  return svg;
}

std::string qualityBar() {
  std::string svg = R"(<svg class="bar" viewBox="0 0 10 1" preserveAspectRatio="none">)";
  for (std::size_t band = 0; band < kBands; ++band)
    svg += fmt::format(R"(<rect x="{}" width="1.02" height="1" fill="{}"/>)", band, colourOf(band));
  return svg + "</svg>";
}

}  // namespace ortung::app
