#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "ortung/base/Export.hpp"
#include "ortung/learning/Environments.hpp"

namespace ortung::learning {

/// How an episode that is over is reset (the terms are Gymnasium's).
enum class Autoreset : std::uint8_t {
  kNextStep,  ///< the next step begins a new episode: it takes no action and gives no reward
  /// The step that ends it begins a new one; finalObservations() has its last observation.
  kSameStep,
  kDisabled  ///< the caller resets it
};

/// How an episode ended.
enum class Ending : std::uint8_t { kNone, kGoal, kSaved, kOut, kTime };
/// Returns "none", "goal", "saved", "out" or "time".
ORTUNG_API std::string_view nameOf(Ending ending);

/// The settings of a batch.
struct ORTUNG_API BatchConfig {
  std::size_t episodes = 1;  ///< number of parallel episodes, at most 65536
  unsigned threads = 1;      ///< number of threads; 0: as many as the machine has
  Autoreset autoreset = Autoreset::kNextStep;
  std::uint64_t seed = 1;  ///< base of the seeds: episode i has seed + i
  /// Checks it. @throws std::invalid_argument naming the field, its value and what was expected
  void check() const;
};

/// N episodes of one environment, which are stepped by one call on all threads.
/// An episode is a function of the environment's id, its options, seed, number and actions alone,
/// independent of the other episodes and of the threads. The number is 0 after a reset with a seed,
/// and one more for each further episode in the same place. All arrays are contiguous and stay
/// where they are; they are valid until the next call. Not thread-safe.
class ORTUNG_API Batch {
 public:
  /// Makes the episodes and begins all of them.
  /// @throws std::invalid_argument for an unknown id or a bad config; ConfigError, PluginError for
  ///   options and players
  Batch(std::string_view id, const Options& options, const BatchConfig& config);
  ~Batch();
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  /// Return the environment, the number N of episodes and the kind of reset.
  const EnvironmentInfo& info() const;
  std::size_t size() const;
  Autoreset autoreset() const;

  /// Restarts all episodes with seeds of their own, shape (N), and number 0.
  void reset(std::span<const std::uint64_t> seeds);
  /// Begins the next episode in each place.
  void reset();
  /// Begins one episode: with a seed number 0, without one the next number.
  void reset(std::size_t episode, std::optional<std::uint64_t> seed);
  /// Begins episodes in some places on all threads; the others stay where they are.
  /// @param places flags, shape (N)
  /// @param seeds shape (N), or empty: as for reset() of one episode; those of other places are not
  ///   used
  /// @throws std::invalid_argument for other sizes; then nothing has changed
  void reset(std::span<const std::uint8_t> places,
             std::span<const std::optional<std::uint64_t>> seeds);
  /// Set the options for episodes that begin from now on, in all places or in one. @throws
  /// ConfigError, PluginError; then nothing has changed
  void setOptions(const Options& options);
  void setOptions(std::size_t episode, const Options& options);

  /// Records what the robot of the first agent reads, with its true pose, in each episode that
  /// begins in a place from now on. The record is whole when the episode is over. A record that is
  /// being written ends.
  /// @param file in which "{seed}" and "{number}" stand for those of the episode; without them it
  ///   has the latest episode. "": nothing is recorded. If it can't be written, or holds something
  ///   else than a record, the episode can't begin: std::runtime_error
  void record(std::size_t episode, const std::filesystem::path& file);

  /// Steps all episodes by 0.1 s (option `action_s`).
  /// @param actions shape (N, agents, actionSize); numbers are clamped to [-1, 1]
  /// @throws std::invalid_argument for another size or numbers that are not finite,
  ///   std::logic_error for an episode that is over (Autoreset::kDisabled); then nothing has
  ///   changed. std::runtime_error that names seed and number if a player was stopped
  void step(std::span<const float> actions);

  std::span<const float> observations() const;  ///< observations, shape (N, agents, observation)
  /// Last observations of episodes that ended in this step, the same shape.
  std::span<const float> finalObservations() const;
  std::span<const double> rewards() const;  ///< rewards, shape (N, agents)
  /// Whether episodes have ended, but not by time, shape (N).
  std::span<const std::uint8_t> terminated() const;
  std::span<const std::uint8_t> truncated() const;  ///< whether their time has run out, shape (N)
  /// Ending of each episode that ended in this step, shape (N).
  std::span<const std::uint8_t> endings() const;
  std::span<const std::uint64_t> seeds() const;    ///< seeds of the episodes, shape (N)
  std::span<const std::uint64_t> numbers() const;  ///< numbers of the episodes, shape (N)
  /// Returns the true state, which is the same for all environments, shape (N, 12): time [s]; ball
  /// x, y, velocity x, y; keeper x, y, heading; striker x, y, heading, in the field frame [m],
  /// [m/s], [rad]; whether the ball was shot (0, 1).
  std::span<const float> states() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung::learning
