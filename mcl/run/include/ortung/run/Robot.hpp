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
/// opened with some. Many threads may use the container (see there), only one the rest.
struct Robot {
  PluginFactory factory{PluginFactory::standardFolders()};
  RobotConfig config;
  SensorContainer container;
  std::vector<Device> devices;  ///< devices, which point into config and container
  TableInfo tables;  ///< description of the tables; without tables its region has no cells
};

/// Makes the features of a robot file, which learn or take readings, but can't weigh.
/// @throws ConfigError, PluginError
ORTUNG_API std::unique_ptr<Robot> openRobot(const std::filesystem::path& robotFile);
/// Makes the features of a robot file with the tables of another, so that they can weigh.
/// @throws ConfigError, PluginError, TableError
ORTUNG_API std::unique_ptr<Robot> openRobot(const std::filesystem::path& robotFile,
                                            const std::filesystem::path& tablesFile);

/// The same with tables that the caller has opened. @throws ConfigError, PluginError, TableError
ORTUNG_API std::unique_ptr<Robot> openRobot(const std::filesystem::path& robotFile,
                                            const RobotTables& tables);

/// Makes the robot that tables were learned for, from the text of its file that they hold; returns
/// null if they hold none. @throws ConfigError, PluginError, TableError
ORTUNG_API std::unique_ptr<Robot> openLearnedRobot(const std::filesystem::path& tablesFile);

/// Makes the motion model that [motion] of a robot file names; "odometry" if it names no plugin.
/// @throws ConfigError, PluginError
ORTUNG_API std::unique_ptr<MotionModel> makeMotion(const Parameters& motion,
                                                   PluginFactory& factory);

/// Reads [motion] from a robot file, or from a file of its own as `ortung learn-motion` writes it.
/// @throws ConfigError
ORTUNG_API Parameters readMotionFile(const std::filesystem::path& file);

}  // namespace ortung
