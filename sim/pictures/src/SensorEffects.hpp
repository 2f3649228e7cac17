#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ortung/camera/CameraModel.hpp"
#include "ortung/pictures/Variation.hpp"

namespace ortung {

/// Lets light go to neighbouring pixels. @param share of a pixel that goes to each of the two
/// along each axis, of 256
void blur(std::span<std::uint32_t> pixels, ImageSize size, std::uint32_t share,
          std::vector<std::uint32_t>& row);

/// Exposure, white balance, vignetting and noise, on rows of bytes red, green, blue.
class EffectRows {
 public:
  EffectRows(const SensorEffects& effects, ImageSize size);

  /// Noise of a whole picture is one stream of a seed's numbers.
  struct Noise {
    std::uint64_t seed = 0;
    std::uint64_t stream = 0;
  };
  void apply(int row, const std::optional<Noise>& noise, std::span<std::uint8_t> rgb);

 private:
  SensorEffects effects_;
  ImageSize size_;
  std::vector<float> gains_;   ///< by byte of a row
  std::vector<float> losses_;  ///< of gains, for each unit of squared distance from the middle row
  std::vector<float> numbers_;
};

}  // namespace ortung
