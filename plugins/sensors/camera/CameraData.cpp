#include "CameraSettings.hpp"
#include "ortung/core/Plugin.hpp"

namespace ortung {
namespace {

DeviceData makeCamera(const Parameters& p) {
  const CameraSettings s = readCameraSettings(p);
  DeviceData data;
  data.push_back(std::make_unique<ImageData>(s.id, s.mounting.pose, s.camera));
  return data;
}

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("camera_data", ortung::provideData<ortung::makeCamera>("camera"));
