#include "ortung/base/StraightPieces.hpp"

#include <algorithm>

namespace ortung {
namespace {

using Points = std::span<const PlanePoint>;

/// Fits a line to the points by total least squares, between the projections of the first and the
/// last one.
StraightPiece lineThrough(Points points) {
  double x = 0.0;
  double y = 0.0;
  for (const PlanePoint& p : points) {
    x += p.x;
    y += p.y;
  }
  x /= static_cast<double>(points.size());
  y /= static_cast<double>(points.size());
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (const PlanePoint& p : points) {
    xx += (p.x - x) * (p.x - x);
    xy += (p.x - x) * (p.y - y);
    yy += (p.y - y) * (p.y - y);
  }
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const auto foot = [&](const PlanePoint& p) {
    const double along = (p.x - x) * c + (p.y - y) * s;
    return PlanePoint{x + along * c, y + along * s};
  };
  return {foot(points.front()), foot(points.back()), {points.begin(), points.end()}};
}

}  // namespace

std::size_t bendOf(Points points, double tolerance) {
  const PlanePoint& a = points.front();
  const PlanePoint& b = points.back();
  const double length = distance(a, b);
  double reach = 0.0;
  for (const PlanePoint& p : points) reach = std::max(reach, distance(a, p));
  const bool comesBack = reach > 4.0 * length;
  double most = tolerance;
  std::size_t where = 0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const PlanePoint& p = points[i];
    const double across = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    const double off = comesBack ? distance(a, p) : std::abs(across) / length;
    if (off > most) {
      most = off;
      where = i;
    }
  }
  return where;
}

std::vector<StraightPiece> straightPiecesOf(Points outline, const StraightPiecesConfig& config) {
  std::vector<StraightPiece> pieces;
  std::vector<Points> rest{outline};
  while (!rest.empty()) {
    const Points piece = rest.back();
    rest.pop_back();
    if (piece.size() < 2) continue;
    if (const std::size_t where = bendOf(piece, config.tolerance); where > 0) {
      rest.push_back(piece.subspan(where));
      rest.push_back(piece.first(where + 1));
      continue;
    }
    if (static_cast<int>(piece.size()) < config.fewestPoints) continue;
    if (distance(piece.front(), piece.back()) < config.shortest) continue;
    pieces.push_back(lineThrough(piece));
  }
  return pieces;
}

}  // namespace ortung
