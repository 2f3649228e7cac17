#include "Check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "Console.hpp"
#include "Doubts.hpp"
#include "Interrupt.hpp"
#include "Schema.hpp"
#include "SensorsText.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/FileKind.hpp"
#include "ortung/base/InputFile.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/records/RecordEnd.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/robot/TableInfo.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/run/Localization.hpp"
#include "ortung/run/Robot.hpp"
#include "ortung/sim/Learner.hpp"
#include "ortung/sim/RobotShape.hpp"
#include "ortung/sim/SceneRun.hpp"
#include "ortung/sim_api/Drive.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

/// Recognizes the kind of a file by its content.
FileKind kindOf(const fs::path& file) {
  std::string why;
  if (const std::ifstream in = openInput(file, why); !in)
    throw std::runtime_error(file.string() + ": " + why);
  if (isGridMap(file)) return FileKind::kMapServer;
  const FileKind kind = kindOfFile(file);
  if (kind != FileKind::kUnknown && kind != FileKind::kMotion) return kind;
  const Parameters toml = readToml(file);
  if (toml.has("scene")) return FileKind::kScene;
  return toml.has("sensor") ? FileKind::kRobot : FileKind::kWorld;
}

std::size_t countOf(const std::vector<std::uint8_t>& mask) {
  return mask.size() - static_cast<std::size_t>(std::count(mask.begin(), mask.end(), 0));
}

std::string bounds(const FieldGrid& grid) {
  return fmt::format("x {:g} to {:g} m, y {:g} to {:g} m", grid.originX,
                     grid.originX + grid.columns * grid.cell, grid.originY,
                     grid.originY + grid.rows * grid.cell);
}

std::string landmarksOf(const SimWorld& world) {
  std::map<std::string, std::size_t> kinds;
  for (const Landmark& landmark : world.landmarks()) ++kinds[landmark.kind];
  if (kinds.empty()) return "no landmarks";
  std::string text;
  for (const auto& [kind, count] : kinds) {
    text += fmt::format("{}{} {}", text.empty() ? "landmarks: " : ", ", count, kind);
  }
  return text;
}

/// Prints the floors of a building, and where poses on them are in the field.
void printBuilding(const Building& building) {
  for (const Floor& floor : building.floors)
    fmt::print("  floor '{}': x from {:g} to {:g} m, its map's x plus {:g} m\n",
               printable(floor.name), floor.xLow, floor.xHigh, floor.shift);
  for (const Lift& lift : building.lifts) {
    std::string stops;
    for (const LiftStop& stop : lift.stops)
      stops += (stops.empty() ? "" : ", ") + building.floors[stop.floor].name;
    fmt::print("  lift '{}': stops at {}\n", printable(lift.name), printable(stops));
  }
}

void checkWorldFile(const fs::path& file, const CheckArguments& arguments) {
  constexpr double kCell = 0.1;  // default of `ortung learn` [m]
  const RobotSize size = arguments.robot.empty() ? RobotSize{RobotConfig().radius}
                                                 : sizeOf(readRobot(arguments.robot));
  const std::unique_ptr<SimWorld> world = readWorld(file);
  const FieldRegion region = world->region(kCell, size);
  fmt::print(
      "{}: world '{}', fingerprint {}\n  {}\n  {} x {} cells of {} m, {} open, {} where a robot "
      "of radius {:g} m and height {:g} m can stand\n  {}\n",
      printable(file.string()), printable(world->name()), world->fingerprint(), bounds(region.grid),
      region.grid.columns, region.grid.rows, kCell, countOf(region.open), countOf(region.standable),
      size.radius, size.height, printable(landmarksOf(*world)));
  printBuilding(region.building);
  if (countOf(region.standable) == 0) return;
  const double leftOut = learnArea(*world, kCell, size).leftOut;
  if (leftOut > 0.0)
    fmt::print("  {:.1f} m^2 of that are separated by walls from the robot's area\n", leftOut);
}

