#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/camera/CameraView.hpp"
#include "ortung/pictures/CameraSheet.hpp"
#include "ortung/pictures/Variation.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

/// Returns the pose of a camera that is attached to a sensor's mount. @param sensor the sensor's
/// pose in the field frame
ORTUNG_API CameraPose cameraPoseOf(const CameraView& camera, const Pose2& sensor);

/// Takes the pictures of one camera in a simulated world. Not thread-safe: it reuses its buffers.
class ORTUNG_API CameraPicture {
 public:
  /// @throws std::invalid_argument for a camera that sees nothing or whose pictures have more than
  ///   4096 pixels to a side
  explicit CameraPicture(CameraView camera, const Variation& variation = {});
  ~CameraPicture();

  const CameraView& camera() const { return camera_; }
  const CameraSheet& sheet() const { return sheet_; }
  /// Changes how the venue looks from the next picture on.
  void setVariation(const Variation& variation);

  /// The random stream of one picture's noise; the same numbers give the same noise.
  struct Noise {
    std::uint64_t seed = 0;
    std::uint64_t stream = 0;
  };

  /// Takes a picture, as words of ImageData.
  /// @param sensor the sensor's pose in the field frame
  /// @param self the robot that carries the camera, which is not drawn
  /// @param noise nothing: without noise
  /// @param words out: the picture
  /// @throws std::runtime_error as World::draw()
  void take(const World& world, const Pose2& sensor, RobotNumber self,
            const std::optional<Noise>& noise, std::vector<std::uint32_t>& words);

  /// Writes what the ray through each pixel's middle meets. It needs no OpenGL.
  /// @throws std::invalid_argument unless both have as many entries as the picture has pixels
  void annotate(const World& world, const Pose2& sensor, RobotNumber self,
                std::span<std::uint32_t> things, std::span<float> ranges);

 private:
  struct Effects;
  Drawing drawing(const Pose2& sensor, RobotNumber self) const;
  const std::uint32_t* drawnRow(int row);
  void develop(const std::optional<Noise>& noise, std::span<std::uint8_t> rgb);

  static constexpr int kRows = 3;  ///< number of composed rows that are kept

  CameraView camera_;
  CameraSheet sheet_;
  Lighting lighting_;
  std::unique_ptr<Effects> effects_;  ///< the effects to be applied; null: none
  std::vector<std::uint32_t> colours_;
  std::vector<std::uint32_t> composed_;     ///< newest rows that were composed of the faces
  std::vector<std::array<float, 3>> rays_;  ///< rays of all pixels; none until they are needed
};

}  // namespace ortung
