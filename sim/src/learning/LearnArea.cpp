#include <stdexcept>
#include <string>

#include "FloorParts.hpp"
#include "ortung/sim/Learner.hpp"

namespace ortung {
namespace {

/// Returns the part of the field in which a point lies. @throws std::invalid_argument if there is
/// none
std::size_t partAround(const std::array<double, 2>& point, const FieldParts& parts) {
  const auto found = parts.partAt(point[0], point[1]);
  if (!found || parts.parts()[*found].cells == 0)
    throw std::invalid_argument("there is no room for the robot around (" +
                                std::to_string(point[0]) + ", " + std::to_string(point[1]) + ") m");
  return *found;
}

}  // namespace

LearnArea learnArea(const SimWorld& world, double cell, const RobotSize& robot,
                    const std::optional<std::array<double, 2>>& inside) {
  const FieldRegion whole = world.region(cell, robot);
  whole.check();
  const FieldParts parts = floorParts(world, whole, robot);
  const std::size_t part = inside ? partAround(*inside, parts) : mainPart(world, parts);
  LearnArea area{parts.only(part), 0.0};
  for (std::size_t i = 0; i < whole.standable.size(); ++i)
    area.leftOut += whole.standable[i] != area.region.standable[i] ? cell * cell : 0.0;
  return area;
}

}  // namespace ortung
