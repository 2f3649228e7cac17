#include "IconicSensor.hpp"

#include "ortung/core/Plugin.hpp"

namespace ortung {
namespace {

class IconicOmnivision : public IconicSensor {
 public:
  explicit IconicOmnivision(const Parameters& p) : IconicSensor(readOmnivisionSettings(p)) {}
};

class IconicCamera : public IconicSensor {
 public:
  explicit IconicCamera(const Parameters& p) : IconicSensor(readCameraSettings(p)) {}
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("iconic_sensor",
               ortung::provide<ortung::Sensor, ortung::IconicOmnivision>("iconic_omnivision"),
               ortung::provide<ortung::Sensor, ortung::IconicCamera>("iconic_camera"));
