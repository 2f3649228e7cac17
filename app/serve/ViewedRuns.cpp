#include "ViewedRuns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "Console.hpp"
#include "Localizing.hpp"
#include "Progress.hpp"
#include "PublishedRecord.hpp"
#include "SourceArguments.hpp"
#include "ortung/base/FileKind.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/mcl_served/WorldTables.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/records/RecordWriter.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/run/Localization.hpp"
#include "ortung/served/OpenFloor.hpp"
#include "ortung/server/FieldText.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung::app {
namespace {

/// Returns a name that the protocol allows for a robot, and that no other run has.
std::string nameOf(const std::string& text, const std::vector<ServedPlayback::Run>& others) {
  constexpr std::size_t kLongest = 28;
  std::string name = std::filesystem::path(text).stem().string().substr(0, kLongest);
  std::replace_if(
      name.begin(), name.end(),
      [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_';
      },
      '_');
  if (name.empty()) name = "run";
  const auto isTaken = [&](const std::string& one) {
    return std::any_of(others.begin(), others.end(),
                       [&](const ServedPlayback::Run& run) { return run.name == one; });
  };
  std::string own = name;
  for (int number = 2; isTaken(own); ++number) own = fmt::format("{}-{}", name, number);
  return own;
}

/// A record of the readings of a source and of the estimates of MCL, which have the time at which
/// they are published.
class LocalizedRecord {
 public:
  LocalizedRecord(const LocalizationArguments& arguments, const std::filesystem::path& file)
      : arguments_(arguments), localization_(openLocalization(arguments)) {
    PublishedRecord record(file, *localization_);
    Progress progress("localizing " + arguments.source, arguments.progress);
    while (unlessInterrupted(localization_->source(), [&] { return localization_->advance(); })) {
      localization_->update();
      record.writePublished();
      progress.update(localization_->feeder().progress());
    }
    record.commit();
  }
  std::vector<ServedFeature> features() const { return servedFeatures(localization_->container()); }

 private:
  LocalizationArguments arguments_;
  std::unique_ptr<Localization> localization_;
};

/// Returns a record of a source's readings; the source itself if it is a record.
std::filesystem::path recordOf(const SourceText& text, const ViewArguments& arguments,
                               const std::filesystem::path& file) {
  if (text.kind == "record" && text.options.empty()) return text.path;
  PluginFactory factory(PluginFactory::standardFolders());
  const auto source = openSourceArgument(text, arguments.localization.robot, factory);
  RecordWriter record(file, notesOf(*source));
  FrameReader reader(*source);
  std::vector<Message> frame;
  while (unlessInterrupted(*source, [&] { return reader.next(frame); })) {
    for (const Message& message : frame) record.write(message);
    record.endMoment();
  }
  record.commit();
  return file;
}

/// Returns what a robot file says of its features; nothing without one.
std::vector<ServedFeature> featuresOf(const std::filesystem::path& robotFile) {
  if (robotFile.empty()) return {};
  SensorContainer container;
  PluginFactory factory(PluginFactory::standardFolders());
  fillContainer(container, readRobot(robotFile), factory);
  return servedFeatures(container);
}

/// Returns the kind of source that reads a file, by its content. A file of no such kind is read as
/// a record, which says what is wrong with it.
std::string kindOf(const std::filesystem::path& file) {
  switch (kindOfFile(file)) {
    case FileKind::kMcap:
      return "mcap";
    case FileKind::kSqlite:
    case FileKind::kRosBag:
      return "bag";
    case FileKind::kCarmenLog:
      return "carmen";
    default:
      return "record";
  }
}

/// Parses a source, which may be the path of a record, a bag or a log.
SourceText sourceTextOf(const std::string& argument) {
  std::error_code error;
  if (std::filesystem::is_regular_file(argument, error)) return {kindOf(argument), argument, {}};
  try {
    return parseSourceText(argument);
  } catch (const std::invalid_argument& wrong) {
    throw UsageError(
        fmt::format("{}: is neither a file nor a source: {}", printable(argument), wrong.what()));
  }
}

/// Returns the source's text for a command line.
std::string textOf(const SourceText& source) {
  std::string text = source.kind + ":" + source.path;
  char mark = '?';
  for (const auto& [key, value] : source.options) {
    text += mark + key + "=" + value;
    mark = '&';
  }
  return text;
}

/// Returns the shipped world that a record says it was made in; "" if there is none.
std::filesystem::path shippedWorldOf(const std::filesystem::path& record) {
  const std::string fingerprint = RecordSource(record).worldFingerprint();
  std::error_code error;
  const std::filesystem::path folder = shippedFile("fields", "f2000.toml").parent_path();
  if (fingerprint.empty() || !std::filesystem::is_directory(folder, error)) return {};
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() != ".toml") continue;
    try {
      if (readWorld(entry.path())->fingerprint() == fingerprint) return entry.path();
    } catch (const std::exception& wrong) {  // whoever asks for that one is told so, too
      note(fmt::format("{}: {}", entry.path().string(), wrong.what()));
    }
  }
  return {};
}

