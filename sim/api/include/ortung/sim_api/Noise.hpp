#pragma once

#include <optional>

#include "ortung/base/Export.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/sim_api/Sight.hpp"

/// Errors that make simulated readings as inaccurate as real ones.
namespace ortung {

/// The errors of a sensor that detects things.
struct SightingNoise {
  double rangeSigma = 0.0;          ///< standard deviation of the range error at range 0 [m]
  double rangeSigmaPerMetre = 0.0;  ///< growth of that standard deviation with range [m/m]
  double bearingSigma = 0.0;        ///< standard deviation of the bearing error [rad]
  double missedShare = 0.0;         ///< probability that something visible is missed
  double falseShare = 0.0;          ///< probability of a false detection per call
};

/// Returns a range with Gaussian noise that grows with range [m]; not below 0.
ORTUNG_API double noisyRange(double range, double sigma, double sigmaPerMetre, Random& noise);

/// Simulates the detection of something visible: returns its place with noise, or nothing if it is
/// missed.
ORTUNG_API std::optional<Sighting> detected(const Sighting& truth, const SightingNoise& noise,
                                            Random& random);

/// Returns a false detection with probability falseShare, evenly distributed in range and bearing
/// within the eye's field of view; otherwise nothing.
ORTUNG_API std::optional<Sighting> falseSighting(const Eye& eye, const SightingNoise& noise,
                                                 Random& random);

}  // namespace ortung
