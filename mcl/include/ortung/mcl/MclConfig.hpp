#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"

namespace ortung {

/// Settings of MCL; the defaults work. In files: the table [mcl] of a robot file.
struct MclConfig {
  std::size_t maxSamples = 20000;  ///< `particles`: greatest number of samples
  std::size_t minSamples = 500;    ///< `min_particles`: least number of samples
  double resampleBelow = 0.5;      ///< `resample_below`: effective share of samples, in [0, 1]
  double kldError = 0.02;          ///< `kld_error`: bound of the KLD-adaptive size (Fox 2003)
  double kldQuantile = 2.33;       ///< `kld_quantile`: normal quantile of its probability (0.99)
  double binMetres = 0.25;         ///< `bin_m`: edge of a bin that counts as one place
  double binRadians = 0.1745;      ///< `bin_deg`: its extent in heading [rad] (10 degrees)
  double startCandidates = 500.0;  ///< `start_candidates_per_m2`: if readings are vague
  double recoverFast = 0.2;        ///< `recover_fast`: rate of the short-term fit average
  double recoverSlow = 0.01;       ///< `recover_slow`: rate of the long-term one; 0: no recovery
  double minDistance = 0.05;       ///< `min_distance_m`: weigh only after this much motion,
  double minRotation = 0.03;       ///< `min_rotation_deg`: or this much turning (1.7 degrees),
  double maxInterval = 0.5;        ///< `max_interval_s`: or this much time
  double driftMetres = 0.5;      ///< `drift_m`: without odometry, sigma of positions after 1 s [m],
  double driftRadians = 0.5236;  ///< `drift_deg`: and of headings (30 degrees) [rad]
  bool learnsBiases = true;      ///< `learns_biases`: learn biases of distances and bearings
  double budgetMs = 20.0;        ///< `budget_ms`: time of an update; searches are spread [ms]
  std::uint64_t seed = 1;        ///< seed of all random numbers
  unsigned threads = 1;          ///< number of threads; the result does not depend on it

  /// One key of [mcl]. Reading, checking and documentation all use the list of options().
  struct Option {
    enum class Kind : std::uint8_t { kNumber, kInteger, kFlag };
    const char* key;  ///< key in a robot file
    Kind kind;
    Range range;  ///< range of permitted values, in the unit that the key ends in
    double (*get)(const MclConfig&);  ///< reads the value in that unit; a flag gives 0 or 1
    void (*set)(MclConfig&, double);  ///< writes the value in that unit
  };
  /// Returns all keys of [mcl].
  ORTUNG_API static std::span<const Option> options();

  /// @throws std::invalid_argument naming the key that a field belongs to, its value and the range
  ORTUNG_API void check() const;
  /// Reads [mcl]; keys that are missing keep their default. @throws ConfigError
  ORTUNG_API static MclConfig read(const Parameters& mcl);
};

}  // namespace ortung