void checkSceneFile(const fs::path& file) {
  const Scene scene = Scene::read(file);
  PluginFactory factory(PluginFactory::standardFolders());
  const SceneRun run(scene, {}, factory);
  fmt::print("{}: scene in the world '{}', {} robots, {} commands\n", printable(file.string()),
             printable(run.simulation().world().name()), scene.robots.size(),
             scene.commands.size());
}

/// Prints how the simulator sees a robot.
void checkSimulated(Robot& robot) {
  const RobotShape shape = RobotShape::read(robot.config);
  const std::string plugin = robot.config.drive.textOr("plugin", "differential");
  const auto drive = robot.factory.make<Drive>(plugin, robot.config.drive);
  fmt::print("  drive '{}', commands {}; {:g} kg, {} pieces, {} manipulators\n", printable(plugin),
             drive->commandHelp(), shape.mass, shape.pieces.size(), shape.manipulators.size());
}

/// Prints what the words of each feature's readings are, on the wire and in records.
void printWire(const Robot& robot) {
  for (const auto& feature : robot.container.all()) {
    fmt::print("  {:<40} {}{}\n", toText(feature->id()), feature->localizes() ? "localizes; " : "",
               printable(feature->wordsHelp()));
    fmt::print("  {:<40} format {}\n", "", feature->format().toText());
  }
}

void checkRobotFile(const fs::path& file, const CheckArguments& arguments) {
  const std::unique_ptr<Robot> robot = openRobot(file);
  MclConfig::read(robot->config.mcl).check();
  makeMotion(robot->config.motion, robot->factory);
  fmt::print("{}: robot '{}', radius {:g} m, {} sensors, {} features\n", printable(file.string()),
             printable(robot->config.name), robot->config.radius, robot->devices.size(),
             robot->container.all().size());
  checkSimulated(*robot);
  if (arguments.wire) return printWire(*robot);
  fmt::print("{}", describeSensors(*robot));
}

/// Loads tables as a localization does.
void checkAsLoaded(const fs::path& file, const CheckArguments& arguments) {
  LocalizationConfig config;
  config.tables = file;
  if (!arguments.robot.empty()) {
    Localization(openRobot(arguments.robot, file), nullptr, config);
  } else if (auto robot = openLearnedRobot(file)) {
    // [motion] is not part of the tables, and may name files beside the robot file.
    config.motion.emplace(file.string());
    Localization(std::move(robot), nullptr, config);
  } else {
    warn(
        file.string() +
        ": was learned by a version that did not store the robot file, so whether a robot can load "
        "it is not checked; --robot does");
  }
}

void checkTables(const fs::path& file, const CheckArguments& arguments) {
  const auto tables = std::make_shared<const TableFile>(file);
  const TableInfo info = readTableInfo(*tables);
  if (!arguments.world.empty()) {
    const std::string fingerprint = readWorld(arguments.world)->fingerprint();
    if (fingerprint != info.worldFingerprint) {
      throw std::runtime_error(fmt::format(
          "{}: was learned in the world {} ('{}'), but {} is the world {}; learn again",
          file.string(), info.worldFingerprint, info.world, arguments.world.string(), fingerprint));
    }
  }
  checkAsLoaded(file, arguments);
  const FieldGrid& grid = info.region.grid;
  fmt::print(
      "{}: tables of robot '{}' in world '{}', fingerprint {}, {:.1f} MB\n  {}\n  {} x {} cells of "
      "{:g} m, {} open, {} standable; directions every {:g} degrees\n",
      printable(file.string()), printable(info.robot), printable(info.world),
      printable(info.worldFingerprint), static_cast<double>(fs::file_size(file)) / 1e6,
      bounds(grid), grid.columns, grid.rows, grid.cell, countOf(info.region.open),
      countOf(info.region.standable), degrees(info.headingStep));
  printBuilding(info.region.building);
  for (const TableInfo::Feature& feature : info.features) {
    fmt::print("  {:<40} {}\n", printable(feature.id), printable(feature.key));
  }
  if (!arguments.world.empty()) fmt::print("  fits {}\n", printable(arguments.world.string()));
  if (!arguments.robot.empty()) fmt::print("  fits {}\n", printable(arguments.robot.string()));
}

