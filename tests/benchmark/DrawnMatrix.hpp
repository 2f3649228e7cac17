#pragma once

#include <string>
#include <vector>

#include "ortung/base/Random.hpp"
#include "ortung/benchmark/GoalMatrix.hpp"

namespace ortung::test {

/// A matrix of episodes that were drawn, not played. @param shares of goals, by keeper and striker
inline GoalMatrix drawn(const std::vector<std::vector<double>>& shares, std::uint64_t episodes,
                        std::vector<std::string> strikers) {
  GoalMatrix matrix;
  for (std::size_t k = 0; k < shares.size(); ++k)
    matrix.config.keepers.push_back("keeper" + std::to_string(k));
  matrix.config.strikers = std::move(strikers);
  matrix.config.episodes = episodes;
  Random random(3, 1);
  for (std::size_t k = 0; k < shares.size(); ++k)
    for (std::size_t s = 0; s < shares[k].size(); ++s) {
      GoalCell cell{matrix.config.keepers[k], matrix.config.strikers[s], {}};
      for (std::uint64_t i = 0; i < episodes; ++i) {
        GoalEpisode episode;
        episode.outcome =
            random.uniform() < shares[k][s] ? GoalOutcome::kGoal : GoalOutcome::kSaved;
        cell.episodes.push_back(episode);
      }
      matrix.cells.push_back(std::move(cell));
    }
  return matrix;
}

}  // namespace ortung::test
