#include "ScanShapes.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

using Points = std::span<const PlanePoint>;

bool isNearer(const PlanePoint& a, const PlanePoint& b) {
  return std::hypot(a.x, a.y) < std::hypot(b.x, b.y);
}

/// Returns whether neighbours belong to different surfaces. The distance of neighbours on one
/// surface grows with range; up to twice that on a surface at 45 degrees counts as one surface.
bool areApart(const PlanePoint& a, const PlanePoint& b, double angleStep,
              const ScanShapesConfig& config) {
  const double range = std::min(std::hypot(a.x, a.y), std::hypot(b.x, b.y));
  return distance(a, b) > config.breakDistance + 3.0 * range * angleStep;
}

std::vector<std::vector<PlanePoint>> outlinesOf(std::span<const float> ranges, double firstAngle,
                                                double angleStep, const ScanShapesConfig& config) {
  std::vector<std::vector<PlanePoint>> outlines;
  bool isOpen = false;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const auto range = static_cast<double>(ranges[i]);
    if (!std::isfinite(range)) {
      isOpen = false;
      continue;
    }
    const double angle = firstAngle + static_cast<double>(i) * angleStep;
    const PlanePoint point{range * std::cos(angle), range * std::sin(angle)};
    if (!isOpen || areApart(outlines.back().back(), point, angleStep, config))
      outlines.emplace_back();
    outlines.back().push_back(point);
    isOpen = true;
  }
  if (outlines.empty()) return outlines;
  // If the scan goes all around, the last outline may continue in the first one.
  const bool isAround = static_cast<double>(ranges.size()) * angleStep > kTurn - 1.5 * angleStep;
  const bool meet = isAround && std::isfinite(ranges.front()) && std::isfinite(ranges.back()) &&
                    !areApart(outlines.back().back(), outlines.front().front(), angleStep, config);
  std::vector<PlanePoint>& last = outlines.back();
  if (meet && outlines.size() == 1) {
    // A closed outline must begin at a corner, not in the middle of a wall. The farthest point is
    // one.
    std::rotate(last.begin(), std::max_element(last.begin(), last.end(), isNearer), last.end());
  } else if (meet) {
    last.insert(last.end(), outlines.front().begin(), outlines.front().end());
    outlines.erase(outlines.begin());
  }
  return outlines;
}

/// Fits a circle by algebraic least squares; points with little curvature get one behind them that
/// is as wide as they are.
ScanCircle circleThrough(Points points, double largest) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  PlanePoint mean;
  for (const PlanePoint& p : points) {
    const Eigen::Vector3d row(2.0 * p.x, 2.0 * p.y, 1.0);
    normal += row * row.transpose();
    right += row * (p.x * p.x + p.y * p.y);
    mean.x += p.x / static_cast<double>(points.size());
    mean.y += p.y / static_cast<double>(points.size());
  }
  const double half = 0.5 * distance(points.front(), points.back());
  const Eigen::Vector3d fit = normal.fullPivLu().solve(right);
  const double radius = std::sqrt(std::max(fit[2] + fit[0] * fit[0] + fit[1] * fit[1], 0.0));
  const double toMean = std::hypot(mean.x, mean.y);
  const bool bulgesTowards = std::hypot(fit[0], fit[1]) > toMean;
  if (bulgesTowards && radius >= half && radius <= 0.5 * largest) return {{fit[0], fit[1]}, radius};
  const double behind = toMean > 0.0 ? 1.0 + 0.5 * half / toMean : 1.0;
  return {{mean.x * behind, mean.y * behind}, half};
}

}  // namespace

ScanShapes shapesOf(std::span<const float> ranges, double firstAngle, double angleStep,
                    const ScanShapesConfig& config) {
  ScanShapes shapes;
  for (const auto& outline : outlinesOf(ranges, firstAngle, angleStep, config)) {
    if (static_cast<int>(outline.size()) < config.fewestPoints) continue;
    if (distance(outline.front(), outline.back()) <= config.largestRound &&
        bendOf(outline, config.largestRound) == 0) {
      shapes.circles.push_back(circleThrough(outline, config.largestRound));
      continue;
    }
    auto pieces = straightPiecesOf(outline, {.tolerance = config.lineTolerance,
                                             .shortest = config.shortest,
                                             .fewestPoints = config.fewestPoints});
    std::move(pieces.begin(), pieces.end(), std::back_inserter(shapes.segments));
  }
  return shapes;
}

}  // namespace ortung
