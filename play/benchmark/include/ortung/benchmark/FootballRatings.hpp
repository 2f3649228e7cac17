#pragma once

#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/benchmark/FootballMatrix.hpp"

namespace ortung {

/// How strong a team is in a league, over all its opponents there, with 95 % intervals.
struct FootballRating {
  /// Bradley and Terry (1952): the odds of a win are 10^((team - opponent) / 400); a draw counts as
  /// half a win.
  Interval points;
  Interval won;         ///< share of halves won, draws as half, in [0, 1]
  Interval difference;  ///< goals for less goals against, of a half
  Interval scored;      ///< goals of a half
};

/// Computes the ratings of all entrants of a league, in their order. `footballer-v1` has 0 points
/// if it is there, otherwise their mean is 0. Maximum likelihood, with half a win of each team
/// added to each pair so that they are finite; intervals are by bootstrap over the halves' numbers,
/// for all pairs together.
/// @param league index in FootballConfig::leagues
ORTUNG_API std::vector<FootballRating> rateFootball(const FootballMatrix& matrix,
                                                    std::size_t league,
                                                    std::size_t resamples = 500);

/// Returns by how much the goal difference of a half of one cell's first team is greater than that
/// of another's, in halves of the same numbers (a paired bootstrap).
ORTUNG_API Interval differenceOf(const FootballMatrix& matrix, const FootballCell& cell,
                                 const FootballCell& other);

}  // namespace ortung
