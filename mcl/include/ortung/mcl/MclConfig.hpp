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
  double kldError = 0.02;      ///< `kld_error`: error of the KLD-adaptive size [nats] (Fox 2003)
  double kldQuantile = 2.33;   ///< `kld_quantile`: normal quantile of its probability (0.99)
  double binMetres = 0.25;     ///< `bin_m`: edge of a bin of the KLD-adaptive size [m]
  double binRadians = 0.1745;  ///< `bin_deg`: its extent in heading [rad], 10 degrees
  /// `start_candidates_per_m2`: candidates of a global start by vague readings [1/m^2].
  double startCandidates = 500.0;
  double recoverFast = 0.2;   ///< `recover_fast`: rate of the short-term fit average, in [0, 1]
  double recoverSlow = 0.01;  ///< `recover_slow`: rate of the long-term one; 0: no recovery
  // A feature is weighed again once the robot has moved or turned this much, or after this time.
  double minDistance = 0.05;  ///< `min_distance_m`: least distance moved between readings [m]
  double minRotation = 0.03;  ///< `min_rotation_deg`: least turn between readings [rad]
  double maxInterval = 0.5;   ///< `max_interval_s`: longest time between readings [s]
  // Without odometry, process noise moves the samples; its variance grows with time.
  double driftMetres = 0.5;      ///< `drift_m`: sigma of positions after 1 s [m]
  double driftRadians = 0.5236;  ///< `drift_deg`: sigma of headings after 1 s [rad], 30 degrees
  bool learnsBiases = true;      ///< `learns_biases`: learn biases of distances and bearings
  bool learnsOdometry = true;    ///< `learns_odometry`: learn odometry's errors from refined poses
  /// `watches_map`: notice where the map no longer fits, and weigh without what has changed
  bool watchesMap = true;
  /// `budget_ms`: nominal time of an update [ms]; longer searches are spread over several updates.
  double budgetMs = 20.0;
  std::uint64_t seed = 1;  ///< seed of all random numbers
  unsigned threads = 1;    ///< number of threads; the result does not depend on it

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

  /// Checks all fields.
  /// @throws std::invalid_argument naming the key that a field belongs to, its value and the range
  ORTUNG_API void check() const;
  /// Reads the table [mcl]; keys that are missing keep their default.
  /// @throws ConfigError for a value that is not in its range, or has another type
  ORTUNG_API static MclConfig read(const Parameters& mcl);
};

}  // namespace ortung
