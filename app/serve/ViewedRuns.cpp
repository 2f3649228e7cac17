#include "ViewedRuns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <string>
#include <vector>

#include "Console.hpp"
#include "Localizing.hpp"
#include "Progress.hpp"
#include "PublishedRecord.hpp"
#include "SourceArguments.hpp"
#include "ortung/records/RecordWriter.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/run/Localization.hpp"
#include "ortung/server/FieldText.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung::app {
namespace {

/// Returns a name that the protocol allows for a robot.
std::string nameOf(const std::string& text, std::size_t number) {
  constexpr std::size_t kLongest = 28;
  std::string name = std::filesystem::path(text).stem().string().substr(0, kLongest);
  std::replace_if(
      name.begin(), name.end(),
      [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_';
      },
      '_');
  if (name.empty()) name = "run";
  return number == 0 ? name : fmt::format("{}-{}", name, number + 1);
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

/// Parses a source, which may be the path of a record.
SourceText sourceTextOf(const std::string& argument) {
  std::error_code error;
  if (std::filesystem::is_regular_file(argument, error)) return {"record", argument, {}};
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

/// Describes lines, walls and goals of the tables or, without those, of the world.
void describeField(const ViewArguments& arguments, ServedPlayback::Config& config) {
  const auto boundsOf = [](const FieldRegion& region) {
    const FieldGrid& grid = region.grid;
    return FieldBounds{grid.originX, grid.originY, grid.originX + grid.cell * grid.columns,
                       grid.originY + grid.cell * grid.rows};
  };
  if (!arguments.world.empty()) {
    const auto world = readWorld(arguments.world);
    const Box2 bounds = world->solids().bounds;
    config.field = fieldText(fieldModelOf(*world));
    config.bounds = FieldBounds{bounds.xLow, bounds.yLow, bounds.xHigh, bounds.yHigh};
  } else if (!arguments.localization.tables.empty()) {
    const TableInfo info = readTableInfo(TableFile(arguments.localization.tables));
    config.field = fieldText(info.field);
    config.bounds = boundsOf(info.region);
  }
}

}  // namespace

ServedPlayback::Config prepareRuns(const ViewArguments& arguments, const ScratchFolder& scratch) {
  if (arguments.localization.robot.empty() && !arguments.localization.tables.empty())
    throw UsageError("--tables needs --robot: give both to localize");
  ServedPlayback::Config config;
  describeField(arguments, config);
  const bool localizes = !arguments.localization.tables.empty();
  const std::vector<ServedFeature> described =
      localizes ? std::vector<ServedFeature>() : featuresOf(arguments.localization.robot);
  for (std::size_t i = 0; i < arguments.sources.size(); ++i) {
    const SourceText source = sourceTextOf(arguments.sources[i]);
    const std::filesystem::path file = scratch.path() / fmt::format("run{}.rec", i);
    ServedPlayback::Run run;
    run.name = nameOf(source.path, i);
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
  return config;
}

}  // namespace ortung::app
