#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "Cameras.hpp"
#include "WorldFiles.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/pictures/CameraPicture.hpp"

namespace ortung::test {

/// A picture as the words that a camera gives.
struct Snapshot {
  std::vector<std::uint32_t> words;
  ImageSize size;

  int at(int u, int v, int channel) {
    const std::size_t pixel = static_cast<std::size_t>(v) * static_cast<std::size_t>(size.width) +
                              static_cast<std::size_t>(u);
    return ImageData::pixelsOf(words)[3 * pixel + static_cast<std::size_t>(channel)];
  }
};

inline Snapshot snap(CameraPicture& camera, const World& world, const Pose2& sensor,
                     RobotNumber self = 0,
                     const std::optional<CameraPicture::Noise>& noise = std::nullopt) {
  Snapshot snapshot;
  camera.take(world, sensor, self, noise, snapshot.words);
  snapshot.size = camera.camera().model().size();
  return snapshot;
}

inline CameraView viewOf(const std::string& toml, double z, double tilt, double roll = 0.0) {
  return CameraView(cameraOf(toml), {z, tilt, roll});
}

/// What each pixel shows.
struct Annotation {
  std::vector<std::uint32_t> things;
  std::vector<float> ranges;
  ImageSize size;

  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(size.width) +
           static_cast<std::size_t>(u);
  }
  PixelClass kind(int u, int v) const {
    return static_cast<PixelClass>(things[index(u, v)] & 0xFFU);
  }
  std::uint32_t object(int u, int v) const { return things[index(u, v)] >> 8; }
  /// Whether all pixels around show the same thing.
  bool isInside(int u, int v) const {
    for (int dv = -1; dv <= 1; ++dv)
      for (int du = -1; du <= 1; ++du)
        if (u + du < 0 || v + dv < 0 || u + du >= size.width || v + dv >= size.height ||
            things[index(u + du, v + dv)] != things[index(u, v)])
          return false;
    return true;
  }
};

inline Annotation annotate(CameraPicture& camera, const World& world, const Pose2& sensor,
                           RobotNumber self = 0) {
  Annotation all;
  all.size = camera.camera().model().size();
  const auto pixels =
      static_cast<std::size_t>(all.size.width) * static_cast<std::size_t>(all.size.height);
  all.things.resize(pixels);
  all.ranges.resize(pixels);
  camera.annotate(world, sensor, self, all.things, all.ranges);
  return all;
}

}  // namespace ortung::test
