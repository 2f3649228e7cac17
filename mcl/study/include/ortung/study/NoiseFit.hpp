#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {

/// A term of a sensor's systematic error.
enum class NoiseTerm : std::uint8_t {
  kRangeBias,    ///< error by which ranges are too long [m]
  kBearingBias,  ///< error by which bearings are too large [rad]
  kMountX,       ///< x of the sensor's mount beyond the robot file's, robot frame [m]
  kMountY,       ///< y of the mount beyond the robot file's [m]
  kMountTheta,   ///< heading of the mount beyond the robot file's [rad]
  kLatency,      ///< age of readings at their stamps [s]
  // Terms of sightings at range r [m] and bearing b [rad], see SightingBias:
  kRangePerMetre,      ///< ranges are too long by r times this [m/m]
  kRangePerMetreRad,   ///< ranges are too long by r b times this [1/rad]
  kRangePerMetreRad2,  ///< ranges are too long by r b^2 times this [1/rad^2]
  kBearingPerRad,      ///< bearings are too large by b times this [rad/rad]
  kBearingPerRad2      ///< bearings are too large by b^2 times this [1/rad]
};
inline constexpr std::size_t kNoiseTerms = 11;
template <class T>
using ByNoiseTerm = std::array<T, kNoiseTerms>;

/// One value of a reading with its expectation at a known pose.
struct NoiseResidual {
  Timestamp stamp = 0;    ///< stamp of the reading [us]
  std::size_t log = 0;    ///< number of its log; errors of different logs are independent
  bool isAngle = false;   ///< whether it is an angle [rad]; else it is a length [m]
  double residual = 0.0;  ///< reading - expectation, [m] or [rad]
  double range = 0.0;     ///< range with which the noise grows [m]; not used for angles
  /// Derivative of the residual by each term.
  ByNoiseTerm<double> by{};
};

/// A number with its standard error.
struct Learned {
  double value = 0.0;  ///< in the unit of the term
  /// Standard error, in the same unit; NaN if it is not known.
  double error = std::numeric_limits<double>::quiet_NaN();
};

/// The noise of distances, or of angles.
struct NoiseShape {
  std::size_t values = 0;  ///< number of values that it was learned from; zero: not known
  Learned sigma;           ///< standard deviation at range 0 [m] or [rad]
  Learned sigmaPerMetre;   ///< growth of sigma with range, for distances [m/m]
  Learned outliers;        ///< share of outliers, which are distributed uniformly, in [0, 1]
  /// p of an outlier, relative to that of a perfect reading: SensorModel::outliers.
  double floor = 0.0;
  /// Number of independent values that one value counts for, in (0, 1], since errors of 10 s are
  /// correlated.
  double independent = 1.0;
};

/// The result of fitNoise().
struct NoiseFit {
  ByNoiseTerm<Learned> terms;   ///< values of the terms, in their units
  ByNoiseTerm<bool> isKnown{};  ///< whether a term is wanted and at least three errors from zero
  NoiseShape distances;         ///< noise of lengths [m]
  NoiseShape angles;            ///< noise of angles [rad]
};

/// Fits the mixture of the sensor model, a Gaussian and uniform outliers, to residuals by
/// expectation maximization, with the terms that residuals have in common. A term less than three
/// standard errors from zero is left out. Standard errors are clustered by blocks of 10 s (the
/// sandwich of Huber 1967), since errors of consecutive readings are correlated.
/// @param wanted terms to learn; the others stay unknown
/// @param already values of the terms for which the residuals were made
/// @throws std::invalid_argument if fewer than 50 residuals are of a kind that occurs
ORTUNG_API NoiseFit fitNoise(std::span<const NoiseResidual> residuals,
                             const ByNoiseTerm<bool>& wanted,
                             const ByNoiseTerm<double>& already = {});

}  // namespace ortung
