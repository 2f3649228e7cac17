#pragma once

#include <optional>

#include "ortung/base/Export.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/sim_api/Sight.hpp"

/// What makes simulated readings as bad as real ones.
namespace ortung {

/// How a sensor that detects things errs.
struct SightingNoise {
  double rangeSigma = 0.0;          ///< at range 0 [m]
  double rangeSigmaPerMetre = 0.0;  ///< grows by this per metre
  double bearingSigma = 0.0;        ///< [rad]
  double missedShare = 0.0;         ///< of what is visible
  double falseShare = 0.0;          ///< chance that something is detected that is not there
};

/// A range with Gaussian noise that grows with range [m]; not below 0.
ORTUNG_API double noisyRange(double range, double sigma, double sigmaPerMetre, Random& noise);

/// What becomes of something visible: nothing if it is missed, else its place with noise.
ORTUNG_API std::optional<Sighting> detected(const Sighting& truth, const SightingNoise& noise,
                                            Random& random);

/// Now and then (falseShare of the calls) a sighting of nothing, anywhere the eye looks: evenly in
/// range and bearing.
ORTUNG_API std::optional<Sighting> falseSighting(const Eye& eye, const SightingNoise& noise,
                                                 Random& random);

}  // namespace ortung
