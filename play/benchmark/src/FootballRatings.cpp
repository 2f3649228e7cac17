#include "ortung/benchmark/FootballRatings.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

#include "ortung/base/Random.hpp"
#include "ortung/benchmark/Rates.hpp"

namespace ortung {
namespace {

constexpr double kScale = 173.71779276130073;  // 400 / ln 10: points of a unit of log odds
constexpr const char* kYardstick = "footballer-v1";

/// The sums of a pair over its halves, seen from its first team.
struct Tally {
  std::size_t first = 0;
  std::size_t second = 0;
  double won = 0.0;  ///< halves won, draws as half
  double scored = 0.0;
  double conceded = 0.0;
};

double share(double odds) { return 1.0 / (1.0 + std::exp(-odds)); }

/// Returns the strengths, whose difference is the log odds of a win, by Newton's method for one
/// team after the other; the likelihood has a single maximum up to a common constant.
std::vector<double> strengthsOf(const std::vector<Tally>& tallies, double halves,
                                std::size_t teams) {
  std::vector<double> strengths(teams, 0.0);
  constexpr int kMostSweeps = 300;
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double moved = 0.0;
    for (std::size_t team = 0; team < teams; ++team) {
      double excess = 0.0;
      double slope = 0.0;
      for (const Tally& one : tallies) {
        if (one.first == one.second || (one.first != team && one.second != team)) continue;
        const double p = share(strengths[one.first] - strengths[one.second]);
        const double n = halves + 1.0;
        const double more = one.won + 0.5 - n * p;
        excess += one.first == team ? more : -more;
        slope += n * p * (1.0 - p);
      }
      if (slope <= 0.0) continue;
      const double step = std::clamp(excess / slope, -1.0, 1.0);
      strengths[team] += step;
      moved = std::max(moved, std::abs(step));
    }
    if (moved < 1e-9) break;
  }
  return strengths;
}

/// Returns points, share won, goal difference and goals of each team, one after the other.
std::vector<double> figuresOf(const std::vector<Tally>& tallies, double halves, std::size_t teams,
                              std::optional<std::size_t> zero) {
  const std::vector<double> strengths = strengthsOf(tallies, halves, teams);
  const double mean = std::accumulate(strengths.begin(), strengths.end(), 0.0) /
                      static_cast<double>(std::max<std::size_t>(teams, 1));
  const double origin = zero ? strengths[*zero] : mean;
  std::vector<double> figures;
  for (std::size_t team = 0; team < teams; ++team) {
    double won = 0.0;
    double scored = 0.0;
    double conceded = 0.0;
    double played = 0.0;
    for (const Tally& one : tallies) {
      if (one.first == team) {
        won += one.won, scored += one.scored, conceded += one.conceded, played += halves;
      }
      if (one.second == team) {
        won += halves - one.won, scored += one.conceded, conceded += one.scored, played += halves;
      }
    }
    const double n = std::max(played, 1.0);
    for (const double figure :
         {kScale * (strengths[team] - origin), won / n, (scored - conceded) / n, scored / n})
      figures.push_back(figure);
  }
  return figures;
}

void add(Tally& tally, const FootballHalf& half) {
  const int more = half.goals[0] - half.goals[1];
  tally.won += more > 0 ? 1.0 : more == 0 ? 0.5 : 0.0;
  tally.scored += half.goals[0];
  tally.conceded += half.goals[1];
}

}  // namespace

std::vector<FootballRating> rateFootball(const FootballMatrix& matrix, std::size_t league,
                                         std::size_t resamples) {
  const auto entrants = matrix.config.entrants();
  const std::size_t pairs = matrix.config.pairs().size();
  const std::span<const FootballCell> cells(matrix.cells.data() + league * pairs, pairs);
  const std::size_t n = cells.front().halves.size();
  std::optional<std::size_t> zero;
  for (std::size_t i = 0; i < entrants.size(); ++i)
    if (entrants[i] == kYardstick) zero = i;
  const auto tally = [&](const auto& next) {
    std::vector<Tally> tallies;
    for (const FootballCell& cell : cells) tallies.push_back({cell.first, cell.second});
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t number = next(i);
      for (std::size_t c = 0; c < pairs; ++c) add(tallies[c], cells[c].halves[number]);
    }
    return figuresOf(tallies, static_cast<double>(n), entrants.size(), zero);
  };
  const std::vector<double> found = tally([](std::size_t i) { return i; });
  std::vector<std::vector<double>> drawn(found.size());
  Random random(matrix.config.seed, 1);
  for (std::size_t r = 0; r < resamples; ++r) {
    const auto again = tally([&](std::size_t) { return random.below(n); });
    for (std::size_t f = 0; f < again.size(); ++f) drawn[f].push_back(again[f]);
  }
  std::vector<FootballRating> ratings;
  for (std::size_t f = 0; f < found.size(); f += 4) {
    const auto at = [&](std::size_t k) { return percentiles(found[f + k], drawn[f + k]); };
    ratings.push_back({at(0), at(1), at(2), at(3)});
  }
  return ratings;
}

Interval differenceOf(const FootballMatrix& matrix, const FootballCell& cell,
                      const FootballCell& other) {
  std::vector<int> differences;
  for (std::size_t i = 0; i < cell.halves.size(); ++i) {
    const auto& a = cell.halves[i].goals;
    const auto& b = other.halves[i].goals;
    differences.push_back((a[0] - a[1]) - (b[0] - b[1]));
  }
  return pairedBootstrap(differences, matrix.config.seed);
}

}  // namespace ortung
