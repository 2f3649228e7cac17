#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/robot/RobotTables.hpp"
#include "ortung/sim/SimRobot.hpp"

namespace ortung {

/// What robots of one world learn, when they are first asked for it: tables in memory, for any
/// number of simulations of that world and robots with the same sensors. Thread-safe; who asks
/// while others learn waits.
class ORTUNG_API TableStore {
 public:
  /// Edge of a cell [m]: half of what `ortung learn` takes, since MCL's error goes with it.
  static constexpr double kCell = 0.05;
  /// More open cells are not learned on the way.
  static constexpr std::size_t kMostCells = 500'000;

  /// @param world its file
  /// @param cell edge of a cell [m]
  explicit TableStore(std::filesystem::path world, double cell = kCell)
      : world_(std::move(world)), cell_(cell) {}

  /// As `ortung learn --cell 0.05` learns them.
  /// @throws std::runtime_error for a world that is too large; ConfigError, PluginError, TableError
  std::shared_ptr<const RobotTables> of(const SimRobot& robot, PluginFactory& factory);
  /// The same for a robot that need not be simulated.
  /// @param container with its features
  /// @param goOn asked many times a second, with the share that is learned; false: gives up, with
  ///   null
  std::shared_ptr<const RobotTables> of(const RobotConfig& robot, const SensorContainer& container,
                                        PluginFactory& factory,
                                        const std::function<bool(double)>& goOn = {});

 private:
  std::shared_ptr<const RobotTables> learnFor(const RobotConfig& robot, PluginFactory& factory,
                                              const std::function<bool(double)>& goOn);

  std::filesystem::path world_;
  double cell_;
  std::mutex mutex_;
  std::condition_variable done_;
  bool isLearning_ = false;                                          ///< somebody
  double share_ = 0.0;                                               ///< of what he learns
  std::map<std::string, std::shared_ptr<const RobotTables>> known_;  ///< by what was learned
};

}  // namespace ortung
