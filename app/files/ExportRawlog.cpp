#include "ExportRawlog.hpp"

#include <fmt/format.h>

#include <map>
#include <stdexcept>

#include "Console.hpp"
#include "Interrupt.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "SecondsText.hpp"
#include "SourceArguments.hpp"
#include "Workshop.hpp"
#include "ortung/base/HelperProgram.hpp"
#include "ortung/core/ReadingLine.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/run/Feeder.hpp"
#include "ortung/run/Robot.hpp"

namespace ortung::app {
namespace {

constexpr const char* kWriter = "ortung-mrpt-writer";

/// What ortung-mrpt-writer is told of a feature; "" for one that no rawlog can hold.
std::string declarationOf(const SensorData& data) {
  const std::string name = toText(data.id());
  const Pose2& mount = data.mount();
  const auto line = [&](const char* kind, double a, double b, double c) {
    return fmt::format("# {} {} {} {} {} {} {} {}\n", kind, name, mount.x, mount.y, mount.theta, a,
                       b, c);
  };
  const Format format = data.format();
  if (format.name() == formats::kOdometry) return "# odometry " + name + "\n";
  if (format.name() == formats::kScan) {
    const ScanData::Config config = ScanData::configOf(format);
    return line("scan", config.firstAngle, config.angleStep, config.maxRange);
  }
  // A rawlog holds limits of sight, which words can be understood without.
  if (const auto* marks = dynamic_cast<const LandmarksData*>(&data))
    return line("landmarks", marks->config().maxRange, marks->config().fieldOfView, 0.0);
  if (format.name() == formats::kCone)
    return line("cone", format.angle("opening_deg"), format.number("max_m"), 0.0);
  return "";
}

/// What was given to the writer, and what was not.
struct Handed {
  std::size_t readings = 0;
  std::map<std::string, std::size_t> leftOut;  ///< by feature, or a reason
  std::string truth;
};

/// MRPT takes the first column for times only where neither of the first two is whole, else for
/// numbers of observations: so a whole one becomes a microsecond later.
void addTruth(const Message& message, std::string& text) {
  constexpr Timestamp kSecond = 1'000'000;
  PoseData data(message.id);
  data.setData(message.stamp, message.words);
  const Pose2 pose = data.reading();
  const bool isOfFirstTwo = text.find('\n') == text.rfind('\n');
  const bool isWhole = message.stamp % kSecond == 0;
  text += fmt::format("{} {:.4f} {:.4f} {:.6f}\n",
                      secondsText(message.stamp + (isOfFirstTwo && isWhole ? 1 : 0)), pose.x,
                      pose.y, pose.theta);
}

/// Writes the lines that the writer reads.
Handed handOver(Source& source, const std::string& name, SensorContainer& container,
                const std::filesystem::path& file) {
  NewFile out(file);
  std::map<const SensorData*, bool> isTaken;
  for (const auto& data : container.all()) {
    const std::string declared = declarationOf(*data);
    isTaken[data.get()] = !declared.empty();
    out.write(declared);
  }
  Handed handed;
  std::string line;
  for (Message message; unlessInterrupted(source, [&] { return source.next(message); });) {
    const SensorData* data = container.findExactly(message.id);
    if (message.id.type == kGroundTruth) {
      addTruth(message, handed.truth);
      continue;
    }
    if (data == nullptr || !isTaken[data]) {
      ++handed
            .leftOut[toText(message.id) + (data == nullptr ? ", which the robot file lacks" : "")];
      continue;
    }
    try {
      data->checkData(message.words);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(
          fmt::format("{}: reading at {} us: {}", name, message.stamp, error.what()));
    }
    line.clear();
    writeLine(message, line);
    out.write(line += '\n');
    ++handed.readings;
  }
  out.commit();
  return handed;
}

}  // namespace

int runExportRawlog(const ExportRawlogArguments& arguments) {
  constexpr std::size_t kMostSaid = 1U << 16;
  Outputs outputs(arguments.force);
  outputs.readsSource(arguments.source);
  outputs.reads(arguments.robot);
  outputs.writes("--out", arguments.out, OutputKind::kRawlog);
  outputs.writes("--truth", arguments.truth, OutputKind::kSettings);
  const auto writer = findHelper(kWriter, arguments.out.string());
  const std::unique_ptr<Robot> robot = openRobot(arguments.robot);
  const auto source = openSourceArgument(arguments.source, arguments.robot, robot->factory);
  const Workshop lines("--out", "lines.txt");
  const Workshop made("--out", arguments.out);
  const Handed handed = handOver(*source, arguments.source, robot->container, lines.file());
  warnOf(*source);
  for (const auto& [what, count] : handed.leftOut)
    warn(fmt::format("{} readings were left out, of {}", count, what));
  if (handed.readings == 0)
    throw std::runtime_error(arguments.source + ": holds no reading that a rawlog can hold");
  const std::string said =
      runHelper(writer, {"rawlog", lines.file().string(), made.file().string()},
                arguments.out.string(), kMostSaid);
  if (said != std::to_string(handed.readings) + "\n")
    throw std::runtime_error(fmt::format("{}: {} has written {} objects of {}",
                                         arguments.out.string(), kWriter,
                                         said.substr(0, said.find('\n')), handed.readings));
  made.deliver(outputs);
  outputs.write(arguments.truth, handed.truth);
  fmt::print("{}: {} observations\n", printable(arguments.out.string()), handed.readings);
  return 0;
}

}  // namespace ortung::app
