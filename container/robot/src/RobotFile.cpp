#include "ortung/robot/RobotFile.hpp"

#include <algorithm>

#include "ortung/base/FileKind.hpp"
#include "ortung/formats/FeatureOf.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMostSensors = 64;
constexpr std::size_t kMostFeatures = 4096;

}  // namespace

RobotConfig readRobot(const Parameters& file) {
  RobotConfig robot;
  const Parameters body = file.table("robot");
  robot.name = body.textOr("name", "robot");
  robot.radius = body.numberOr("radius_m", robot.radius, {0.001, 100.0});
  robot.mass = body.numberOr("mass_kg", robot.mass, {0.01, 1e5});
  body.textOr("colour", "");  // the simulator checks it
  robot.about = body;
  robot.body = file.tables("body");
  robot.manipulators = file.tables("manipulator");
  for (Parameters& sensor : file.tables("sensor")) {
    const Parameters device = sensor.takeTable("device");
    robot.sensors.push_back({sensor.text("plugin"), sensor, device});
  }
  if (robot.sensors.empty())
    file.fail("sensor", "is missing: a robot file has at least one [[sensor]]");
  if (robot.sensors.size() > kMostSensors) file.fail("sensor", "occurs more than 64 times");
  robot.motion = file.table("motion");
  robot.mcl = file.table("mcl");
  robot.drive = file.table("drive");
  const Parameters devices = file.table("devices");
  robot.deviceWait = devices.numberOr("wait_s", robot.deviceWait, {0.0, 5.0});
  devices.refuseUnread();
  // The readers of sections check their content; other sections are unknown.
  body.refuseUnread();
  static const std::vector<std::string> kSections = {"robot", "sensor", "motion",      "mcl",
                                                     "drive", "body",   "manipulator", "devices"};
  for (const std::string& key : file.keys()) {
    if (std::find(kSections.begin(), kSections.end(), key) == kSections.end()) {
      file.fail(key,
                "is not known here; sections of a robot file are [robot], [[sensor]], [motion], "
                "[mcl], [drive], [devices], [[body]] and [[manipulator]]");
    }
  }
  return robot;
}

RobotConfig readRobot(const std::filesystem::path& file) {
  const std::string other = whatItIs(file, {FileKind::kRobot, FileKind::kMotion});
  if (!other.empty()) throw ConfigError(file.string() + ": is no robot file" + other);
  return readRobot(readToml(file));
}

std::vector<Device> fillContainer(SensorContainer& container, const RobotConfig& robot,
                                  PluginFactory& factory) {
  std::vector<Device> devices;
  for (const SensorConfig& sensor : robot.sensors) {
    Device device{&sensor, {}, false, &container};
    try {
      for (auto& data : factory.makeData(sensor.plugin, sensor.parameters)) {
        const bool isTruth = data->id().type == "groundTruth";
        if (isTruth && !isOf(*data, formats::kPose))
          throw std::invalid_argument(toText(data->id()) +
                                      " is not a true pose; no other feature may "
                                      "have the type groundTruth");
        device.data.push_back(&container.add(std::move(data)));
        if (container.all().size() > kMostFeatures)
          throw std::invalid_argument("more than 4096 features");
      }
    } catch (const std::invalid_argument& error) {
      sensor.parameters.fail("plugin", "'" + sensor.plugin + "': " + error.what());
    }
    if (auto extractor = factory.makeIfThere<Extractor>(sensor.plugin, sensor.parameters)) {
      container.add(sensor.plugin, std::move(extractor), device.data);
      device.hasExtractor = true;
    }
    devices.push_back(std::move(device));
  }
  if (container.find({.type = "groundTruth"}) == nullptr) {
    container.add(std::make_unique<PoseData>(SensorId{"reference", "groundTruth", "pose"}));
  }
  try {
    container.connect();
  } catch (const std::invalid_argument& error) {
    throw ConfigError(robot.about.where() + ": " + error.what());
  }
  return devices;
}

SensorId sensorIdOf(const Parameters& sensor, const SensorId& defaults) {
  SensorId id{sensor.textOr("model", defaults.model), sensor.textOr("type", defaults.type),
              sensor.textOr("feature", defaults.feature)};
  try {
    parseSensorId(toText(id));
  } catch (const std::invalid_argument& error) {
    sensor.fail("model", std::string("and its companions: ") + error.what());
  }
  return id;
}

}  // namespace ortung
