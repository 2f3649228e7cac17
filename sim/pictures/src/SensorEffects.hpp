#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ortung/camera/CameraModel.hpp"
#include "ortung/pictures/Variation.hpp"

namespace ortung {

/// Blurs a picture. @param share the share of a pixel's light that goes to each of its two
/// neighbours along each axis, of 256
void blur(std::span<std::uint32_t> pixels, ImageSize size, std::uint32_t share,
          std::vector<std::uint32_t>& row);

/// Applies exposure, white balance, vignetting and noise to rows of bytes red, green, blue.
class EffectRows {
 public:
  EffectRows(const SensorEffects& effects, ImageSize size);

  /// The random stream of one picture's noise.
  struct Noise {
    std::uint64_t seed = 0;
    std::uint64_t stream = 0;
  };
  void apply(int row, const std::optional<Noise>& noise, std::span<std::uint8_t> rgb);

 private:
  SensorEffects effects_;
  ImageSize size_;
  std::vector<float> gains_;  ///< gain of each byte of a row
  /// Loss of gain of each byte per squared distance from the middle row.
  std::vector<float> losses_;
  std::vector<float> numbers_;
};

}  // namespace ortung
