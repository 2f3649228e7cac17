// Where a grid lies in the field.
#include <algorithm>
#include <cmath>

#include "GridMap.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {

void GridMap::turnTo(double direction) {
  constexpr double kStraight = 1e-9;  // [rad]
  const double turn = wrapAngle(direction);
  yaw = std::abs(turn) <= kStraight ? 0.0 : turn;
  cosine = std::cos(yaw);
  sine = std::sin(yaw);
}

Point2 GridMap::toField(const Point2& straight) const {
  if (!isTurned()) return straight;
  const double x = straight.x - originX;
  const double y = straight.y - originY;
  return {originX + cosine * x - sine * y, originY + sine * x + cosine * y};
}

Point2 GridMap::toGrid(const Point2& inField) const {
  if (!isTurned()) return inField;
  const double x = inField.x - originX;
  const double y = inField.y - originY;
  return {originX + cosine * x + sine * y, originY - sine * x + cosine * y};
}

Box2 GridMap::bounds() const {
  const double right = originX + columns * cell;
  const double top = originY + rows * cell;
  Box2 box{originX, originX, originY, originY};
  for (const Point2& straight : {Point2{right, originY}, {right, top}, {originX, top}}) {
    const Point2 corner = toField(straight);
    box = {std::min(box.xLow, corner.x), std::max(box.xHigh, corner.x),
           std::min(box.yLow, corner.y), std::max(box.yHigh, corner.y)};
  }
  return box;
}

}  // namespace ortung
