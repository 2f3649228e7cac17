#pragma once

#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"

namespace ortung {

/// p(reading | expectation) of one feature: a Gaussian with outliers (paper, section 5.2).
/// For a residual r: p = (1 - outliers) exp(-r^2 / 2 sigma^2) + outliers, so p is 1 for a perfect
/// match and `outliers` where nothing fits. The paper's table holds densities; we leave out the
/// factor 1 / (sigma sqrt(2 pi)), which is the same for all poses, to keep p in [0, 1].
struct ORTUNG_API SensorModel {
  double sigma = 0.05;         ///< standard deviation at range 0 [m or rad], positive
  double sigmaPerMetre = 0.0;  ///< growth of sigma with range [m/m] or [rad/m]
  double outliers = 0.05;      ///< floor of p, in (0, 1)
  double maxRangeMass = 0.2;   ///< floor of p for a reading of "nothing within range", in (0, 1)
  double exponent = 1.0;       ///< p is raised to this: below 1 where readings are not independent

  /// Returns the standard deviation at a range [m].
  double sigmaAt(double range) const { return sigma + sigmaPerMetre * range; }
  /// Returns ln p for a residual of @p sigmas standard deviations, exponent not applied.
  double logProbability(double sigmas) const;
  /// Returns ln outliers with the exponent applied: what a sample without expectation gets.
  double logFloor() const;

  /// Reads sigma (key @p sigmaKey, in the unit that its ending says), sigma_per_m, outliers,
  /// max_range_mass and exponent; what is missing keeps the value it has in @p defaults.
  static SensorModel read(const Parameters& p, const std::string& sigmaKey,
                          const SensorModel& defaults);
};

/// A table of ln p by residual, computed once: the paper's second table, over |r| / sigma.
/// Immutable once made.
class ORTUNG_API GaussianTable {
 public:
  explicit GaussianTable(const SensorModel& model);
  /// Returns ln p^exponent of a residual of @p sigmas standard deviations, which may be negative.
  float operator()(float sigmas) const { return atPlace(placeOf(sigmas)); }

  /// In two steps, for loops: where a residual is in the table, and what is there.
  static int placeOf(float sigmas) {
    const float place = (sigmas < 0 ? -sigmas : sigmas) * kPerSigma;
    return static_cast<int>((place < kFloorPlace ? place : kFloorPlace) + 0.5F);
  }
  float atPlace(int place) const { return values_[static_cast<std::size_t>(place)]; }
  /// Last entry of the table, at 8 sigma; from there on only the floor is left.
  static constexpr int kFloorPlace = 1023;

 private:
  static constexpr float kPerSigma = 128.0F;
  static constexpr int kSize = kFloorPlace + 1;
  std::vector<float> values_;
};

}  // namespace ortung
