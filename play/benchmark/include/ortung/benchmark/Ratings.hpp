#pragma once

#include <cstdint>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/benchmark/GoalMatrix.hpp"
#include "ortung/benchmark/Rates.hpp"

namespace ortung {

/// The rating of a player over all its opponents.
struct Rating {
  /// Bradley and Terry (1952): the odds of a goal are 10^((striker - keeper) / 400).
  Interval points;
  Interval scoring;  ///< mean share of goals over its opponents, in [0, 1]
};

/// The ratings of all players of a matrix.
struct GoalRatings {
  std::vector<Rating> keepers;  ///< ratings in the matrix' order
  std::vector<Rating>
      /// Ratings in the matrix' order; yardstick-v1 has 0 points if it is there, otherwise their
      /// mean is 0.
      strikers;
  /// The greatest error of the share of goals of a pair as the ratings predict it. If it is large,
  /// results depend on the pairing, not on strength alone.
  double worstMiss = 0.0;
  std::size_t worstKeeper = 0;
  std::size_t worstStriker = 0;
};

/// Computes the maximum-likelihood ratings, with half an episode of each outcome added to each pair
/// so that they are finite; 95 % intervals are by bootstrap over the episodes' numbers, for all
/// pairs together.
ORTUNG_API GoalRatings rate(const GoalMatrix& matrix, std::size_t resamples = 500);

}  // namespace ortung
