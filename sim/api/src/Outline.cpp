#include <algorithm>
#include <cmath>

#include "ortung/base/Angles.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {
namespace {

/// Returns twice the signed area, positive if the corners are in counter-clockwise order.
double winding(const std::array<FloorPoint, 3>& c) {
  return (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[1].y - c[0].y) * (c[2].x - c[0].x);
}

}  // namespace

std::vector<FloorPoint> outlineOf(const WorldObject& object, const WorldPiece& piece, int corners) {
  std::vector<FloorPoint> outline;
  const auto add = [&](const Pose2& frame, double x, double y) {
    const Pose2 point = frame * Pose2{x, y, 0.0};
    outline.push_back({point.x, point.y});
  };
  if (piece.shape == WorldPiece::Shape::kTriangle) {
    for (const FloorPoint& corner : piece.corners) add(object.pose, corner.x, corner.y);
    if (winding(piece.corners) < 0.0) std::reverse(outline.begin(), outline.end());
    return outline;
  }
  const Pose2 frame = object.pose * piece.pose;
  if (piece.shape == WorldPiece::Shape::kRectangle) {
    add(frame, -piece.halfX, -piece.halfY);
    add(frame, piece.halfX, -piece.halfY);
    add(frame, piece.halfX, piece.halfY);
    add(frame, -piece.halfX, piece.halfY);
    return outline;
  }
  corners = std::max(corners, 3);
  for (int i = 0; i < corners; ++i) {
    const double angle = kTurn * i / corners;
    add(frame, piece.halfX * std::cos(angle), piece.halfY * std::sin(angle));
  }
  return outline;
}

}  // namespace ortung
