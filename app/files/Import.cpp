#include "Import.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <stdexcept>

#include "Console.hpp"
#include "Interrupt.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "SourceArguments.hpp"
#include "Workshop.hpp"
#include "ortung/core/SourceHelp.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

/// Parses "KIND SOURCE", or "KIND:SOURCE?key=value" as in other commands.
SourceText namedSource(const ImportArguments& arguments) {
  const bool isOne = arguments.source.empty();
  if (!isOne && arguments.kind.find(':') != std::string::npos)
    throw UsageError("the kind of source is '" + arguments.kind +
                     "', expected KIND SOURCE or KIND:SOURCE?key=value");
  std::error_code none;
  if (!isOne && fs::exists(arguments.source, none)) return {arguments.kind, arguments.source, {}};
  try {
    return parseSourceText(isOne ? arguments.kind : arguments.kind + ":" + arguments.source);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

SourceText sourceText(const ImportArguments& arguments) {
  SourceText text = namedSource(arguments);
  for (const std::string& option : arguments.options) {
    const std::size_t equals = option.find('=');
    if (equals == 0 || equals == std::string::npos) {
      throw UsageError("--option is '" + option + "', expected key=value");
    }
    if (!text.options.emplace(option.substr(0, equals), option.substr(equals + 1)).second) {
      throw UsageError("the option '" + option.substr(0, equals) + "' is given twice");
    }
  }
  return text;
}

/// Makes the world and reads it back: a world that can't be used must not be delivered.
std::string makeWorld(const Source& source, const Workshop& workshop) {
  source.writeWorld(workshop.file());
  return readWorld(workshop.file())->fingerprint();
}

void makeRobot(const Source& source, const Workshop& workshop, const std::string& name,
               const ImportArguments& arguments) {
  const std::string toml = source.robotToml();
  if (toml.empty()) {
    throw std::runtime_error(fmt::format("{}: does not describe its robot; write {} by hand", name,
                                         arguments.robotFile.string()));
  }
  writeFile(workshop.file(), toml);
  readRobot(workshop.file());
}

/// Returns the notes of the record: what the source knows, and the formats of the robot file, if
/// there is one and its plugins are on this machine.
RecordNotes notesFor(const Source& source, const fs::path& robotFile, PluginFactory& factory) {
  SensorContainer robot;
  try {
    if (!robotFile.empty()) fillContainer(robot, readRobot(robotFile), factory);
  } catch (const PluginError& error) {
    warn(fmt::format("{}: the record does not say its formats: {}", robotFile.string(),
                     error.what()));
  }
  return notesOf(source, robot);
}

/// What was written, for the summary.
struct Written {
  std::map<std::string, std::size_t> readings;  ///< number of readings of each feature
  Timestamp first = 0;
  Timestamp last = 0;
};

Written copyMessages(Source& source, RecordWriter& record, const ImportArguments& arguments) try {
  Written written;
  Progress progress("importing", arguments.progress);
  Message message;
  while (unlessInterrupted(source, [&] { return source.next(message); })) {
    if (record.messages() == 0) written.first = message.stamp;
    written.last = message.stamp;
    ++written.readings[toText(message.id)];
    record.write(message);
    progress.update(source.progress());
  }
  return written;
} catch (const std::exception&) {
  if (source.isLive() && record.messages() > 0)
    note(fmt::format("earlier readings are in {}", arguments.out.string()));
  throw;
}

void print(const Written& written, const ImportArguments& arguments, std::size_t messages) {
  fmt::print("{}: {} readings over {:.3f} s\n", arguments.out.string(), messages,
             toSeconds(written.last) - toSeconds(written.first));
  for (const auto& [feature, count] : written.readings)
    fmt::print("  {:<48} {:>9}\n", feature, count);
  if (!arguments.world.empty()) fmt::print("{}: world\n", arguments.world.string());
  if (!arguments.robotFile.empty()) fmt::print("{}: robot\n", arguments.robotFile.string());
}

}  // namespace

std::string importHelp(const std::string& kind) {
  PluginFactory factory(PluginFactory::standardFolders());
  if (kind.empty()) {
    std::string text = "Kinds; `ortung import KIND --help` lists the options of one:\n";
    for (const PluginFactory::Found& library : factory.list()) {
      for (const auto& entry : library.entries) {
        if (entry.interface != SourceHelp::kInterface) continue;
        const auto help = factory.make<SourceHelp>(entry.name, Parameters());
        text += fmt::format("  {:<10} {}\n", printable(entry.name), help->path());
      }
    }
    return text;
  }
  std::unique_ptr<SourceHelp> help;
  try {
    help = factory.make<SourceHelp>(kind, Parameters());
  } catch (const PluginError&) {
    return fmt::format("{}: does not describe its options; `ortung import --help` lists kinds\n",
                       printable(kind));
  }
  std::string text =
      fmt::format("{}: {}. Its options (--option KEY=VALUE):\n", printable(kind), help->path());
  for (const SourceOption& option : help->options()) {
    const std::string unit = option.unit.empty() ? "" : " [" + option.unit + "]";
    text += fmt::format("  {:<26}{}; default: {}\n", option.key + unit, option.meaning,
                        option.fallback);
  }
  return text;
}

int runImport(const ImportArguments& arguments) {
  const SourceText text = sourceText(arguments);
  Outputs outputs(arguments.force);
  outputs.reads(text.path);
  outputs.reads(arguments.withRobot);
  outputs.writes("--out", arguments.out, OutputKind::kRecord);
  outputs.writes("--world", arguments.world, OutputKind::kSettings);
  outputs.writes("--robot-file", arguments.robotFile, OutputKind::kSettings);
  PluginFactory factory(PluginFactory::standardFolders());
  const std::unique_ptr<Source> source = openSourceArgument(text, arguments.withRobot, factory);

  std::optional<Workshop> world;
  std::optional<Workshop> robot;
  std::string fingerprint = source->worldFingerprint();
  if (!arguments.world.empty()) {
    world.emplace("--world", arguments.world);
    fingerprint = makeWorld(*source, *world);
    world->declare(outputs);
  }
  if (!arguments.robotFile.empty()) {
    robot.emplace("--robot-file", arguments.robotFile);
    makeRobot(*source, *robot, text.kind + ":" + text.path, arguments);
  }
  const fs::path robotFile = robot ? robot->file() : arguments.withRobot;
  RecordNotes notes = notesFor(*source, robotFile, factory);
  notes.world = fingerprint;
  RecordWriter record(outputs.ready(arguments.out), notes, paceOf(*source));
  const Written written = copyMessages(*source, record, arguments);
  warnOf(*source);
  if (record.messages() == 0) {
    throw std::runtime_error(fmt::format("{}:{}: has no reading", text.kind, text.path));
  }
  record.commit();
  if (world) world->deliver(outputs);
  if (robot) robot->deliver(outputs);
  print(written, arguments, record.messages());
  return 0;
}

}  // namespace ortung::app
