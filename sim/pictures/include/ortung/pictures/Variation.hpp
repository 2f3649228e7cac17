#pragma once

#include <array>
#include <cstdint>

#include "ortung/base/Export.hpp"
#include "ortung/sim_api/Drawing.hpp"

namespace ortung {

/// The effects of a camera's lens and sensor on a picture, in this order.
struct SensorEffects {
  float blur = 0.0F;  ///< share of a pixel's light that goes to each neighbour, in [0, 0.25]
  Rgb gains{1.0F, 1.0F, 1.0F};  ///< gains of exposure and white balance
  float vignetting = 0.0F;      ///< share of light that is lost in the corners
  float noise = 0.0F;           ///< standard deviation where it is dark, in steps of a byte
  /// Standard deviation that is added where it is brightest, in steps of a byte.
  float shotNoise = 0.0F;
};

/// A random appearance of a venue: light, floor, exposure, noise. With strength 0 the light is even
/// and pictures are sharp and without noise, whatever the seed.
struct Variation {
  double strength = 0.0;  ///< strength of the variation, in [0, 1]
  std::uint64_t seed = 0;
};

/// Return the light and floor, and the camera effects, of a variation.
ORTUNG_API Lighting lightingOf(const Variation& variation);
ORTUNG_API SensorEffects effectsOf(const Variation& variation);

}  // namespace ortung
