#include "ortung/sim/TableStore.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <system_error>

#include "ortung/sim/Learner.hpp"
#include "ortung/sim/RobotShape.hpp"

namespace ortung {
namespace {

/// A temporary folder of its own, which is removed with its content at the end.
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

/// Returns everything that determines what a robot learns in a world.
std::string keyOf(const RobotConfig& robot, const SensorContainer& container) {
  const RobotSize size = sizeOf(robot);
  std::string key = std::to_string(size.radius) + " " + std::to_string(size.height);
  for (const auto& data : container.all())
    if (data->localizes()) key += "\n" + toText(data->id()) + " " + data->learningKey();
  return key;
}

}  // namespace

std::shared_ptr<const RobotTables> TableStore::of(const SimRobot& robot, PluginFactory& factory) {
  return of(robot.config(), robot.container(), factory);
}

std::shared_ptr<const RobotTables> TableStore::of(const RobotConfig& robot,
                                                  const SensorContainer& container,
                                                  PluginFactory& factory,
                                                  const std::function<bool(double)>& goOn) {
  constexpr std::chrono::milliseconds kLook{20};
  const std::string key = keyOf(robot, container);
  std::unique_lock lock(mutex_);
  while (!known_.contains(key) && isLearning_) {
    const double share = share_;
    lock.unlock();
    if (goOn && !goOn(share)) return nullptr;
    lock.lock();
    done_.wait_for(lock, kLook, [this] { return !isLearning_; });
  }
  if (const auto found = known_.find(key); found != known_.end()) return found->second;
  isLearning_ = true;
  share_ = 0.0;
  lock.unlock();
  std::shared_ptr<const RobotTables> tables;
  std::exception_ptr failure;
  try {
    tables = learnFor(robot, factory, goOn);
  } catch (...) {
    failure = std::current_exception();
  }
  lock.lock();
  isLearning_ = false;
  if (tables) known_[key] = tables;
  done_.notify_all();
  if (failure) std::rethrow_exception(failure);
  return tables;
}

std::shared_ptr<const RobotTables> TableStore::learnFor(const RobotConfig& robot,
                                                        PluginFactory& factory,
                                                        const std::function<bool(double)>& goOn) {
  const std::unique_ptr<SimWorld> world = readWorld(world_);
  const LearnOptions options{.cell = cell_};
  LearnArea area = learnArea(*world, options.cell, sizeOf(robot));
  const auto open = static_cast<std::size_t>(
      std::count(area.region.open.begin(), area.region.open.end(), std::uint8_t{1}));
  if (open > kMostCells)
    throw std::runtime_error(
        world_.string() + ": is too large to be learned during a run, with " +
        std::to_string(open) + " cells, expected at most " + std::to_string(kMostCells) +
        "; let `ortung learn` do it, and give its file (tables=FILE, --tables FILE)");
  SensorContainer container;
  const std::vector<Device> devices = fillContainer(container, robot, factory);
  Learner learner(*world, area.region, devices, {}, factory, options);
  while (learner.step()) {
    {
      const std::lock_guard lock(mutex_);
      share_ = learner.share();
    }
    if (goOn && !goOn(learner.share())) return nullptr;
  }
  TableInfo info;
  info.world = world->name();
  info.worldFingerprint = world->fingerprint();
  info.robot = robot.name;
  info.headingStep = options.headingStep;
  info.region = std::move(area.region);
  info.field = fieldModelOf(*world);
  const OwnFolder folder;  // mapped memory stays valid when its file is removed
  const auto file = folder / "learned.tables";
  writeTables(file, container, info);
  return std::make_shared<const RobotTables>(file);
}

}  // namespace ortung