/// Returns the world file whose field is shown, if one is known.
std::filesystem::path worldOf(const ViewArguments& arguments,
                              const ServedPlayback::Config& playback) {
  if (!arguments.world.empty() || !arguments.localization.tables.empty()) return arguments.world;
  return shippedWorldOf(playback.runs.front().record);
}

/// Returns what DESCRIBE field tells of it; of a building also where its floor is free.
std::vector<std::string> fieldOf(const FieldModel& model, const FieldRegion& region) {
  std::vector<std::string> lines = fieldText(model);
  if (!isFloor(model)) return lines;
  const std::vector<std::string> floor = floorText(region.grid, region.open);
  lines.insert(lines.end(), floor.begin(), floor.end());
  return lines;
}

/// Describes lines, walls and goals of the world or, without one, of the tables.
void describeField(const std::filesystem::path& worldFile, const std::filesystem::path& tables,
                   ServedPlayback::Config& config) {
  if (!worldFile.empty()) {
    const auto world = readWorld(worldFile);
    const Box2 bounds = world->solids().bounds;
    const FieldModel model = fieldModelOf(*world);
    const FieldRegion floor = isFloor(model) ? openFloor(*world) : FieldRegion();
    config.field = fieldOf(model, floor);
    config.bounds = FieldBounds{bounds.xLow, bounds.yLow, bounds.xHigh, bounds.yHigh};
  } else if (!tables.empty()) {
    const TableInfo info = readTableInfo(TableFile(tables));
    const FieldGrid& grid = info.region.grid;
    config.field = fieldOf(info.field, info.region);
    config.bounds = FieldBounds{grid.originX, grid.originY, grid.originX + grid.cell * grid.columns,
                                grid.originY + grid.cell * grid.rows};
  }
}

/// Returns the robot file; without one, that for which the tables were learned.
std::filesystem::path robotFileOf(const LocalizationArguments& arguments,
                                  const ScratchFolder& scratch) {
  if (!arguments.robot.empty() || arguments.tables.empty()) return arguments.robot;
  const TableInfo info = readTableInfo(TableFile(arguments.tables));
  if (info.robotToml.empty())
    throw UsageError(arguments.tables.string() +
                     ": does not hold its robot file, as older tables; expected --robot");
  const std::filesystem::path file = scratch.path() / "robot.toml";
  std::ofstream out(file, std::ios::binary);
  out << info.robotToml;
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": can't be written");
  return file;
}

std::optional<PerceivedPlayback::Config> perceptionOf(const LocalizationArguments& arguments,
                                                      const std::filesystem::path& world) {
  if (arguments.robot.empty()) return std::nullopt;
  if (!arguments.tables.empty())
    return PerceivedPlayback::Config{arguments.robot, givenTables(arguments.tables, "")};
  if (world.empty()) return std::nullopt;
  return PerceivedPlayback::Config{arguments.robot, learnedTables(world)};
}

}  // namespace

ViewedRuns prepareRuns(const ViewArguments& given, const ScratchFolder& scratch) {
  ViewArguments arguments = given;
  arguments.localization.robot = robotFileOf(given.localization, scratch);
  ViewedRuns viewed;
  ServedPlayback::Config& config = viewed.playback;
  const bool localizes = !arguments.localization.tables.empty();
  const std::vector<ServedFeature> described =
      localizes ? std::vector<ServedFeature>() : featuresOf(arguments.localization.robot);
  for (std::size_t i = 0; i < arguments.sources.size(); ++i) {
    const SourceText source = sourceTextOf(arguments.sources[i]);
    const std::filesystem::path file = scratch.path() / fmt::format("run{}.rec", i);
    ServedPlayback::Run run;
    run.name = nameOf(source.path, config.runs);
    config.name += (i == 0 ? "" : ", ") + std::filesystem::path(source.path).filename().string();
    if (!localizes) {
      run.record = recordOf(source, arguments, file);
      run.features = described;
    } else {
      LocalizationArguments localization = arguments.localization;
      localization.source = textOf(source);
      localization.publish = true;
      run.record = file;
      run.features = LocalizedRecord(localization, run.record).features();
    }
    config.runs.push_back(std::move(run));
  }
  const std::filesystem::path world = worldOf(arguments, config);
  describeField(world, arguments.localization.tables, config);
  viewed.perception = perceptionOf(arguments.localization, world);
  return viewed;
}

}  // namespace ortung::app
