#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ortung/camera/CameraModel.hpp"
#include "ortung/pictures/Variation.hpp"

namespace ortung {

/// Blurs rows of a picture.
class BlurredRows {
 public:
  /// @param share the share of a pixel's light that goes to each of its two neighbours along each
  /// axis, of 256; 0: none
  BlurredRows(std::uint32_t share, int width)
      : share_(share),
        between_(static_cast<std::size_t>(width) + 2),
        out_(static_cast<std::size_t>(width)) {}

  bool isSharp() const { return share_ == 0; }
  /// Returns a row, valid until the next call. @param above, below the rows beside it; at the
  /// picture's edge the row itself
  std::span<const std::uint32_t> blur(const std::uint32_t* above, const std::uint32_t* here,
                                      const std::uint32_t* below);

 private:
  std::uint32_t share_;
  std::vector<std::uint32_t> between_;
  std::vector<std::uint32_t> out_;
};

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
  std::vector<float> places_;  ///< place of each run's noise in a table, as a share of it
};

}  // namespace ortung
