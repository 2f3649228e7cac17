#include "MotionGrid.hpp"

#include <algorithm>
#include <cmath>

namespace ortung::app {
namespace {

constexpr double kLongestGap = 0.5;       // longest gap of the truth within a drive [s]
constexpr double kVelocityWindow = 0.2;   // time over which true velocities are taken [s]
constexpr std::size_t kFewestSteps = 10;  // least number of steps of a drive

/// Returns the mean velocities that lead to @p change in @p seconds.
Velocities meanVelocity(const Pose2& change, double seconds) {
  // The direction of the chord is half of the turn.
  const double half = change.theta / 2.0;
  return {(change.x * std::cos(half) + change.y * std::sin(half)) / seconds,
          change.theta / seconds};
}

std::size_t windowOf(double step) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(kVelocityWindow / step)));
}

/// Computes the true velocities over kVelocityWindow, or at the begin over the time since then.
void findVelocities(MotionGrid& grid, double step) {
  const std::size_t window = windowOf(step);
  for (std::size_t k = 0; k < grid.truth.size(); ++k) {
    const std::size_t from = k >= window ? k - window : 0;
    grid.velocity.push_back(k == 0 ? Velocities{}
                                   : meanVelocity(inverse(grid.truth[from]) * grid.truth[k],
                                                  static_cast<double>(k - from) * step));
  }
}

bool isWithin(const Velocities& velocity, const Velocities& limit) {
  return std::abs(velocity.translational) <= limit.translational &&
         std::abs(velocity.rotational) <= limit.rotational;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

std::vector<MotionGrid> gridsOf(const CommandLog& log, double step, double from, double to) {
  std::vector<MotionGrid> grids;
  if (log.truth.empty() || log.commands.empty()) return grids;
  const Timestamp first = std::max(log.truth.first(), log.commands.front().first);
  const Timestamp last = std::min(log.truth.last(), log.commands.back().first);
  const double span = toSeconds(last - first);
  const Timestamp end = first + fromSeconds(to * span);
  MotionGrid grid;
  const auto close = [&] {
    if (grid.truth.size() >= kFewestSteps) {
      findVelocities(grid, step);
      grids.push_back(std::move(grid));
    }
    grid = {};
  };
  std::size_t command = 0;
  for (Timestamp t = first + fromSeconds(from * span); t <= end; t += fromSeconds(step)) {
    if (!(log.truth.gapAt(t) <= kLongestGap)) {
      close();
      continue;
    }
    while (command + 1 < log.commands.size() && log.commands[command + 1].first <= t) ++command;
    grid.truth.push_back(*log.truth.at(t));
    grid.command.push_back(log.commands[command].second);
  }
  close();
  return grids;
}

std::vector<MotionExample> examplesOf(const MotionNetwork& network,
                                      const std::vector<MotionGrid>& grids) {
  std::vector<MotionExample> examples;
  const std::size_t before = std::max(network.commands - 1, windowOf(network.step));
  for (const MotionGrid& grid : grids) {
    for (std::size_t k = before; k + 1 < grid.truth.size(); ++k) {
      const Velocities& now = grid.velocity[k];
      const Velocities& next = grid.velocity[k + 1];
      if (!isWithin(now, network.limit) || !isWithin(next, network.limit)) continue;
      MotionExample example;
      example.input = {now.translational, now.rotational};
      for (std::size_t i = 0; i < network.commands; ++i) {
        example.input.push_back(grid.command[k - i].translational);
        example.input.push_back(grid.command[k - i].rotational);
      }
      const Pose2 change = inverse(grid.truth[k]) * grid.truth[k + 1];
      example.output = {change.x - now.translational * network.step, change.y,
                        change.theta - now.rotational * network.step,
                        next.translational - now.translational, next.rotational - now.rotational};
      examples.push_back(std::move(example));
    }
  }
  return examples;
}

Velocities limitOf(const std::vector<MotionGrid>& grids) {
  constexpr double kRoom = 1.3;
  constexpr double kMostOfTheTruth = 0.995;
  Velocities limit;
  std::vector<double> translational;
  std::vector<double> rotational;
  for (const MotionGrid& grid : grids) {
    for (const Velocities& c : grid.command) {
      limit.translational = std::max(limit.translational, std::abs(c.translational));
      limit.rotational = std::max(limit.rotational, std::abs(c.rotational));
    }
    for (const Velocities& v : grid.velocity) {
      translational.push_back(std::abs(v.translational));
      rotational.push_back(std::abs(v.rotational));
    }
  }
  const auto fit = [&](double command, const std::vector<double>& truth) {
    return std::clamp(kRoom * std::max(command, quantile(truth, kMostOfTheTruth)), 0.01, 100.0);
  };
  return {fit(limit.translational, translational), fit(limit.rotational, rotational)};
}

PredictionErrors errorsOf(const Predictor& predict, const std::vector<MotionGrid>& grids,
                          std::size_t steps, std::size_t before, const Velocities& limit) {
  std::vector<double> positions;
  std::vector<double> headings;
  for (const MotionGrid& grid : grids) {
    for (std::size_t k = before; k + steps < grid.truth.size(); ++k) {
      const auto begin = grid.velocity.begin() + static_cast<std::ptrdiff_t>(k);
      const bool real = std::all_of(begin, begin + static_cast<std::ptrdiff_t>(steps + 1),
                                    [&](const Velocities& v) { return isWithin(v, limit); });
      if (!real) continue;
      const Pose2 truth = inverse(grid.truth[k]) * grid.truth[k + steps];
      const Pose2 predicted = predict(grid, k, steps);
      positions.push_back(distance(predicted, truth));
      headings.push_back(std::abs(wrapAngle(predicted.theta - truth.theta)));
    }
  }
  const auto rmse = [](const std::vector<double>& values) {
    double sum = 0.0;
    for (const double v : values) sum += v * v;
    return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
  };
  return {positions.size(), quantile(positions, 0.5), rmse(positions), quantile(headings, 0.5),
          rmse(headings)};
}

}  // namespace ortung::app
