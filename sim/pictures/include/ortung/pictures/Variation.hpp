#pragma once

#include <array>
#include <cstdint>

#include "ortung/base/Export.hpp"
#include "ortung/sim_api/Drawing.hpp"

namespace ortung {

/// What lens and sensor of a camera do to a picture, in this order.
struct SensorEffects {
  float blur = 0.0F;  ///< share of a pixel's light that goes to each neighbour, in [0, 0.25]
  Rgb gains{1.0F, 1.0F, 1.0F};  ///< exposure and white balance
  float vignetting = 0.0F;      ///< share of light that is lost in the corners
  float noise = 0.0F;           ///< sigma where it is dark, in steps of a byte
  float shotNoise = 0.0F;       ///< what is added to it where it is as bright as can be
};

/// How a venue looks, drawn by a seed: light, floor, exposure, noise. With strength 0 all is even,
/// sharp and without noise, whatever the seed.
struct Variation {
  double strength = 0.0;  ///< in [0, 1]
  std::uint64_t seed = 0;
};

ORTUNG_API Lighting lightingOf(const Variation& variation);
ORTUNG_API SensorEffects effectsOf(const Variation& variation);

}  // namespace ortung
