#pragma once

#include "../common/SensorSettings.hpp"
#include "ortung/camera/CameraView.hpp"
#include "ortung/camera/ImageData.hpp"

namespace ortung {

/// Settings of both halves of the camera.
struct CameraSettings {
  SensorId id;
  Mounting mounting;
  CameraView camera;
  double period = 0.1;     ///< time between two pictures [s]
  double variation = 0.0;  ///< strength of the variation of simulated pictures, in [0, 1]
  std::uint64_t seed = 0;  ///< seed of the variation
};

/// Reads all settings of both halves. @throws ConfigError
inline CameraSettings readCameraSettings(const Parameters& p) {
  const SensorId id = sensorIdOf(p, {"camera", "camera", "image"});
  const Mounting mounting = readMounting(p, 0.7);
  const Parameters camera = p.table("camera");
  CameraSettings s{id, mounting, readCameraView(camera, mounting.z)};
  const ImageSize size = s.camera.model().size();
  if (std::max(size.width, size.height) > ImageData::kMostSide)
    camera.fail("size_px", "is " + std::to_string(size.width) + " x " +
                               std::to_string(size.height) + ", must be at most " +
                               std::to_string(ImageData::kMostSide) + " to a side");
  s.period = readPeriod(p, 0.1);
  s.variation = readShare(p, "variation");
  s.seed = static_cast<std::uint64_t>(p.integerOr("seed", 0, {0.0, 9e15}));
  return s;
}

}  // namespace ortung
