#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {

/// What a sensor gets wrong always in the same way.
enum class NoiseTerm : std::uint8_t {
  kRangeBias,    ///< by which ranges are too long [m]
  kBearingBias,  ///< by which bearings are too large [rad]
  kMountX,       ///< where the sensor is, beyond where the robot file says, robot frame [m]
  kMountY,
  kMountTheta,  ///< [rad]
  kLatency,     ///< how much older readings are than their stamps say [s]
  // Of sightings at range r and bearing b, see SightingBias; ranges are too long by
  kRangePerMetre,      ///< r times this
  kRangePerMetreRad,   ///< r b times this [1/rad]
  kRangePerMetreRad2,  ///< r b^2 times this [1/rad^2]
  // and bearings too large by
  kBearingPerRad,  ///< b times this
  kBearingPerRad2  ///< b^2 times this [1/rad]
};
inline constexpr std::size_t kNoiseTerms = 11;
template <class T>
using ByNoiseTerm = std::array<T, kNoiseTerms>;

/// One value of a reading beside its expectation at a known pose.
struct NoiseResidual {
  Timestamp stamp = 0;    ///< of the reading
  std::size_t log = 0;    ///< that it is of: of different logs errors are independent
  bool isAngle = false;   ///< [rad]; otherwise [m]
  double residual = 0.0;  ///< reading - expectation, [m] or [rad]
  double range = 0.0;     ///< with which the noise grows [m]; not of angles
  /// How the residual grows with each term.
  ByNoiseTerm<double> by{};
};

/// A number with its standard error.
struct Learned {
  double value = 0.0;
  double error = std::numeric_limits<double>::quiet_NaN();
};

/// The noise of distances, or of angles.
struct NoiseShape {
  std::size_t values = 0;  ///< that it was learned from; 0: nothing is known
  Learned sigma;           ///< at range 0 [m] or [rad]
  Learned sigmaPerMetre;   ///< of distances
  Learned outliers;        ///< share of values that lie anywhere, in [0, 1]
  /// p of an outlier, relative to that of a perfect reading: SensorModel::outliers.
  double floor = 0.0;
  /// For how many independent values one counts, in (0, 1]: what is wrong for 10 s is wrong once.
  double independent = 1.0;
};

/// What fitNoise() found.
struct NoiseFit {
  ByNoiseTerm<Learned> terms;
  ByNoiseTerm<bool> isKnown{};  ///< false: not asked for, or less than three errors from none
  NoiseShape distances;
  NoiseShape angles;
};

/// Fits the mixture of the sensor model, a Gaussian and values anywhere, to residuals by
/// expectation maximization, with the terms that residuals have in common. A term that is not three
/// standard errors away from none is none. Errors are of blocks of 10 s (the sandwich of Huber
/// 1967, clustered), since what is wrong with one reading is wrong with the next one.
/// @param wanted terms to learn; of others nothing is said
/// @param already values of the terms for which the residuals were made
/// @throws std::invalid_argument if fewer than 50 residuals are of a kind that occurs
ORTUNG_API NoiseFit fitNoise(std::span<const NoiseResidual> residuals,
                             const ByNoiseTerm<bool>& wanted,
                             const ByNoiseTerm<double>& already = {});

}  // namespace ortung
