#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Random.hpp"
#include "ortung/learning/Batch.hpp"

namespace ortung::learning::test {

/// FNV-1a over the bits of numbers.
class Hash {
 public:
  void add(std::span<const float> numbers) {
    for (const float number : numbers) add(std::bit_cast<std::uint32_t>(number));
  }
  void add(std::span<const double> numbers) {
    for (const double number : numbers) add(std::bit_cast<std::uint64_t>(number));
  }
  void add(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) add(std::uint64_t{byte});
  }
  std::uint64_t value() const { return hash_; }

 private:
  void add(std::uint64_t word) {
    for (int i = 0; i < 64; i += 8) hash_ = (hash_ ^ ((word >> i) & 0xff)) * 1099511628211U;
  }
  std::uint64_t hash_ = 14695981039346656037U;
};

/// What the shipped heuristic does in all episodes.
inline std::vector<float> heuristicActions(const Batch& batch) {
  const EnvironmentInfo& info = batch.info();
  const std::size_t agents = info.agents.size();
  const std::size_t seen = info.observation.size();
  const std::size_t width = info.actionSize();
  std::vector<float> actions(batch.size() * agents * width);
  for (std::size_t i = 0; i < batch.size() * agents; ++i)
    heuristic(info, i % agents, batch.observations().subspan(i * seen, seen),
              std::span(actions).subspan(i * width, width));
  return actions;
}

template <class Act>
std::uint64_t playedHash(Batch& batch, int steps, const Act& act) {
  Hash hash;
  hash.add(batch.observations());
  for (int i = 0; i < steps; ++i) {
    batch.step(act(batch));
    hash.add(batch.observations());
    hash.add(batch.rewards());
    hash.add(batch.endings());
    hash.add(batch.states());
  }
  return hash.value();
}

inline std::uint64_t playedHash(Batch& batch, int steps) {
  return playedHash(batch, steps, heuristicActions);
}
/// Of actions that depend on nothing that may become better.
inline std::uint64_t randomlyPlayedHash(Batch& batch, int steps) {
  Random random(1);
  return playedHash(batch, steps, [&](const Batch&) {
    std::vector<float> actions(batch.size() * batch.info().agents.size() *
                               batch.info().actionSize());
    for (float& number : actions) number = static_cast<float>(random.uniform(-1.0, 1.0));
    return actions;
  });
}

/// How many of the episodes that were begun ended so, by the heuristic.
struct Score {
  double episodes = 0.0;
  double goals = 0.0;
  double saves = 0.0;
};
template <class Act>
Score play(Batch& batch, int steps, const Act& act) {
  Score score;
  for (int i = 0; i < steps; ++i) {
    batch.step(act(batch));
    for (const std::uint8_t ending : batch.endings()) {
      score.episodes += ending != 0;
      score.goals += ending == static_cast<std::uint8_t>(Ending::kGoal);
      score.saves += ending == static_cast<std::uint8_t>(Ending::kSaved);
    }
  }
  return score;
}

}  // namespace ortung::learning::test
