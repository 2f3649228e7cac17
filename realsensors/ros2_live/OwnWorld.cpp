#include "OwnWorld.hpp"

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "GridMap.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {
namespace {

/// Returns the file of a table's map, relative to the world's; "" if it names none.
std::filesystem::path mapOf(const Parameters& table, const std::filesystem::path& world) {
  const std::string name = table.textOr("map", "");
  return name.empty() ? std::filesystem::path() : world.parent_path() / name;
}

std::int8_t occupancyOf(GridCell cell) {
  constexpr std::int8_t kFull = 100;
  if (cell == GridCell::kOccupied) return kFull;
  return cell == GridCell::kFree ? 0 : -1;
}

}  // namespace

const OwnWorld::Map* OwnWorld::mapOf(const std::string& floor) const {
  if (maps.empty()) return nullptr;
  auto found =
      std::find_if(maps.begin(), maps.end(), [&](const Map& one) { return one.floor == floor; });
  if (found == maps.end()) found = maps.begin();
  return found->file.empty() ? nullptr : &*found;
}

const OwnWorld::Map* OwnWorld::find(const std::string& nameOrPath) const {
  const auto isMeant = [&](const Map& one) {
    if (!one.floor.empty() && one.floor == nameOrPath) return true;
    std::error_code error;  // files that are not there are not the same
    return !one.file.empty() && std::filesystem::equivalent(one.file, nameOrPath, error);
  };
  const auto found = std::find_if(maps.begin(), maps.end(), isMeant);
  return found == maps.end() ? nullptr : &*found;
}

void OwnWorld::checkFloors(const Building& learned) const {
  std::vector<std::string> here;
  for (const Map& map : maps)
    if (!map.floor.empty()) here.push_back(map.floor);
  std::vector<std::string> there;
  for (const Floor& floor : learned.floors) there.push_back(floor.name);
  if (here == there) return;
  const auto text = [](const std::vector<std::string>& floors) {
    std::string all;
    for (const std::string& floor : floors) all += (all.empty() ? "" : ", ") + floor;
    return all.empty() ? std::string("none") : all;
  };
  throw std::runtime_error("the tables have the floors " + text(there) + ", expected those of " +
                           file.string() + ": " + text(here));
}

OwnWorld readOwnWorld(const std::filesystem::path& file) {
  const Parameters toml = readToml(file);
  OwnWorld world{file, {}};
  const auto grids = toml.tables("grid");
  for (const Parameters& table : toml.tables("floor")) {
    OwnWorld::Map map{table.text("name"), mapOf(table, file)};
    for (const Parameters& grid : grids)
      if (map.file.empty() && grid.textOr("floor", "") == map.floor) map.file = mapOf(grid, file);
    world.maps.push_back(std::move(map));
  }
  if (world.maps.empty() && grids.size() == 1)
    world.maps.push_back({"", mapOf(grids.front(), file)});
  return world;
}

OccupancyGrid readOccupancyGrid(const std::filesystem::path& map, const std::string& frame,
                                std::int64_t stamp) {
  const GridMap grid = readGridMap(map);
  OccupancyGrid told;
  told.header = {stamp, frame};
  told.mapLoadTime = stamp;
  told.resolution = static_cast<float>(grid.cell);
  told.width = static_cast<std::uint32_t>(grid.columns);
  told.height = static_cast<std::uint32_t>(grid.rows);
  told.origin = fromPose2({grid.originX, grid.originY, grid.yaw});
  told.data.reserve(grid.cells.size());
  for (const GridCell cell : grid.cells) told.data.push_back(occupancyOf(cell));
  return told;
}

}  // namespace ortung::ros2
