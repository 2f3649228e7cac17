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

/// The tables of robots in one world, which are learned when they are first needed and kept in
/// memory, for any number of simulations of that world and robots with the same sensors.
/// Thread-safe; callers wait while another one learns.
class ORTUNG_API TableStore {
 public:
  /// Edge length of a cell [m]: half the default of `ortung learn`, since MCL's error grows with
  /// it.
  static constexpr double kCell = 0.05;
  /// Largest number of open cells that are learned while a run waits.
  static constexpr std::size_t kMostCells = 500'000;

  /// @param world the world file
  /// @param cell edge of a cell [m]
  explicit TableStore(std::filesystem::path world, double cell = kCell)
      : world_(std::move(world)), cell_(cell) {}

  /// Returns the tables of a robot, as `ortung learn --cell 0.05` learns them.
  /// @throws std::runtime_error for a world that is too large; ConfigError, PluginError, TableError
  std::shared_ptr<const RobotTables> of(const SimRobot& robot, PluginFactory& factory);
  /// Returns the same for a robot that need not be simulated.
  /// @param container the robot's features
  /// @param goOn called many times a second with the share that is learned; if it returns false,
  ///   learning is given up and null is returned
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
  bool isLearning_ = false;  ///< whether a caller is learning
  double share_ = 0.0;       ///< share that it has learned, in [0, 1]
  /// Tables by robot size and features.
  std::map<std::string, std::shared_ptr<const RobotTables>> known_;
};

}  // namespace ortung
