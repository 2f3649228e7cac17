#include "ortung/sim/TableStore.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include "ortung/sim/Learner.hpp"
#include "ortung/sim/RobotShape.hpp"

namespace ortung {
namespace {

/// A folder that nobody else has, gone with all in it at the end.
class OwnFolder {
 public:
  OwnFolder() : path_((std::filesystem::temp_directory_path() / "ortung-tables-XXXXXX").string()) {
    if (::mkdtemp(path_.data()) == nullptr)
      throw std::runtime_error(path_ + ": no folder can be made: " + std::strerror(errno));
  }
  ~OwnFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
  std::filesystem::path operator/(const char* name) const {
    return std::filesystem::path(path_) / name;
  }

 private:
  std::string path_;
};

/// All that decides what a robot learns in a world.
std::string keyOf(const SimRobot& robot) {
  const RobotSize size = sizeOf(robot.config());
  std::string key = std::to_string(size.radius) + " " + std::to_string(size.height);
  for (const auto& data : robot.container().all())
    if (data->localizes()) key += "\n" + toText(data->id()) + " " + data->learningKey();
  return key;
}

}  // namespace

std::shared_ptr<const RobotTables> TableStore::of(const SimRobot& robot, PluginFactory& factory) {
  const std::string key = keyOf(robot);
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const RobotTables>& tables = known_[key];
  if (!tables) tables = learnFor(robot.config(), factory);
  return tables;
}

std::shared_ptr<const RobotTables> TableStore::learnFor(const RobotConfig& robot,
                                                        PluginFactory& factory) const {
  const std::unique_ptr<SimWorld> world = readWorld(world_);
  const LearnOptions options{.cell = kCell};
  LearnArea area = learnArea(*world, options.cell, sizeOf(robot));
  const auto open = static_cast<std::size_t>(
      std::count(area.region.open.begin(), area.region.open.end(), std::uint8_t{1}));
  if (open > kMostCells)
    throw std::runtime_error(world_.string() + ": is too large to be learned on the way, with " +
                             std::to_string(open) + " cells, expected at most " +
                             std::to_string(kMostCells) +
                             "; let `ortung learn` do it, and give tables=FILE");
  SensorContainer container;
  const std::vector<Device> devices = fillContainer(container, robot, factory);
  learn(*world, area.region, devices, factory, options);
  TableInfo info;
  info.world = world->name();
  info.worldFingerprint = world->fingerprint();
  info.robot = robot.name;
  info.headingStep = options.headingStep;
  info.region = std::move(area.region);
  info.field = fieldModelOf(*world);
  const OwnFolder folder;  // what is mapped stays though its file goes
  const auto file = folder / "learned.tables";
  writeTables(file, container, info);
  return std::make_shared<const RobotTables>(file);
}

}  // namespace ortung
