/// How often a search of the whole floor finds where the robot is, from one moment of a log alone:
/// FieldSearch, beside annealed importance sampling as at a global start and as rivals are drawn.
///
///     search_success FOLDER MOMENTS NAME...
///
/// For each NAME, FOLDER has NAME.rec (with ground truth), NAME-robot.toml and NAME.ortung, as
/// scripts/evaluate.py leaves them. Found is what is within 0.5 m and 15 degrees of the truth.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "BenchField.hpp"
#include "FieldSearch.hpp"
#include "PoseSearch.hpp"
#include "ortung/run/Feeder.hpp"
#include "ortung/run/OpenSource.hpp"
#include "ortung/run/Robot.hpp"

namespace ortung::bench {
namespace {

struct Moment {
  std::vector<std::shared_ptr<const Weigher>> readings;
  Pose2 truth;
};

struct Log {
  std::unique_ptr<Robot> robot;
  std::vector<Moment> moments;
};

/// So many moments of a log, spread evenly over it.
Log load(const std::filesystem::path& folder, const std::string& name, std::size_t most) {
  const std::filesystem::path robotFile = folder / (name + "-robot.toml");
  Log log{openRobot(robotFile, folder / (name + ".ortung")), {}};
  const auto source =
      openSource("record:" + (folder / (name + ".rec")).string(), robotFile, log.robot->factory);
  Feeder feeder(name, *source, log.robot->container);
  std::vector<Moment> all;
  std::map<const SensorData*, std::uint64_t> seen;
  while (feeder.next()) {
    Moment moment;
    for (const auto& data : log.robot->container.all()) {
      if (std::exchange(seen[data.get()], data->sequence()) == data->sequence()) continue;
      if (auto weigher = data->weigher()) moment.readings.push_back(std::move(weigher));
    }
    if (!feeder.truth() || moment.readings.empty()) continue;
    moment.truth = *feeder.truth();
    all.push_back(std::move(moment));
  }
  for (std::size_t k = 0; k < std::min(most, all.size()); ++k)
    log.moments.push_back(all[(2 * k + 1) * all.size() / (2 * std::min(most, all.size()))]);
  return log;
}

bool isRight(const Pose2& pose, const Pose2& truth) {
  return distance(pose, truth) < 0.5 &&
         std::abs(wrapAngle(pose.theta - truth.theta)) < 15 * kRadiansADegree;
}

void weigh(const Moment& moment, const SampleSet& set, std::vector<float>& out) {
  out.assign(set.size(), 0.0F);
  for (const auto& reading : moment.readings) reading->getProbability(set.view(), out);
}

/// Best first.
using Found = std::vector<FieldSearch::Place>;

Found byFieldSearch(const Log& log, const Moment& moment) {
  FieldSearch search(log.robot->tables.region, {});
  search.begin(moment.readings);
  search.work(1e9);
  return {search.places().begin(), search.places().end()};
}

Found sorted(const Moment& moment, const SampleSet& set) {
  std::vector<float> logs;
  weigh(moment, set, logs);
  Found found;
  for (std::size_t i = 0; i < set.size(); ++i)
    found.push_back({{set.x[i], set.y[i], set.theta[i]}, logs[i]});
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.logProbability > b.logProbability;
  });
  return found;
}

Found byAnnealing(const Log& log, const Moment& moment, std::size_t n, double candidates) {
  const PoseSearch search(log.robot->tables.region);
  const auto weighSome = [&](const SampleSet& set, std::vector<float>& out) {
    weigh(moment, set, out);
  };
  return sorted(moment, search.draw(n, candidates, weighSome, Random(1)).samples);
}

/// As a global start might draw from what was found: by p, of the places that can have any of it.
Found bySearchAndAnnealing(const Log& log, const Moment& moment) {
  const Found places = byFieldSearch(log, moment);
  std::vector<PoseSearch::Ring> rings;
  for (const FieldSearch::Place& place : places)
    if (place.logProbability > places.front().logProbability - 10.0)
      rings.push_back({place.pose, 0.25, 0.17});
  const PoseSearch search(log.robot->tables.region);
  const auto weighSome = [&](const SampleSet& set, std::vector<float>& out) {
    weigh(moment, set, out);
  };
  return sorted(moment, search.drawFrom(rings, 5000, 4.0, weighSome, Random(1)).samples);
}

template <class Search>
void measure(const std::string& name, const char* method, const Log& log, const Search& search) {
  double first = 0, ten = 0, fifty = 0, share = 0, seconds = 0, best = 0;
  const auto n = static_cast<double>(log.moments.size());
  for (const Moment& moment : log.moments) {
    const Stopwatch watch;
    const Found found = search(moment);
    seconds += watch.nanoseconds() * 1e-9 / n;
    const auto right = std::find_if(found.begin(), found.end(), [&](const auto& place) {
      return isRight(place.pose, moment.truth);
    });
    if (!found.empty()) best += found.front().logProbability / n;
    const auto hits =
        static_cast<double>(std::count_if(found.begin(), found.end(), [&](const auto& place) {
          return isRight(place.pose, moment.truth);
        }));
    share += hits / static_cast<double>(std::max<std::size_t>(1, found.size())) / n;
    const auto at = right - found.begin();
    if (right == found.end()) continue;
    first += at < 1 ? 1 / n : 0;
    ten += at < 10 ? 1 / n : 0;
    fifty += at < 50 ? 1 / n : 0;
  }
  std::printf("%-14s %-13s best %.3f  ten %.3f  fifty %.3f  share %.3f  ln p %8.2f  %.3f s\n",
              name.c_str(), method, first, ten, fifty, share, best, seconds);
  std::fflush(stdout);
}

void compare(const std::filesystem::path& folder, const std::string& name, std::size_t moments) {
  const Log log = load(folder, name, moments);
  const FieldRegion& region = log.robot->tables.region;
  const double area =
      static_cast<double>(PoseSearch(region).cells()) * region.grid.cell * region.grid.cell;
  std::printf("%-14s %zu moments, %.0f m^2\n", name.c_str(), log.moments.size(), area);
  measure(name, "field search", log, [&](const Moment& m) { return byFieldSearch(log, m); });
  measure(name, "... and drawn", log,
          [&](const Moment& m) { return bySearchAndAnnealing(log, m); });
  measure(name, "as rivals", log, [&](const Moment& m) { return byAnnealing(log, m, 1000, 50.0); });
  measure(name, "global start", log, [&](const Moment& m) {
    return byAnnealing(log, m, 20000, std::max(2.0, 500.0 * area / 20000.0));
  });
}

}  // namespace
}  // namespace ortung::bench

int main(int count, char** arguments) {
  if (count < 4) {
    std::fprintf(stderr, "usage: %s FOLDER MOMENTS NAME...\n", arguments[0]);
    return 1;
  }
  try {
    for (int i = 3; i < count; ++i)
      ortung::bench::compare(arguments[1], arguments[i], std::stoul(arguments[2]));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s: %s\n", arguments[0], e.what());
    return 1;
  }
  return 0;
}
