#include "BuildingFile.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>

#include "PrimitiveFile.hpp"
#include "ReadTables.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMostFloors = 256;
constexpr std::size_t kMostStops = 4096;
/// Least distance between what stands on one floor and on the next [m]. Samples that are spread
/// while nothing says how the robot moves stay on their floor, and no cluster spans two.
constexpr double kGap = 10.0;

class Extent {
 public:
  void add(const Box2& box) {
    if (!box_) box_ = box;
    box_ = {std::min(box_->xLow, box.xLow), std::max(box_->xHigh, box.xHigh),
            std::min(box_->yLow, box.yLow), std::max(box_->yHigh, box.yHigh)};
  }
  const std::optional<Box2>& box() const { return box_; }

 private:
  std::optional<Box2> box_;
};

/// Moves all of a floor along x [m].
void shift(WorldModel& floor, double by) {
  for (auto* primitives : {&floor.primitives, &floor.movables}) {
    for (Primitive& primitive : *primitives) {
      primitive.centre.x += by;
      for (Point2& corner : primitive.corners) corner.x += by;
    }
  }
  for (GridBody& body : floor.grids) body.map.originX += by;
  for (Landmark& mark : floor.landmarks) mark.x += by;
}

/// Says that a lift is not within what stands on a floor.
std::string outsideText(const std::string& lift, const std::vector<double>& position,
                        const Floor& floor, const Box2& box) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << "lift '" << lift << "' is at (" << position[0]
       << ", " << position[1] << ") m of floor '" << floor.name << "', expected x from "
       << box.xLow - floor.shift << " to " << box.xHigh - floor.shift << " and y from " << box.yLow
       << " to " << box.yHigh;
  return text.str();
}

template <class T>
void append(std::vector<T>& from, std::vector<T>& to) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

}  // namespace

std::optional<Box2> extentOf(const WorldModel& world) {
  Extent extent;
  for (const Primitive& primitive : world.primitives) extent.add(boundsOf(primitive));
  for (const GridBody& body : world.grids) extent.add(body.map.bounds());
  for (const Landmark& mark : world.landmarks) extent.add({mark.x, mark.x, mark.y, mark.y});
  if (!extent.box())
    for (const Primitive& movable : world.movables) extent.add(boundsOf(movable));
  return extent.box();
}

BuildingFile::BuildingFile(const Parameters& toml)
    : toml_(toml), tables_(readTables(toml, "floor", kMostFloors)) {
  for (const Parameters& table : tables_) {
    const std::string name = table.text("name");
    if (!isWord(name)) table.fail("name", "must be of [A-Za-z0-9_-]{1,64}");
    if (std::find(names_.begin(), names_.end(), name) != names_.end())
      table.fail("name", "is \"" + name + "\", as another floor's is");
    names_.push_back(name);
  }
  floors_.resize(std::max<std::size_t>(1, tables_.size()));
}

std::size_t BuildingFile::indexOf(const Parameters& table) const {
  const std::string name = table.text("floor");
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found != names_.end()) return static_cast<std::size_t>(found - names_.begin());
  std::string all;
  for (const std::string& one : names_) all += (all.empty() ? "" : ", ") + one;
  table.fail("floor", "is \"" + name + "\", expected one of " + all);
}

WorldModel& BuildingFile::floorOf(const Parameters& table) {
  return tables_.empty() ? floors_.front() : floors_[indexOf(table)];
}

void BuildingFile::moveInto(WorldModel& world) {
  double end = 0.0;  // of the floor before [m]
  Building& building = world.building;
  for (std::size_t i = 0; i < floors_.size(); ++i) {
    WorldModel& part = floors_[i];
    if (!tables_.empty()) {
      const std::optional<Box2> box = extentOf(part);
      if (!box)
        tables_[i].fail("map",
                        "is missing, and nothing else is on this floor, expected a map or "
                        "something with floor = \"" +
                            names_[i] + "\"");
      // Whole metres, so that the cells of tables lie alike on all floors.
      const double by = i == 0 ? 0.0 : std::ceil(end + kGap - box->xLow);
      shift(part, by);
      end = box->xHigh + by;
      building.floors.push_back({names_[i], by, box->xLow + by - kGap / 2.0, end + kGap / 2.0});
      if (i > 0) building.floors[i - 1].xHigh = building.floors[i].xLow;
      world.floorBounds.push_back({box->xLow + by, end, box->yLow, box->yHigh});
    }
    append(part.primitives, world.primitives);
    append(part.movables, world.movables);
    append(part.grids, world.grids);
    append(part.landmarks, world.landmarks);
  }
  readLifts(building, world.floorBounds);
}

/// Reads the stops of lifts: one on the floor that a table names, or one on each. Tables of the
/// same name are one lift.
void BuildingFile::readLifts(Building& building, const std::vector<Box2>& bounds) const {
  if (tables_.empty()) return;  // [[lift]] is refused as a key that nobody has read
  std::optional<Parameters> last;
  for (const Parameters& table : readTables(toml_, "lift", kMostStops)) {
    const std::string name = table.text("name");
    if (!isWord(name)) table.fail("name", "must be of [A-Za-z0-9_-]{1,64}");
    const auto position = table.numbers("position_m", 2, kCoordinate);
    const double heading = radians(table.numberOr("heading_deg", 0.0, {-360.0, 360.0}));
    const double radius = table.numberOr("radius_m", 1.0, {0.1, 20.0});
    auto lift = std::find_if(building.lifts.begin(), building.lifts.end(),
                             [&](const Lift& one) { return one.name == name; });
    if (lift == building.lifts.end()) lift = building.lifts.insert(lift, {name, radius, {}});
    if (lift->radius != radius) table.fail("radius_m", "is not that of the lift's other stops");
    const bool isEverywhere = !table.has("floor");
    const std::size_t first = isEverywhere ? 0 : indexOf(table);
    const std::size_t end = isEverywhere ? tables_.size() : first + 1;
    for (std::size_t i = first; i < end; ++i) {
      const Pose2 pose = building.floors[i].toField({position[0], position[1], wrapAngle(heading)});
      const Box2& box = bounds[i];
      if (pose.x < box.xLow || pose.x > box.xHigh || pose.y < box.yLow || pose.y > box.yHigh)
        table.fail("position_m", outsideText(name, position, building.floors[i], box));
      lift->stops.push_back({i, pose});
    }
    last = table;
  }
  try {
    building.check();
  } catch (const std::invalid_argument& error) {
    throw ConfigError((last ? last->where() : toml_.where()) + ": " + error.what());
  }
}

}  // namespace ortung
