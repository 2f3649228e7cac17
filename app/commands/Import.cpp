#include <fmt/format.h>
#include <unistd.h>

#include <map>
#include <optional>
#include <stdexcept>

#include "Commands.hpp"
#include "Console.hpp"
#include "Interrupt.hpp"
#include "OutputFile.hpp"
#include "Progress.hpp"
#include "SourceArguments.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

/// A folder beside a file, in which what goes with it is made before it is moved into place.
class Workshop {
 public:
  explicit Workshop(const fs::path& target)
      : target_(target), folder_(target.string() + ".tmp-" + std::to_string(getpid())) {
    checkOutput(target);
    if (!fs::create_directory(folder_)) {
      throw std::runtime_error(folder_.string() + ": is already there; remove it");
    }
  }
  ~Workshop() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  /// The target's place within the folder.
  fs::path file() const { return folder_ / target_.filename(); }

  /// @throws std::runtime_error if a file made here would replace one
  void refuseToReplace() const {
    for (const fs::path& made : files()) {
      const fs::path place = placeOf(made);
      if (fs::exists(place)) {
        throw std::runtime_error(place.string() + ": exists and would be overwritten; use --force");
      }
    }
  }

  /// Moves all files into place, the target last: it names the others.
  void deliver() const {
    for (const fs::path& made : files()) {
      if (made != file()) move(made);
    }
    move(file());
  }

 private:
  void move(const fs::path& made) const {
    const fs::path place = placeOf(made);
    fs::create_directories(place.parent_path().empty() ? "." : place.parent_path());
    fs::rename(made, place);
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      if (!entry.is_directory()) found.push_back(entry.path());
    }
    return found;
  }
  fs::path placeOf(const fs::path& made) const {
    return target_.parent_path() / fs::relative(made, folder_);
  }

  fs::path target_;
  fs::path folder_;
};

SourceText sourceText(const ImportArguments& arguments) {
  SourceText text{arguments.kind, arguments.source, {}};
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

/// Makes the world and reads it back: what can't be learned in must not be delivered.
std::string makeWorld(const Source& source, const Workshop& workshop) {
  source.writeWorld(workshop.file());
  return readWorld(workshop.file())->fingerprint();
}

void makeRobot(const Source& source, const Workshop& workshop, const ImportArguments& arguments) {
  const std::string toml = source.robotToml();
  if (toml.empty()) {
    throw std::runtime_error(
        fmt::format("{}:{}: does not say what robot it is from; write {} by hand", arguments.kind,
                    arguments.source, arguments.robotFile.string()));
  }
  writeFile(workshop.file(), toml);
  readRobot(workshop.file());
}

/// What was written, for the summary.
struct Written {
  std::map<std::string, std::size_t> readings;  ///< by feature
  Timestamp first = 0;
  Timestamp last = 0;
};

Written copyMessages(Source& source, RecordWriter& record, bool bar) {
  Written written;
  Progress progress("importing", bar);
  Message message;
  while (source.next(message)) {
    checkInterrupt();
    if (record.messages() == 0) written.first = message.stamp;
    written.last = message.stamp;
    ++written.readings[toText(message.id)];
    record.write(message);
    progress.update(source.progress());
  }
  return written;
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

int runImport(const ImportArguments& arguments) {
  const SourceText text = sourceText(arguments);
  checkOutput(arguments.out);
  PluginFactory factory(PluginFactory::standardFolders());
  const std::unique_ptr<Source> source = openSourceArgument(text, arguments.withRobot, factory);

  std::optional<Workshop> world;
  std::optional<Workshop> robot;
  std::string fingerprint = source->worldFingerprint();
  if (!arguments.world.empty()) {
    world.emplace(arguments.world);
    fingerprint = makeWorld(*source, *world);
    if (!arguments.force) world->refuseToReplace();
  }
  if (!arguments.robotFile.empty()) {
    robot.emplace(arguments.robotFile);
    makeRobot(*source, *robot, arguments);
    if (!arguments.force) robot->refuseToReplace();
  }
  RecordWriter record(arguments.out, fingerprint);
  const Written written = copyMessages(*source, record, arguments.progress);
  if (record.messages() == 0) {
    throw std::runtime_error(
        fmt::format("{}:{}: holds no reading", arguments.kind, arguments.source));
  }
  record.commit();
  if (world) world->deliver();
  if (robot) robot->deliver();
  print(written, arguments, record.messages());
  return 0;
}

}  // namespace ortung::app
