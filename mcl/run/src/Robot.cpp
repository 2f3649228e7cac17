#include "ortung/run/Robot.hpp"

#include "CheckedMotion.hpp"
#include "ortung/base/FileKind.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung {

std::unique_ptr<Robot> openRobot(const std::filesystem::path& robotFile) {
  auto robot = std::make_unique<Robot>();
  robot->config = readRobot(robotFile);
  robot->devices = fillContainer(robot->container, robot->config, robot->factory);
  return robot;
}

std::unique_ptr<Robot> openRobot(const std::filesystem::path& robotFile,
                                 const std::filesystem::path& tablesFile) {
  std::unique_ptr<Robot> robot = openRobot(robotFile);
  robot->tables = loadTables(std::make_shared<const TableFile>(tablesFile), robot->container);
  return robot;
}

std::unique_ptr<Robot> openRobot(const std::filesystem::path& robotFile,
                                 const RobotTables& tables) {
  std::unique_ptr<Robot> robot = openRobot(robotFile);
  tables.giveTo(robot->container);
  robot->tables = tables.info();
  return robot;
}

std::unique_ptr<Robot> openLearnedRobot(const std::filesystem::path& tablesFile) {
  const auto tables = std::make_shared<const TableFile>(tablesFile);
  const TableInfo info = readTableInfo(*tables);
  if (info.robotToml.empty()) return nullptr;
  auto robot = std::make_unique<Robot>();
  robot->config = readRobot(parseToml(info.robotToml, tablesFile.string() + ": robot file"));
  robot->devices = fillContainer(robot->container, robot->config, robot->factory);
  robot->tables = loadTables(tables, robot->container);
  return robot;
}

std::unique_ptr<MotionModel> makeMotion(const Parameters& motion, PluginFactory& factory) {
  const std::string plugin = motion.textOr("plugin", "odometry");
  return std::make_unique<CheckedMotion>(factory.make<MotionModel>(plugin, motion), plugin);
}

Parameters readMotionFile(const std::filesystem::path& file) {
  const std::string other = whatItIs(file, {FileKind::kRobot, FileKind::kMotion});
  if (!other.empty()) throw ConfigError(file.string() + ": is no file with [motion]" + other);
  const Parameters parameters = readToml(file);
  if (!parameters.has("motion")) {
    throw ConfigError(file.string() +
                      ": has no table [motion], expected one as in a robot file or as "
                      "`ortung learn-motion` writes it");
  }
  return parameters.table("motion");
}

}  // namespace ortung