/// Cuts the incomplete end off a record.
void mend(const fs::path& file) {
  RecordSource source(file);  // throws unless it is a record
  if (const auto torn = mendRecord(file))
    note(fmt::format("{}: cut off its last {} bytes, which were incomplete", file.string(),
                     torn->bytes));
}

/// Prints the readings of a record by feature, and checks that a robot's features accept them.
void checkRecord(const fs::path& file, const CheckArguments& arguments) {
  if (arguments.mend) mend(file);
  RecordSource source(file);
  std::unique_ptr<Robot> robot;
  if (!arguments.robot.empty()) robot = openRobot(arguments.robot);
  std::map<std::string, std::size_t> readings;
  std::size_t all = 0;
  Timestamp first = 0;
  Timestamp last = 0;
  Message message;
  while (source.next(message)) {
    checkInterrupt();
    if (all++ == 0) first = message.stamp;
    last = message.stamp;
    ++readings[toText(message.id)];
    if (!robot) continue;
    try {
      robot->container.set(message);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(
          fmt::format("{}: reading at {} us: {}", file.string(), message.stamp, error.what()));
    }
  }
  if (const std::string remark = source.remark(); !remark.empty())
    warn(remark + "; --mend cuts them off");
  const std::string world = source.worldFingerprint();
  fmt::print("{}: record{}, world {}, {} readings, {} to {} us ({:.3f} s)\n",
             printable(file.string()), source.isCompressed() ? ", compressed" : "",
             world.empty() ? "not known" : printable(world), all, first, last,
             toSeconds(last) - toSeconds(first));
  for (const auto& [feature, count] : readings) {
    const bool lacks = robot && robot->container.findExactly(parseSensorId(feature)) == nullptr;
    fmt::print("  {:<40} {:>9} readings{}\n", feature, count,
               lacks ? ", not in the robot file" : "");
  }
}

void checkKind(const fs::path& file, FileKind kind, const CheckArguments& arguments) {
  switch (kind) {
    case FileKind::kMapServer:
      note(file.string() + ": is a grid map, taken as a world");
      return checkWorldFile(file, arguments);
    case FileKind::kWorld:
      return checkWorldFile(file, arguments);
    case FileKind::kScene:
      return checkSceneFile(file);
    case FileKind::kRobot:
      return checkRobotFile(file, arguments);
    case FileKind::kTables:
    case FileKind::kZip:
      return checkTables(file, arguments);
    case FileKind::kRecord:
      return checkRecord(file, arguments);
    default:
      throw std::runtime_error(file.string() + ": is " + nameOf(kind) +
                               ", expected a world, scene, robot file, map, tables or a record");
  }
}

void checkFile(const fs::path& file, const CheckArguments& arguments) {
  const FileKind kind = kindOf(file);
  checkKind(file, kind, arguments);
  flushOutput();  // so that results and doubts keep their order
  for (const std::string& doubt : doubtsOf(file, kind)) warn(doubt);
}

}  // namespace

int runCheck(const CheckArguments& arguments) {
  if (!arguments.schema.empty()) {
    fmt::print("{}\n", schemaOf(arguments.schema));
    return 0;
  }
  if (arguments.files.empty()) throw UsageError("files is required");
  std::size_t bad = 0;
  for (const fs::path& file : arguments.files) {
    try {
      checkFile(file, arguments);
    } catch (const Interrupted&) {
      throw;
    } catch (const std::exception& error) {
      if (isReaderGone(error)) throw;
      fail(error.what());
      ++bad;
    }
    flushOutput();  // so that results and errors keep their order
  }
  if (arguments.files.size() > 1) fmt::print("{} files, {} bad\n", arguments.files.size(), bad);
  return bad == 0 ? 0 : 1;
}

}  // namespace ortung::app
