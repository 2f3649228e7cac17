#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"

namespace ortung {

/// Settings of MCL; the defaults work. In files: the table [mcl] of a robot file.
struct MclConfig {
  std::size_t maxSamples = 20000;  ///< `particles`: most samples
  std::size_t minSamples = 500;    ///< `min_particles`
  double resampleBelow = 0.5;      ///< `resample_below`: effective share of samples, in [0, 1]
  double kldError = 0.02;          ///< `kld_error`: bound of the KLD-adaptive size (Fox 2003)
  double kldQuantile = 2.33;       ///< `kld_quantile`: of the normal distribution (0.99)
  double binMetres = 0.25;         ///< `bin_m`: edge of a bin that counts as one place
  double binRadians = 0.1745;      ///< `bin_deg` (10 degrees)
  double startCandidates = 500.0;  ///< `start_candidates_per_m2`: if readings are vague
  double recoverFast = 0.2;        ///< `recover_fast`: rate of the short-term fit average
  double recoverSlow = 0.01;       ///< `recover_slow`: of the long-term one; 0: no recovery
  double minDistance = 0.05;       ///< `min_distance_m`: weigh only after this much motion,
  double minRotation = 0.03;       ///< `min_rotation_deg`: or this much turning (1.7 degrees),
  double maxInterval = 0.5;        ///< `max_interval_s`: or this much time
  double driftMetres = 0.5;        ///< `drift_m`: without odometry, sigma of the way after 1 s [m],
  double driftRadians = 0.5236;    ///< `drift_deg`: and of the turn (30 degrees) [rad]
  bool learnsBiases = true;        ///< `learns_biases`: of distances and bearings, while it runs
  double budgetMs = 20.0;          ///< `budget_ms`: of an update; longer searches are spread [ms]
  std::uint64_t seed = 1;
  unsigned threads = 1;  ///< the result does not depend on it

  /// One key of [mcl]. What is read, refused and documented comes from the list of them.
  struct Option {
    enum class Kind : std::uint8_t { kNumber, kInteger, kFlag };
    const char* key;  ///< as a robot file has it
    Kind kind;
    Range range;  ///< of values that are taken, in the unit that the key ends in
    double (*get)(const MclConfig&);  ///< in that unit; a flag: 0 or 1
    void (*set)(MclConfig&, double);
  };
  ORTUNG_API static std::span<const Option> options();

  /// @throws std::invalid_argument naming the key that a field belongs to, its value and the range
  ORTUNG_API void check() const;
  /// Reads [mcl]; keys that are missing keep their default. @throws ConfigError
  ORTUNG_API static MclConfig read(const Parameters& mcl);
};

}  // namespace ortung
