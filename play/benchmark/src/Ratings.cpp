#include "ortung/benchmark/Ratings.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

constexpr double kScale = 173.71779276130073;  // 400 / ln 10: points of a unit of log odds

/// The goals of each pair, by keeper and striker, and the number of episodes.
struct Counts {
  std::size_t keepers = 0;
  std::size_t strikers = 0;
  std::vector<double> goals;
  double episodes = 0.0;
};

double share(double odds) { return 1.0 / (1.0 + std::exp(-odds)); }

/// The strengths, of which the log odds of a goal are the difference, by Newton's method for one
/// player after the other; the likelihood has a single maximum.
struct Strengths {
  std::vector<double> keepers;
  std::vector<double> strikers;

  explicit Strengths(const Counts& c) : keepers(c.keepers, 0.0), strikers(c.strikers, 0.0) {
    constexpr int kMostSweeps = 200;
    for (int i = 0; i < kMostSweeps; ++i) {
      double moved = 0.0;
      for (std::size_t k = 0; k < keepers.size(); ++k) moved = std::max(moved, stepKeeper(c, k));
      for (std::size_t s = 0; s < strikers.size(); ++s) moved = std::max(moved, stepStriker(c, s));
      if (moved < 1e-9) break;
    }
  }
  double expected(std::size_t k, std::size_t s) const { return share(strikers[s] - keepers[k]); }

 private:
  static double bounded(double step) { return std::clamp(step, -1.0, 1.0); }
  double stepKeeper(const Counts& c, std::size_t k) {
    double excess = 0.0;
    double slope = 0.0;
    for (std::size_t s = 0; s < strikers.size(); ++s) add(c, k, s, excess, slope);
    const double step = bounded(excess / slope);
    keepers[k] -= step;
    return std::abs(step);
  }
  double stepStriker(const Counts& c, std::size_t s) {
    double excess = 0.0;
    double slope = 0.0;
    for (std::size_t k = 0; k < keepers.size(); ++k) add(c, k, s, excess, slope);
    const double step = bounded(excess / slope);
    strikers[s] += step;
    return std::abs(step);
  }
  void add(const Counts& c, std::size_t k, std::size_t s, double& excess, double& slope) const {
    const double p = expected(k, s);
    const double n = c.episodes + 1.0;
    excess += c.goals[k * c.strikers + s] + 0.5 - n * p;
    slope += n * p * (1.0 - p);
  }
};

/// Returns the points of all keepers, then of all strikers, then their mean shares of goals in the
/// same order.
std::vector<double> figures(const Counts& c, std::optional<std::size_t> zero) {
  const Strengths strengths(c);
  const auto& s = strengths.strikers;
  const double origin =
      zero ? s[*zero] : std::accumulate(s.begin(), s.end(), 0.0) / static_cast<double>(c.strikers);
  std::vector<double> all;
  for (const double keeper : strengths.keepers) all.push_back(kScale * (keeper - origin));
  for (const double striker : s) all.push_back(kScale * (striker - origin));
  for (std::size_t k = 0; k < c.keepers; ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < c.strikers; ++i) sum += c.goals[k * c.strikers + i];
    all.push_back(sum / (c.episodes * static_cast<double>(c.strikers)));
  }
  for (std::size_t i = 0; i < c.strikers; ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k < c.keepers; ++k) sum += c.goals[k * c.strikers + i];
    all.push_back(sum / (c.episodes * static_cast<double>(c.keepers)));
  }
  return all;
}

/// Returns whether there was a goal, by episode and pair.
std::vector<std::uint8_t> goalsOf(const GoalMatrix& matrix, std::size_t episodes) {
  const std::size_t pairs = matrix.cells.size();
  std::vector<std::uint8_t> goals(episodes * pairs);
  for (std::size_t c = 0; c < pairs; ++c)
    for (std::size_t i = 0; i < episodes; ++i)
      goals[i * pairs + c] = matrix.cells[c].episodes[i].outcome == GoalOutcome::kGoal ? 1 : 0;
  return goals;
}

}  // namespace

GoalRatings rate(const GoalMatrix& matrix, std::size_t resamples) {
  const std::size_t episodes = matrix.cells.front().episodes.size();
  const std::size_t pairs = matrix.cells.size();
  const std::vector<std::uint8_t> goals = goalsOf(matrix, episodes);
  Counts counts{matrix.config.keepers.size(), matrix.config.strikers.size(),
                std::vector<double>(pairs, 0.0), static_cast<double>(episodes)};
  std::vector<std::uint32_t> sums(pairs, 0);
  const auto add = [&](std::size_t episode) {
    const std::uint8_t* row = goals.data() + episode * pairs;
    for (std::size_t c = 0; c < pairs; ++c) sums[c] += row[c];
  };
  const auto take = [&] {
    for (std::size_t c = 0; c < pairs; ++c) counts.goals[c] = sums[c];
    std::fill(sums.begin(), sums.end(), 0u);
  };
  std::optional<std::size_t> zero;
  for (std::size_t s = 0; s < counts.strikers; ++s)
    if (matrix.config.strikers[s] == strikerText("yardstick-v1")) zero = s;

  for (std::size_t i = 0; i < episodes; ++i) add(i);
  take();
  const Counts whole = counts;
  const std::vector<double> found = figures(whole, zero);
  std::vector<std::vector<double>> drawn(found.size());
  Random random(matrix.config.seed, 1);
  for (std::size_t r = 0; r < resamples; ++r) {
    for (std::size_t i = 0; i < episodes; ++i)
      add(random.below(static_cast<std::uint32_t>(episodes)));
    take();
    const std::vector<double> again = figures(counts, zero);
    for (std::size_t f = 0; f < again.size(); ++f) drawn[f].push_back(again[f]);
  }
  const auto interval = [&](std::size_t f) { return percentiles(found[f], drawn[f]); };

  GoalRatings ratings;
  const std::size_t players = counts.keepers + counts.strikers;
  for (std::size_t f = 0; f < players; ++f)
    (f < counts.keepers ? ratings.keepers : ratings.strikers)
        .push_back({interval(f), interval(players + f)});
  const Strengths strengths(whole);
  for (std::size_t c = 0; c < pairs; ++c) {
    const std::size_t k = c / counts.strikers;
    const std::size_t s = c % counts.strikers;
    const double miss = whole.goals[c] / whole.episodes - strengths.expected(k, s);
    if (std::abs(miss) <= std::abs(ratings.worstMiss)) continue;
    ratings.worstMiss = miss;
    ratings.worstKeeper = k;
    ratings.worstStriker = s;
  }
  return ratings;
}

}  // namespace ortung
