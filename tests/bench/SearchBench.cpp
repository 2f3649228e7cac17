/// Cost of searching 2,000 m^2 of floor for the place of one scan of 360 beams, in all headings:
/// one pose at a time, by annealed importance sampling as at a global start, and by FieldSearch.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "BenchField.hpp"
#include "FieldSearch.hpp"
#include "PoseSearch.hpp"
#include "ortung/base/Random.hpp"

namespace ortung::bench {
namespace {

constexpr double kHallLength = 54.0;  ///< [m]
constexpr double kHallWidth = 40.0;   ///< [m]
constexpr double kHallRange = 20.0;   ///< of the scanner [m]
constexpr int kHallBeams = 360;
constexpr Pose2 kTruth{11.37, -6.12, 2.03};

struct Pillar {
  double x;
  double y;
  double radius;
};

/// Round, so that rays meet them in closed form, and irregular, so that no two places look alike.
const std::array<Pillar, 24>& pillars() {
  static const std::array<Pillar, 24> all = [] {
    std::array<Pillar, 24> made{};
    Random random(7);
    for (Pillar& p : made) {
      do {
        p = {random.uniform(-kHallLength / 2, kHallLength / 2),
             random.uniform(-kHallWidth / 2, kHallWidth / 2), random.uniform(0.3, 1.8)};
      } while (std::hypot(p.x - kTruth.x, p.y - kTruth.y) < p.radius + 1.0);
    }
    return made;
  }();
  return all;
}

double rangeInHall(double x, double y, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  double nearest = std::min((std::copysign(kHallLength / 2, c) - x) / c,
                            (std::copysign(kHallWidth / 2, s) - y) / s);
  for (const Pillar& p : pillars()) {
    const double along = (p.x - x) * c + (p.y - y) * s;
    const double beside = (p.x - x) * s - (p.y - y) * c;
    const double squared = p.radius * p.radius - beside * beside;
    if (along > 0.0 && squared > 0.0) nearest = std::min(nearest, along - std::sqrt(squared));
  }
  return nearest;
}

const FieldRegion& hallRegion() {
  static const FieldRegion region = [] {
    FieldRegion made;
    made.grid = {-kHallLength / 2, -kHallWidth / 2, kCell,
                 static_cast<int>(std::lround(kHallLength / kCell)),
                 static_cast<int>(std::lround(kHallWidth / kCell))};
    for (std::size_t cell = 0; cell < made.grid.size(); ++cell) {
      const double x = made.grid.centreX(cell);
      const double y = made.grid.centreY(cell);
      const bool solid = std::any_of(pillars().begin(), pillars().end(), [&](const Pillar& p) {
        return std::hypot(x - p.x, y - p.y) <= p.radius;
      });
      made.open.push_back(solid ? 0 : 1);
    }
    made.standable = made.open;
    return made;
  }();
  return region;
}

/// Learned at all cells, with a step of 2 degrees, and read at kTruth with noise of 3 cm.
std::shared_ptr<const Weigher> readingIn(ScanData::Perception perception) {
  ScanData::Config config;
  config.beams = kHallBeams;
  config.firstAngle = -std::numbers::pi;
  config.angleStep = kRadiansADegree;
  config.maxRange = kHallRange;
  config.perception = perception;
  if (perception == ScanData::Perception::kEndPoints)
    config.model = {.sigma = 0.05, .outliers = 0.2, .exponent = ScanData::kEndPointExponent};
  ScanData scan({"Hall", "LRF", "Scan"}, {}, config);
  Random random(5);
  const auto read = [&](const Pose2& pose, double noise) {
    std::vector<float> ranges;
    for (int i = 0; i < kHallBeams; ++i) {
      const double range =
          rangeInHall(pose.x, pose.y, pose.theta + config.firstAngle + i * config.angleStep);
      ranges.push_back(range < kHallRange
                           ? static_cast<float>(range + (noise > 0 ? noise * random.gaussian() : 0))
                           : std::numeric_limits<float>::infinity());
    }
    std::vector<std::uint32_t> words;
    ScanData::encode(ranges, kHallRange, words);
    scan.setData(0, words);
  };
  const FieldRegion& region = hallRegion();
  scan.beginLearning(region, 2.0 * kRadiansADegree);
  const int views = static_cast<int>(std::lround(2 * std::numbers::pi / scan.headingSpacing()));
  for (std::size_t cell = 0; cell < region.grid.size(); ++cell) {
    if (region.open[cell] == 0) continue;
    for (int view = 0; view < views; ++view) {
      const Pose2 pose{region.grid.centreX(cell), region.grid.centreY(cell),
                       wrapAngle(view * scan.headingSpacing())};
      read(pose, 0.0);
      scan.learnProbability(pose);
    }
  }
  scan.endLearning();
  read(kTruth, 0.03);
  return scan.weigher();
}

const std::shared_ptr<const Weigher>& reading(bool rays) {
  static const std::array<std::shared_ptr<const Weigher>, 2> both = {
      readingIn(ScanData::Perception::kEndPoints), readingIn(ScanData::Perception::kRays)};
  return both[rays ? 1 : 0];
}

void report(benchmark::State& state, const std::string& name, bool rays, double nanoseconds,
            const Pose2& found) {
  const std::string kind = rays ? "/rays" : "/endpoints";
  remember(name + kind, nanoseconds);
  state.counters["ms"] = nanoseconds * 1e-6;
  state.counters["error_m"] = std::hypot(found.x - kTruth.x, found.y - kTruth.y);
  state.counters["error_deg"] = std::abs(wrapAngle(found.theta - kTruth.theta)) / kRadiansADegree;
  for (const char* other : {"one_by_one", "annealed"}) {
    const auto theirs = recall(other + kind);
    if (theirs && name != other) state.counters[std::string("x_") + other] = *theirs / nanoseconds;
  }
}

/// The cover of FieldSearch, each pose asked by itself, and no polish.
void searchOneByOne(benchmark::State& state, bool rays) {
  const FieldRegion& region = hallRegion();
  const Weigher& weigher = *reading(rays);
  Pose2 best;
  const double taken = fastest(state, [&] {
    double greatest = -1.0;
    for (int row = 1; row < region.grid.rows; row += 3) {
      for (int column = 1; column < region.grid.columns; column += 3) {
        const auto cell = static_cast<std::size_t>(row * region.grid.columns + column);
        if (region.standable[cell] == 0) continue;
        for (int heading = 0; heading < 32; ++heading) {
          const Pose2 pose{region.grid.centreX(cell), region.grid.centreY(cell),
                           heading * std::numbers::pi / 16};
          const double p = weigher.getProbability(pose);
          if (p <= greatest) continue;
          greatest = p;
          best = pose;
        }
      }
    }
  });
  report(state, "one_by_one", rays, taken, best);
}

/// A global start of MCL with its default settings.
void anneal(benchmark::State& state, bool rays) {
  const PoseSearch search(hallRegion());
  const double area = static_cast<double>(search.cells()) * kCell * kCell;
  constexpr std::size_t kDrawn = 20000;
  SampleSet set;
  const PoseSearch::Weigh weigh = [&](const SampleSet& some, std::vector<float>& out) {
    out.assign(some.size(), 0.0F);
    reading(rays)->getProbability(some.view(), out);
  };
  const double taken = fastest(
      state, [&] { set = search.draw(kDrawn, 500.0 * area / kDrawn, weigh, Random(1)).samples; });
  std::vector<float> logs;
  weigh(set, logs);
  const auto best =
      static_cast<std::size_t>(std::max_element(logs.begin(), logs.end()) - logs.begin());
  report(state, "annealed", rays, taken, {set.x[best], set.y[best], set.theta[best]});
}

void searchField(benchmark::State& state, bool rays) {
  FieldSearch search(hallRegion(), {});
  double nominal = 0.0;
  const double taken = fastest(state, [&] {
    search.begin({reading(rays)});
    nominal = search.nominalMilliseconds();
    search.work(1e9);
  });
  report(state, "field_search", rays, taken, search.places().front().pose);
  state.counters["ms_nominal"] = nominal;
}

/// In slices of 10 ms, nominally: how long the longest one takes, of the best of all rounds.
void searchInSlices(benchmark::State& state, bool rays) {
  FieldSearch search(hallRegion(), {});
  double longest = std::numeric_limits<double>::infinity();
  double slices = 0.0;
  for (auto _ : state) {
    double longestNow = 0.0;
    slices = 0.0;
    const Stopwatch beginning;
    search.begin({reading(rays)});
    double before = beginning.nanoseconds();  // begin() and the first slice are one update's
    while (!search.isDone()) {
      const Stopwatch watch;
      search.work(10.0);
      longestNow = std::max(longestNow, watch.nanoseconds() + before);
      before = 0.0;
      slices += 1.0;
    }
    longest = std::min(longest, longestNow);
  }
  state.counters["ms_longest"] = longest * 1e-6;
  state.counters["slices"] = slices;
}

void registerAll() {
  for (const bool rays : {false, true}) {
    const std::string kind = rays ? "/rays" : "/endpoints";
    const auto add = [&](const std::string& name, auto run) {
      benchmark::RegisterBenchmark((name + kind).c_str(), [run, rays](benchmark::State& state) {
        run(state, rays);
      })->Unit(benchmark::kMillisecond);
    };
    add("one_by_one", searchOneByOne);
    add("annealed", anneal);
    add("field_search", searchField);
    add("field_search_sliced", searchInSlices);
  }
}

}  // namespace
}  // namespace ortung::bench

int main(int count, char** arguments) {
  ortung::bench::registerAll();
  const auto& standable = ortung::bench::hallRegion().standable;
  std::printf("a scan of %d beams, %.0f m^2 of floor, all headings; ms is the fastest search's\n",
              ortung::bench::kHallBeams,
              static_cast<double>(std::count(standable.begin(), standable.end(), 1)) *
                  ortung::bench::kCell * ortung::bench::kCell);
  benchmark::Initialize(&count, arguments);
  if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
