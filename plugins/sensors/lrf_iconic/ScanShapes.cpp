#include "ScanShapes.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace ortung {
namespace {

using Points = std::span<const ScanPoint>;

double away(const ScanPoint& a, const ScanPoint& b) { return std::hypot(a.x - b.x, a.y - b.y); }

bool isNearer(const ScanPoint& a, const ScanPoint& b) {
  return std::hypot(a.x, a.y) < std::hypot(b.x, b.y);
}

/// Neighbours on one surface are farther apart the farther away they are; twice what a surface at
/// 45 degrees shows still counts as one.
bool areApart(const ScanPoint& a, const ScanPoint& b, double angleStep,
              const ScanShapesConfig& config) {
  const double range = std::min(std::hypot(a.x, a.y), std::hypot(b.x, b.y));
  return away(a, b) > config.breakDistance + 3.0 * range * angleStep;
}

std::vector<std::vector<ScanPoint>> outlinesOf(std::span<const float> ranges, double firstAngle,
                                               double angleStep, const ScanShapesConfig& config) {
  std::vector<std::vector<ScanPoint>> outlines;
  bool isOpen = false;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const auto range = static_cast<double>(ranges[i]);
    if (!std::isfinite(range)) {
      isOpen = false;
      continue;
    }
    const double angle = firstAngle + static_cast<double>(i) * angleStep;
    const ScanPoint point{range * std::cos(angle), range * std::sin(angle)};
    if (!isOpen || areApart(outlines.back().back(), point, angleStep, config))
      outlines.emplace_back();
    outlines.back().push_back(point);
    isOpen = true;
  }
  if (outlines.empty()) return outlines;
  // All around, the last outline may go on in the first one.
  const bool isAround =
      static_cast<double>(ranges.size()) * angleStep > 2.0 * std::numbers::pi - 1.5 * angleStep;
  const bool meet = isAround && std::isfinite(ranges.front()) && std::isfinite(ranges.back()) &&
                    !areApart(outlines.back().back(), outlines.front().front(), angleStep, config);
  std::vector<ScanPoint>& last = outlines.back();
  if (meet && outlines.size() == 1) {
    // Closed: begin at a corner, not in the middle of a wall. The farthest point is one.
    std::rotate(last.begin(), std::max_element(last.begin(), last.end(), isNearer), last.end());
  } else if (meet) {
    last.insert(last.end(), outlines.front().begin(), outlines.front().end());
    outlines.erase(outlines.begin());
  }
  return outlines;
}

/// Where to split: the point farthest from the chord, if it is beyond the tolerance. An outline
/// that comes back to where it began has no chord worth the name: there, the farthest from its
/// beginning.
std::size_t farthest(Points points, double tolerance) {
  const ScanPoint& a = points.front();
  const ScanPoint& b = points.back();
  const double length = away(a, b);
  double reach = 0.0;
  for (const ScanPoint& p : points) reach = std::max(reach, away(a, p));
  const bool comesBack = reach > 4.0 * length;
  double most = tolerance;
  std::size_t where = 0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const ScanPoint& p = points[i];
    const double across = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    const double off = comesBack ? away(a, p) : std::abs(across) / length;
    if (off > most) {
      most = off;
      where = i;
    }
  }
  return where;
}

/// Total least squares through the points, between the feet of the first and the last one.
ScanSegment lineThrough(Points points) {
  double x = 0.0;
  double y = 0.0;
  for (const ScanPoint& p : points) {
    x += p.x;
    y += p.y;
  }
  x /= static_cast<double>(points.size());
  y /= static_cast<double>(points.size());
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (const ScanPoint& p : points) {
    xx += (p.x - x) * (p.x - x);
    xy += (p.x - x) * (p.y - y);
    yy += (p.y - y) * (p.y - y);
  }
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const auto foot = [&](const ScanPoint& p) {
    const double along = (p.x - x) * c + (p.y - y) * s;
    return ScanPoint{x + along * c, y + along * s};
  };
  return {foot(points.front()), foot(points.back()), {points.begin(), points.end()}};
}

/// A circle by algebraic least squares; of points that hardly bend, one behind them as wide as
/// they are.
ScanCircle circleThrough(Points points, double largest) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  ScanPoint mean;
  for (const ScanPoint& p : points) {
    const Eigen::Vector3d row(2.0 * p.x, 2.0 * p.y, 1.0);
    normal += row * row.transpose();
    right += row * (p.x * p.x + p.y * p.y);
    mean.x += p.x / static_cast<double>(points.size());
    mean.y += p.y / static_cast<double>(points.size());
  }
  const double half = 0.5 * away(points.front(), points.back());
  const Eigen::Vector3d fit = normal.fullPivLu().solve(right);
  const double radius = std::sqrt(std::max(fit[2] + fit[0] * fit[0] + fit[1] * fit[1], 0.0));
  const double toMean = std::hypot(mean.x, mean.y);
  const bool bulgesTowards = std::hypot(fit[0], fit[1]) > toMean;
  if (bulgesTowards && radius >= half && radius <= 0.5 * largest) return {{fit[0], fit[1]}, radius};
  const double behind = toMean > 0.0 ? 1.0 + 0.5 * half / toMean : 1.0;
  return {{mean.x * behind, mean.y * behind}, half};
}

/// Adds the straight pieces of an outline to @p shapes.
void addSegments(Points points, const ScanShapesConfig& config, ScanShapes& shapes) {
  std::vector<Points> rest{points};
  while (!rest.empty()) {
    const Points piece = rest.back();
    rest.pop_back();
    if (piece.size() < 2) continue;
    if (const std::size_t where = farthest(piece, config.lineTolerance); where > 0) {
      rest.push_back(piece.subspan(where));
      rest.push_back(piece.first(where + 1));
      continue;
    }
    if (static_cast<int>(piece.size()) < config.fewestPoints) continue;
    if (away(piece.front(), piece.back()) < config.shortest) continue;
    shapes.segments.push_back(lineThrough(piece));
  }
}

}  // namespace

ScanShapes shapesOf(std::span<const float> ranges, double firstAngle, double angleStep,
                    const ScanShapesConfig& config) {
  ScanShapes shapes;
  for (const auto& outline : outlinesOf(ranges, firstAngle, angleStep, config)) {
    if (static_cast<int>(outline.size()) < config.fewestPoints) continue;
    if (away(outline.front(), outline.back()) <= config.largestRound &&
        farthest(outline, config.largestRound) == 0)
      shapes.circles.push_back(circleThrough(outline, config.largestRound));
    else
      addSegments(outline, config, shapes);
  }
  return shapes;
}

}  // namespace ortung
