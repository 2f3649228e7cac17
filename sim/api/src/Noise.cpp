#include "ortung/sim_api/Noise.hpp"

#include <algorithm>

namespace ortung {

double noisyRange(double range, double sigma, double sigmaPerMetre, Random& noise) {
  return std::max(range + (sigma + sigmaPerMetre * range) * noise.gaussian(), 0.0);
}

std::optional<Sighting> detected(const Sighting& truth, const SightingNoise& noise,
                                 Random& random) {
  if (random.uniform() < noise.missedShare) return std::nullopt;
  return Sighting{noisyRange(truth.range, noise.rangeSigma, noise.rangeSigmaPerMetre, random),
                  wrapAngle(truth.bearing + noise.bearingSigma * random.gaussian())};
}

std::optional<Sighting> falseSighting(const Eye& eye, const SightingNoise& noise, Random& random) {
  if (!(random.uniform() < noise.falseShare)) return std::nullopt;
  const double range = random.uniform(eye.minRange, eye.maxRange);
  return Sighting{range, wrapAngle(eye.fieldOfView * (random.uniform() - 0.5))};
}

}  // namespace ortung
