#include "CalibrateNoise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "Console.hpp"
#include "Interrupt.hpp"
#include "LocalizationArguments.hpp"
#include "Localizing.hpp"
#include "NoiseParts.hpp"
#include "NoiseText.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "SourceArguments.hpp"
#include "ortung/robot/RobotText.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/run/Feeder.hpp"
#include "ortung/study/NoiseLearner.hpp"

namespace ortung::app {
namespace {

using Json = nlohmann::ordered_json;

std::string sourceOf(const std::string& text) {
  return text.find(':') == std::string::npos ? "record:" + text : text;
}

/// Reads the readings and the ground truth, if there is one.
NoiseLog readTruth(const CalibrateNoiseArguments& arguments, const std::string& name,
                   Progress& progress) {
  const std::unique_ptr<Robot> robot = openRobot(arguments.robot, arguments.tables);
  const std::unique_ptr<Source> source = openSourceArgument(name, arguments.robot, robot->factory);
  Feeder feeder(name, *source, robot->container);
  NoiseLog log;
  NoiseLogger logger;
  while (feeder.next()) {
    checkInterrupt();
    progress.update(feeder.progress());
    if (feeder.truth()) log.reference.emplace_back(feeder.stamp(), *feeder.truth());
    logger.look(robot->container, log);
  }
  return log;
}

/// Uses the track of MCL with the robot file as it is, while its status is "tracking".
void useTrack(const CalibrateNoiseArguments& arguments, const std::string& name, Progress& progress,
              NoiseLog& log) {
  LocalizationArguments how;
  how.source = name;
  how.robot = arguments.robot;
  how.tables = arguments.tables;
  how.seed = arguments.seed;
  how.motion = arguments.motion;
  how.anyWorld = arguments.anyWorld;
  how.start = log.reference.empty() ? "global" : "truth";
  log.reference.clear();
  const std::unique_ptr<Localization> localization = openLocalization(how);
  while (const auto step = nextStep(*localization, how)) {
    progress.update(localization->feeder().progress());
    if (step->estimate.status == TrackStatus::kTracking &&
        (log.reference.empty() || log.reference.back().first < step->estimate.stamp))
      log.reference.emplace_back(step->estimate.stamp, step->estimate.pose);
  }
}

/// Reads the log of one source.
NoiseLog readLog(const CalibrateNoiseArguments& arguments, const std::string& text) {
  const std::string name = sourceOf(text);
  Progress progress("reading", arguments.progress);
  NoiseLog log = readTruth(arguments, name, progress);
  const bool hasTruth = !log.reference.empty();
  if (arguments.reference == "truth" && !hasTruth) {
    throw std::runtime_error(name +
                             ": has no ground truth, expected a feature of type groundTruth; "
                             "--reference track uses the poses of MCL");
  }
  if (arguments.reference == "track" || !hasTruth) useTrack(arguments, name, progress, log);
  if (log.reference.size() < 2)
    throw std::runtime_error(name + ": MCL was never tracking, so there is no reference");
  return log;
}

NoiseLearning howOf(const std::vector<std::string>& allFixed) {
  NoiseLearning how;
  for (const std::string& fixed : allFixed) {
    const auto set = [&](NoiseTerm term) { how.wanted[static_cast<std::size_t>(term)] = false; };
    if (fixed == "bias") {
      set(NoiseTerm::kRangeBias);
      set(NoiseTerm::kBearingBias);
      for (const NoiseTerm term :
           {NoiseTerm::kRangePerMetre, NoiseTerm::kRangePerMetreRad, NoiseTerm::kRangePerMetreRad2,
            NoiseTerm::kBearingPerRad, NoiseTerm::kBearingPerRad2})
        set(term);
    }
    if (fixed == "mount") {
      set(NoiseTerm::kMountX);
      set(NoiseTerm::kMountY);
      set(NoiseTerm::kMountTheta);
    }
    if (fixed == "latency") set(NoiseTerm::kLatency);
  }
  return how;
}

/// Learns the noise of all devices and tells it.
/// @return the robot file with what was learned @throws std::runtime_error if nothing was
std::string learnAll(const std::filesystem::path& robotFile, const std::filesystem::path& tables,
                     const std::vector<NoiseLog>& logs, const NoiseLearning& how, bool wantsKeys) {
  const std::unique_ptr<Robot> robot = openRobot(robotFile, tables);
  std::string text = readTomlText(robotFile);
  std::size_t learnt = 0;
  for (std::size_t sensor = 0; sensor < robot->devices.size(); ++sensor) {
    std::vector<SensorData*> features;
    for (SensorData* data : robot->devices[sensor].data)
      if (data->localizes()) features.push_back(data);
    if (features.empty()) continue;
    checkInterrupt();
    const std::string name = toText(features.front()->id());
    try {
      const LearnedNoise noise = learnNoise(features, robot->tables, logs, how);
      ++learnt;
      fmt::print("{}", noiseText(features, noise));
      const SensorConfig& config = robot->config.sensors[sensor];
      const std::vector<TomlEntry> keys = noiseEntries(config, noise);
      if (keys.empty() && wantsKeys)
        warn(fmt::format(
            "{}: it is not known which keys of the plugin '{}' say this; write them by hand", name,
            printable(config.plugin)));
      text = withSensorKeys(text, robotFile.string(), sensor, keys);
    } catch (const ConfigError&) {
      throw;
    } catch (const std::runtime_error& error) {
      warn(fmt::format("{}: {}", name, error.what()));
    }
  }
  if (learnt == 0) throw std::runtime_error("nothing was learned");
  return text;
}

/// Reads the sources of a shard only, and writes what they have as a part.
void readShardOf(const CalibrateNoiseArguments& arguments, const std::filesystem::path& out) {
  const Shard shard = readShard(arguments.shard);
  NoisePart part;
  for (std::size_t i = 0; i < arguments.sources.size(); ++i)
    if (shard.has(i)) part.emplace_back(i, readLog(arguments, arguments.sources[i]));
  const Json needs = {{"robot", arguments.robot.string()},
                      {"tables", arguments.tables.string()},
                      {"fixed", arguments.fixed}};
  write(part,
        {kNoiseParts, arguments.job, shard,
         needs.dump(-1, ' ', true, Json::error_handler_t::replace)},
        out);
  fmt::print("{}: part {}, {} of {} sources\n", out.string(), toText(shard), part.size(),
             arguments.sources.size());
}

}  // namespace

std::string mergeNoise(const PartSet& parts) {
  parts.requireInputs();
  try {
    const Json needs = Json::parse(parts.head().needs);
    return learnAll(needs.at("robot").get<std::string>(), needs.at("tables").get<std::string>(),
                    mergeNoiseLogs(parts), howOf(needs.at("fixed").get<std::vector<std::string>>()),
                    true);
  } catch (const Json::exception& error) {
    throw PartError({std::string("the parts do not say how they were made: ") + error.what()});
  }
}

int runCalibrateNoise(const CalibrateNoiseArguments& arguments) {
  const bool isPart = !arguments.shard.empty();
  if (isPart && arguments.out.empty())
    throw UsageError("--shard writes a part, expected its name: --out");
  Outputs outputs(arguments.force);
  for (const std::string& source : arguments.sources) outputs.readsSource(sourceOf(source));
  outputs.reads(arguments.robot);
  outputs.reads(arguments.tables);
  outputs.reads(arguments.motion);
  outputs.writes("--out", arguments.out, isPart ? OutputKind::kPart : OutputKind::kSettings);
  if (isPart) {
    readShardOf(arguments, outputs.ready(arguments.out));
    return 0;
  }
  std::vector<NoiseLog> logs;
  for (const std::string& source : arguments.sources) logs.push_back(readLog(arguments, source));
  outputs.write(arguments.out, learnAll(arguments.robot, arguments.tables, logs,
                                        howOf(arguments.fixed), !arguments.out.empty()));
  return 0;
}

}  // namespace ortung::app
