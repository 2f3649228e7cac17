// A camera's table of a robot file: the input is the lines of [sensor.camera]. What is taken has
// directions and pixels that are numbers, and its text makes the same camera again. The whole robot
// file, with the features of its plugin, too.
#include <cmath>

#include "Fuzz.hpp"
#include "Paths.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/camera/CameraView.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/RobotText.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace {

using namespace ortung;

void look(const CameraView& view) {
  const ImageSize size = view.model().size();
  for (const double u : {0.0, 0.5 * size.width, size.width - 1.0, 1e300})
    for (const double v : {0.0, 0.3 * size.height, -1e300}) {
      if (const auto ray = view.rayAt({u, v}))
        fuzz::require(std::abs(std::hypot(ray->x, ray->y, ray->z) - 1.0) < 1e-6);
      if (const auto floor = view.floorAt({u, v}, 0.0))
        fuzz::require(std::isfinite(floor->x) && std::isfinite(floor->y));
    }
  for (const double x : {0.0, 0.4, -3.0, 1e9})
    if (const auto pixel = view.pixelOf({1.0, x, 0.1}))
      fuzz::require(std::isfinite(pixel->u) && std::isfinite(pixel->v));
}

void readTable(std::string_view text) {
  const CameraView view = readCameraView(parseToml(text, "camera", kMaxNetworkConfigBytes), 0.6);
  look(view);
  const std::string told = toToml(view);
  fuzz::require(toToml(readCameraView(parseToml(told, "told"), 0.6)) == told);
}

void readWhole(std::string_view text) {
  static PluginFactory factory({ORTUNG_PLUGINS_DIR});
  // A plugin has more settings than the camera alone, which the input may begin with.
  const std::string file =
      "[robot]\nname = \"eyes\"\n[[sensor]]\nplugin = \"camera\"\nmodel = \"front\"\npose = { z_m "
      "= 0.6 "
      "}\n[sensor.camera]\n" +
      std::string(text);
  SensorContainer container;
  fillContainer(container, readRobot(fuzz::write("robot.toml", file)), factory);
  for (const auto& data : container.all()) {
    data->format();
    data->learningKey();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  fuzz::refusedOrDone<ConfigError, PluginError>([&] { readTable(text); });
  fuzz::refusedOrDone<ConfigError, PluginError>([&] { readWhole(text); });
  return 0;
}
