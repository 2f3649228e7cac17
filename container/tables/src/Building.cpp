#include "ortung/tables/Building.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace ortung {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::invalid_argument("building: " + what);
}

}  // namespace

std::size_t Building::floorAt(double x) const {
  const auto above =
      std::upper_bound(floors.begin(), floors.end(), x,
                       [](double place, const Floor& floor) { return place < floor.xLow; });
  return above == floors.begin() ? 0 : static_cast<std::size_t>(above - floors.begin()) - 1;
}

std::optional<std::size_t> Building::find(const std::string& name) const {
  const auto found = std::find_if(floors.begin(), floors.end(),
                                  [&](const Floor& floor) { return floor.name == name; });
  if (found == floors.end()) return std::nullopt;
  return static_cast<std::size_t>(found - floors.begin());
}

void Building::check() const {
  std::set<std::string> names;
  for (std::size_t i = 0; i < floors.size(); ++i) {
    const Floor& floor = floors[i];
    if (floor.name.empty() || !names.insert(floor.name).second)
      fail("floor " + std::to_string(i) + " is named '" + floor.name +
           "', expected a name that no other one has");
    const bool follows = i == 0 || floor.xLow == floors[i - 1].xHigh;
    if (!std::isfinite(floor.shift) || !std::isfinite(floor.xLow) || !std::isfinite(floor.xHigh) ||
        !(floor.xLow < floor.xHigh) || !follows)
      fail("the strip of floor '" + floor.name + "' is from " + std::to_string(floor.xLow) +
           " m to " + std::to_string(floor.xHigh) + " m, expected it to follow the one before");
  }
  names.clear();
  for (const Lift& lift : lifts) {
    if (lift.name.empty() || !names.insert(lift.name).second)
      fail("a lift is named '" + lift.name + "', expected a name that no other one has");
    if (!(lift.radius > 0.0) || !std::isfinite(lift.radius))
      fail("lift '" + lift.name + "' has a radius of " + std::to_string(lift.radius) +
           " m, expected a positive one");
    if (lift.stops.size() < 2)
      fail("lift '" + lift.name + "' stops at " + std::to_string(lift.stops.size()) +
           " floors, expected two or more");
    std::set<std::size_t> stops;
    for (const LiftStop& stop : lift.stops) {
      if (stop.floor >= floors.size())
        fail("lift '" + lift.name + "' stops at floor " + std::to_string(stop.floor) +
             ", expected one of " + std::to_string(floors.size()));
      const std::string& floor = floors[stop.floor].name;
      if (!stops.insert(stop.floor).second)
        fail("lift '" + lift.name + "' stops twice on floor '" + floor + "', expected once");
      if (!isFinite(stop.pose) || floorAt(stop.pose.x) != stop.floor)
        fail("lift '" + lift.name + "' is at x = " + std::to_string(stop.pose.x) +
             " m of the field, expected it on floor '" + floor + "'");
    }
  }
}

}  // namespace ortung
