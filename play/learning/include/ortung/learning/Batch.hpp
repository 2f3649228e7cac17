#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "ortung/base/Export.hpp"
#include "ortung/learning/Environments.hpp"

namespace ortung::learning {

/// What becomes of an episode that is over (the words are Gymnasium's).
enum class Autoreset : std::uint8_t {
  nextStep,  ///< the next step begins the next one: it takes no action and gives no reward
  sameStep,  ///< the step that ends it begins the next one; finalObservations() has its end
  disabled   ///< whoever steps resets
};

/// How an episode ended.
enum class Ending : std::uint8_t { none, goal, saved, out, time };
ORTUNG_API std::string_view nameOf(Ending ending);

struct ORTUNG_API BatchConfig {
  std::size_t episodes = 1;  ///< that run beside each other, at most 65536
  unsigned threads = 1;      ///< 0: as many as the machine has
  Autoreset autoreset = Autoreset::nextStep;
  std::uint64_t seed = 1;  ///< episode i has seed + i
  /// @throws std::invalid_argument naming the field, its value and what was expected
  void check() const;
};

/// N episodes of one environment, which one call steps on all threads.
///
/// What an episode becomes is a function of the environment's id, its options, seed, number and
/// actions alone, whatever other episodes there are and whoever steps them. Number 0 comes with the
/// seed; each episode behind it in the same place has one more. All arrays are contiguous and stay
/// where they are; they are valid until the next call. Not thread-safe.
class ORTUNG_API Batch {
 public:
  /// All episodes stand at their beginning.
  /// @throws std::invalid_argument for an unknown id or a bad config; ConfigError, PluginError for
  ///   options and players
  Batch(std::string_view id, const Options& options, const BatchConfig& config);
  ~Batch();
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  const EnvironmentInfo& info() const;
  std::size_t size() const;
  Autoreset autoreset() const;

  /// Begins all anew with seeds of their own, size N, and number 0.
  void reset(std::span<const std::uint64_t> seeds);
  /// The next episode of each.
  void reset();
  /// One of them; without a seed its next number.
  void reset(std::size_t episode, std::optional<std::uint64_t> seed);
  /// Options from now on, for episodes that begin: of one of them, or of all.
  /// @throws ConfigError, PluginError; then nothing has changed
  void setOptions(const Options& options);
  void setOptions(std::size_t episode, const Options& options);

  /// One step of 0.1 s (option `action_s`) of all.
  /// @param actions shape (N, agents, actionSize), numbers beyond -1 and 1 count as these
  /// @throws std::invalid_argument for another size or numbers that are none, std::logic_error for
  ///   an episode that is over (Autoreset::disabled); then nothing has moved. std::runtime_error
  ///   that names seed and number for a player that was stopped
  void step(std::span<const float> actions);

  std::span<const float> observations() const;       ///< (N, agents, observation)
  std::span<const float> finalObservations() const;  ///< the same, of what ended in this step
  std::span<const double> rewards() const;           ///< (N, agents)
  std::span<const std::uint8_t> terminated() const;  ///< (N)
  std::span<const std::uint8_t> truncated() const;   ///< (N)
  std::span<const std::uint8_t> endings() const;     ///< (N), Ending: of what ended in this step
  std::span<const std::uint64_t> seeds() const;      ///< (N)
  std::span<const std::uint64_t> numbers() const;    ///< (N)
  /// The world as it is, the same for all environments (N, 12): time [s]; ball x, y, velocity x, y;
  /// keeper x, y, heading; striker x, y, heading, in the field frame [m], [rad]; whether the ball
  /// was shot (0, 1).
  std::span<const float> states() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung::learning
