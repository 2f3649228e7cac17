#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/motion/MotionModel.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/RobotTables.hpp"
#include "ortung/robot/TableInfo.hpp"

namespace ortung {

/// A robot as its file describes it: a container with its features, and their tables if it was
/// opened with some. The container is for many threads, as it says itself; all else for one.
struct Robot {
  PluginFactory factory{PluginFactory::standardFolders()};
  RobotConfig config;
  SensorContainer container;
  std::vector<Device> devices;  ///< point into config and container
  TableInfo tables;             ///< without tables: its region has no cells
};

/// Makes the features of a robot file, which learn or take readings, but can't weigh.
/// @throws ConfigError, PluginError
ORTUNG_API std::unique_ptr<Robot> openRobot(const std::filesystem::path& robotFile);
/// Makes the features of a robot file with the tables of another, so that they can weigh.
/// @throws ConfigError, PluginError, TableError
ORTUNG_API std::unique_ptr<Robot> openRobot(const std::filesystem::path& robotFile,
                                            const std::filesystem::path& tablesFile);

/// The same with tables that others have opened. @throws ConfigError, PluginError, TableError
ORTUNG_API std::unique_ptr<Robot> openRobot(const std::filesystem::path& robotFile,
                                            const RobotTables& tables);

/// The robot that tables were learned for, by the text of its file that they hold; null if they
/// hold none. @throws ConfigError, PluginError, TableError
ORTUNG_API std::unique_ptr<Robot> openLearnedRobot(const std::filesystem::path& tablesFile);

/// The motion model that [motion] of a robot file asks for; "odometry" if that names no plugin.
/// @throws ConfigError, PluginError
ORTUNG_API std::unique_ptr<MotionModel> makeMotion(const Parameters& motion,
                                                   PluginFactory& factory);

/// [motion] of a robot file or of a file of its own, such as `ortung learn-motion` writes.
/// @throws ConfigError
ORTUNG_API Parameters readMotionFile(const std::filesystem::path& file);

}  // namespace ortung
