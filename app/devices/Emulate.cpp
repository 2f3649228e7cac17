#include "Emulate.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "Console.hpp"
#include "HostPort.hpp"
#include "Interrupt.hpp"
#include "SourceArguments.hpp"
#include "ortung/devices/RobotDevices.hpp"
#include "ortung/emulators/EmulatedBase.hpp"
#include "ortung/emulators/EmulatedHokuyo.hpp"
#include "ortung/emulators/EmulatedLines.hpp"
#include "ortung/emulators/EmulatedSick.hpp"
#include "ortung/emulators/EmulatorRun.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/FeatureOf.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung::app {
namespace {

using Features = std::vector<const SensorData*>;

/// What is to be emulated.
struct Wanted {
  std::string kind;  ///< "sick", ...
  std::string port;  ///< of the robot file; "": it names none
  Features features;
};

/// Kinds by the names of their drivers.
std::string kindOf(const std::string& plugin) {
  if (plugin == "sick_lms") return "sick";
  return plugin == "hokuyo" || plugin == "base" || plugin == "lines" ? plugin : "";
}

ScanData scanIn(const Wanted& wanted) {
  for (const SensorData* data : wanted.features)
    if (isOf(*data, formats::kScan))
      return ScanData(data->id(), data->mount(), ScanData::configOf(data->format()));
  throw std::runtime_error("the robot file has no scan that a " + wanted.kind +
                           " could measure (a [[sensor]] with plugin = \"lrf\")");
}

bool isServer(const std::string& port) { return port.starts_with("tcp:"); }

std::unique_ptr<EmulatedDevice> makeDevice(const Wanted& wanted, bool hasLine,
                                           std::optional<unsigned> baud) {
  const auto speed = [&](int shipped) { return baud ? static_cast<int>(*baud) : shipped; };
  if (wanted.kind == "sick") return std::make_unique<EmulatedSick>(scanIn(wanted), speed(9600));
  if (wanted.kind == "base") return std::make_unique<EmulatedBase>(wanted.features, speed(115200));
  std::optional<int> line;  // a USB cable has no speed, nor has a socket
  if (wanted.kind == "hokuyo") {
    if (hasLine && baud) line = speed(0);
    return std::make_unique<EmulatedHokuyo>(scanIn(wanted), line);
  }
  if (hasLine) line = speed(115200);
  return std::make_unique<EmulatedLines>(wanted.features, line);
}

std::unique_ptr<Endpoint> makeEndpoint(const Wanted& wanted, const EmulateArguments& arguments) {
  if (arguments.tcp)
    return std::make_unique<TcpEndpoint>(static_cast<std::uint16_t>(*arguments.tcp));
  if (isServer(wanted.port) && arguments.link.empty()) {
    const auto place = parseHostPort(wanted.port.substr(4));
    if (!place || !place->port)
      throw std::runtime_error("port '" + wanted.port + "': expected tcp:HOST:PORT");
    return std::make_unique<TcpEndpoint>(*place->port);
  }
  if (!arguments.link.empty()) return std::make_unique<PseudoTerminal>(arguments.link);
  if (arguments.dev.empty()) return std::make_unique<PseudoTerminal>();
  std::filesystem::create_directories(arguments.dev);
  const std::filesystem::path name = std::filesystem::path(wanted.port).filename();
  return std::make_unique<PseudoTerminal>(arguments.dev / name);
}

/// Features of a robot whose file names no devices, for one that is asked for by name.
Features featuresFor(const std::string& kind, const std::vector<Device>& devices) {
  Features features;
  for (const Device& device : devices) {
    if (device.hasExtractor) continue;
    for (const SensorData* data : device.data) {
      const bool isScan = isOf(*data, formats::kScan);
      const bool isBase = isOf(*data, formats::kCone) || isOf(*data, formats::kOdometry);
      if (kind == "lines" || (kind == "base" ? isBase : isScan)) features.push_back(data);
    }
  }
  return features;
}

std::vector<Wanted> wantedOf(const EmulateArguments& arguments, const RobotConfig& robot,
                             const std::vector<Device>& devices) {
  std::vector<Wanted> wanted;
  bool namesAny = false;
  for (const SensorConfig& sensor : robot.sensors) namesAny |= !sensor.device.keys().empty();
  if (namesAny) {
    for (const DeviceSettings& one : readDevices(robot, devices, "")) {
      const std::string kind = kindOf(one.plugin);
      if (arguments.kind != "all" && kind != arguments.kind) continue;
      if (kind.empty()) {
        warn(fmt::format("there is no emulator of {}", printable(one.plugin)));
        continue;
      }
      wanted.push_back({kind, one.port, one.features});
    }
  } else if (arguments.kind != "all") {
    wanted.push_back({arguments.kind, "", featuresFor(arguments.kind, devices)});
  }
  if (wanted.empty())
    throw std::runtime_error(fmt::format("{}: names no device that could be emulated",
                                         printable(arguments.robot.string())));
  const bool isForOne = arguments.tcp || arguments.baud || !arguments.link.empty();
  if (isForOne && wanted.size() > 1)
    throw UsageError(
        "--link, --tcp and --baud are for a single device; expected one of sick, "
        "hokuyo, base, lines in place of all");
  return wanted;
}

std::vector<EmulatorFault> faultsOf(const EmulateArguments& arguments, const std::string& kind) {
  std::vector<EmulatorFault> faults;
  for (const std::string& text : arguments.faults) {
    const std::size_t equals = text.find('=');
    if (equals != std::string::npos && text.substr(0, equals) != kind) continue;
    try {
      faults.push_back(
          parseEmulatorFault(equals == std::string::npos ? text : text.substr(equals + 1)));
    } catch (const std::invalid_argument& error) {
      throw UsageError(std::string("--fault: ") + error.what());
    }
  }
  return faults;
}

SourceText sourceOf(const EmulateArguments& arguments) {
  if (arguments.source.empty() == arguments.world.empty())
    throw UsageError("expected one of --world and --source");
  if (arguments.source.empty())
    return {"sim",
            arguments.world.string(),
            {{"duration", "1e6"}, {"seed", std::to_string(arguments.seed)}}};
  try {
    return parseSourceText(arguments.source);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

std::string emulateHelp() { return emulatorFaultHelp(); }

int runEmulate(const EmulateArguments& arguments) {
  const SourceText text = sourceOf(arguments);
  const RobotConfig robot = readRobot(arguments.robot);
  PluginFactory factory(PluginFactory::standardFolders());
  SensorContainer container;
  const std::vector<Device> devices = fillContainer(container, robot, factory);
  std::vector<EmulatorRun::Line> lines;
  for (const Wanted& wanted : wantedOf(arguments, robot, devices)) {
    EmulatorRun::Line line;
    line.endpoint = makeEndpoint(wanted, arguments);
    try {
      line.device = makeDevice(wanted, line.endpoint->baud().has_value(), arguments.baud);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(error.what());
    }
    line.device->clock = {arguments.clockOffset, arguments.clockDriftPpm};
    line.faults = faultsOf(arguments, wanted.kind);
    fmt::print("{} at {}\n", wanted.kind, printable(line.endpoint->name()));
    lines.push_back(std::move(line));
  }
  flushOutput();
  const std::unique_ptr<Source> source = openSourceArgument(text, arguments.robot, factory);
  EmulatorRun run(std::move(lines), *source, {arguments.speed, arguments.waits, arguments.seed});
  run.run([] { return interruptSignal() == 0; });
  warnOf(*source);
  return 0;
}

}  // namespace ortung::app
