#pragma once

#include <cstdint>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/benchmark/GoalMatrix.hpp"
#include "ortung/benchmark/Rates.hpp"

namespace ortung {

/// What one player's figures say over all that it has played against.
struct Rating {
  /// Bradley and Terry (1952): the odds of a goal are 10^((striker - keeper) / 400).
  Interval points;
  Interval scoring;  ///< mean share of goals over its opponents
};

struct GoalRatings {
  std::vector<Rating> keepers;  ///< in the matrix' order
  std::vector<Rating>
      strikers;  ///< yardstick-v1 has 0 points, if it is there; else their mean is 0
  /// How far the ratings alone miss the share of goals of a pair, at most: where it is large, who
  /// beats whom is not a matter of strength alone.
  double worstMiss = 0.0;
  std::size_t worstKeeper = 0;
  std::size_t worstStriker = 0;
};

/// Most likely ratings, with half an episode of each outcome added to each pair so that they are
/// finite; intervals of 95 % by bootstrap over the numbers of episodes, all pairs together.
ORTUNG_API GoalRatings rate(const GoalMatrix& matrix, std::size_t resamples = 500);

}  // namespace ortung
