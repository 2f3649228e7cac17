// A robot file from the network: read, made into features by the plugins, which then take words.
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "Paths.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/robot/NetworkRobot.hpp"

namespace {

using namespace ortung;

constexpr std::size_t kMostSensors = 16;  // as the server has it

void takeWords(SensorContainer& container, std::string_view text) {
  std::vector<std::uint32_t> words;
  for (const std::unique_ptr<SensorData>& data : container.all()) {
    words.push_back(static_cast<std::uint32_t>(text.size()) * 2654435761u);
    try {
      data->setData(0, words);
      if (data->localizes()) data->learningKey();
    } catch (const std::invalid_argument&) {
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static PluginFactory factory({ORTUNG_PLUGINS_DIR});
  static const std::vector<std::string> plugins = {
      "compass",   "differential", "ground_truth",  "iconic_camera", "iconic_omnivision",
      "landmarks", "lrf",          "lrf_cylinders", "lrf_iconic",    "neural",
      "odometry",  "omni",         "sonar"};
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  try {
    const RobotConfig robot = readNetworkRobot(text, "robot file", plugins);
    if (robot.sensors.size() > kMostSensors) return 0;
    SensorContainer container;
    fillContainer(container, robot, factory);
    takeWords(container, text);
  } catch (const ConfigError&) {
  } catch (const PluginError& error) {
    // Each plugin of the list is there: another error would hide what is to be found.
    if (std::string_view(error.what()).find("no plugin") != std::string_view::npos) throw;
  }
  return 0;
}
