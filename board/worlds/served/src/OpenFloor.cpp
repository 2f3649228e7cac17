#include "ortung/served/OpenFloor.hpp"

#include <algorithm>
#include <cmath>

namespace ortung {

FieldRegion openFloor(const SimWorld& world) {
  constexpr double kCell = 0.05;        // [m]
  constexpr double kMost = 200'000;     // cells
  constexpr RobotSize kLow{0.05, 0.3};  // what stands on the floor is as high as a scanner looks
  const Box2 bounds = world.solids().bounds;
  const double area = (bounds.xHigh - bounds.xLow) * (bounds.yHigh - bounds.yLow);
  return world.region(std::max(kCell, std::sqrt(area / kMost)), kLow);
}

}  // namespace ortung
