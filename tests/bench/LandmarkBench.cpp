/// Cost of weighing samples with twelve features of six landmarks: a distance and a bearing each.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>

#include "BenchField.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/ScalarData.hpp"
#ifdef ORTUNG_BENCH_MRPT
#include "MrptBeacons.hpp"
#endif

namespace ortung::bench {
namespace {

struct Post {
  double x;
  double y;
};
constexpr Post kPosts[] = {{-9, -6}, {-9, 6}, {9, -6}, {9, 6}, {-9, 0}, {9, 0}};
constexpr double kFarthest = 30.0;      // [m]
constexpr double kBearingNoise = 0.09;  // [rad]
constexpr double kRangeNoise = 0.2;     // [m]

LandmarksData::Sighting sight(std::size_t post, const Pose2& from) {
  const double dx = kPosts[post].x - from.x;
  const double dy = kPosts[post].y - from.y;
  return {static_cast<std::uint32_t>(post), std::hypot(dx, dy),
          wrapAngle(std::atan2(dy, dx) - from.theta)};
}

/// Calls read(pose) and then learnProbability(pose) at all open cells, then reads at kRobot.
template <class Read>
void learn(SensorData& data, Read read) {
  const FieldRegion& region = fieldRegion();
  data.beginLearning(region, 2 * kRadiansADegree);
  for (std::size_t cell = 0; cell < region.grid.size(); ++cell) {
    if (region.open[cell] == 0) continue;
    const Pose2 pose{region.grid.centreX(cell), region.grid.centreY(cell), 0};
    data.setData(0, read(pose));
    data.learnProbability(pose);
  }
  data.endLearning();
  data.setData(1, read(kRobot));
}

/// Six ScalarData and six BearingData.
void addSeparateFeatures(SensorContainer& container) {
  for (std::size_t post = 0; post < std::size(kPosts); ++post) {
    const std::string name = "post" + std::to_string(post);
    ScalarData::Config distance;
    distance.maxRange = kFarthest;
    distance.model.sigma = kRangeNoise;
    learn(container.add(std::make_unique<ScalarData>(SensorId{"Bench", "Camera", name + "Distance"},
                                                     Pose2{}, distance)),
          [post](const Pose2& pose) { return ScalarData::encode(sight(post, pose).range); });
    BearingData::Config bearing;
    bearing.model.sigma = kBearingNoise;
    learn(container.add(std::make_unique<BearingData>(SensorId{"Bench", "Camera", name + "Bearing"},
                                                      Pose2{}, bearing)),
          [post](const Pose2& pose) { return BearingData::encode(sight(post, pose).bearing); });
  }
}

/// One LandmarksData that sees all six.
void addLandmarks(SensorContainer& container) {
  LandmarksData::Config config;
  config.maxRange = kFarthest;
  config.range.sigma = kRangeNoise;
  config.bearing.sigma = kBearingNoise;
  for (std::size_t post = 0; post < std::size(kPosts); ++post)
    config.identities.push_back(static_cast<std::uint32_t>(post));
  learn(container.add(std::make_unique<LandmarksData>(SensorId{"Bench", "Camera", "Landmarks"},
                                                      Pose2{}, config)),
        [](const Pose2& pose) {
          LandmarksData::Reading reading;
          for (std::size_t post = 0; post < std::size(kPosts); ++post)
            reading.push_back(sight(post, pose));
          return LandmarksData::encode(reading);
        });
}

/// One that does not tell landmarks apart: six are seen, of so many that there are.
void addLookalikes(SensorContainer& container, std::uint32_t landmarks) {
  LandmarksData::Config config;
  config.identified = false;
  config.maxRange = kFarthest;
  config.range.sigma = kRangeNoise;
  config.bearing.sigma = kBearingNoise;
  for (std::uint32_t i = 0; i < landmarks; ++i) config.identities.push_back(i);
  learn(
      container.add(std::make_unique<LandmarksData>(SensorId{"Bench", "Camera", "Lookalikes"},
                                                    Pose2{}, config)),
      [&](const Pose2& pose) {
        LandmarksData::Reading reading;
        for (std::size_t post = 0; post < std::size(kPosts); ++post)
          reading.push_back(sight(post, pose));
        // The others stand in a row beside the field.
        for (auto i = static_cast<std::uint32_t>(std::size(kPosts)); i < landmarks; ++i) {
          const double dx = 0.1 * i - 10.0 - pose.x;
          const double dy = 9.0 - pose.y;
          const bool isLearned = pose.x != kRobot.x || pose.y != kRobot.y;
          if (isLearned)
            reading.push_back({i, std::hypot(dx, dy), wrapAngle(std::atan2(dy, dx) - pose.theta)});
        }
        return LandmarksData::encode(reading);
      });
}

/// The same without tables: geometry and exponent for each landmark.
void weighDirectly(const SampleView& samples, std::span<float> logProbability) {
  LandmarksData::Sighting seen[std::size(kPosts)];
  for (std::size_t post = 0; post < std::size(kPosts); ++post) seen[post] = sight(post, kRobot);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Pose2 pose{static_cast<double>(samples.x[i]), static_cast<double>(samples.y[i]),
                     static_cast<double>(samples.theta[i])};
    double sum = 0.0;
    for (std::size_t post = 0; post < std::size(kPosts); ++post) {
      const LandmarksData::Sighting expected = sight(post, pose);
      const double range = (expected.range - seen[post].range) / kRangeNoise;
      const double bearing = wrapAngle(expected.bearing - seen[post].bearing) / kBearingNoise;
      sum += std::log(0.95 * std::exp(-0.5 * range * range) + 0.05) +
             std::log(0.95 * std::exp(-0.5 * bearing * bearing) + 0.05);
    }
    logProbability[i] += static_cast<float>(sum);
  }
}

template <class Weigh>
void measure(benchmark::State& state, bool isNaive, Weigh weigh) {
  const bool spread = state.range(0) == 0;
  const SampleSet samples = cloud(spread, kSamples);
  std::vector<float> logProbability(kSamples);
  const double each = fastest(state,
                              [&] {
                                weigh(samples.view(), logProbability);
                                benchmark::DoNotOptimize(logProbability.data());
                                benchmark::ClobberMemory();
                              }) /
                      static_cast<double>(kSamples);
  const std::string where = spread ? "spread" : "concentrated";
  state.SetLabel(where);
  state.counters["ns/sample"] = each;
  if (isNaive) remember("direct/" + where, each);
  if (const auto direct = recall("direct/" + where)) state.counters["x_direct"] = *direct / each;
}

void direct(benchmark::State& state) { measure(state, true, weighDirectly); }
BENCHMARK(direct)->DenseRange(0, 1);

#ifdef ORTUNG_BENCH_MRPT
void mrptSixRanges(benchmark::State& state) {
  std::vector<std::pair<double, double>> places;
  for (const Post& post : kPosts) places.emplace_back(post.x, post.y);
  const MrptBeacons beacons(places, kRangeNoise);
  measure(state, false,
          [&](const SampleView& s, std::span<float> out) { beacons.getProbability(s, out); });
}
BENCHMARK(mrptSixRanges)->DenseRange(0, 1);
#endif

void separateFeatures(benchmark::State& state) {
  SensorContainer container;
  addSeparateFeatures(container);
  measure(state, false,
          [&](const SampleView& s, std::span<float> out) { container.getProbability(s, out); });
}
BENCHMARK(separateFeatures)->DenseRange(0, 1);

void landmarks(benchmark::State& state) {
  SensorContainer container;
  addLandmarks(container);
  measure(state, false,
          [&](const SampleView& s, std::span<float> out) { container.getProbability(s, out); });
}
BENCHMARK(landmarks)->DenseRange(0, 1);

void lookalikes(benchmark::State& state) {
  SensorContainer container;
  addLookalikes(container, static_cast<std::uint32_t>(state.range(1)));
  measure(state, false,
          [&](const SampleView& s, std::span<float> out) { container.getProbability(s, out); });
}
BENCHMARK(lookalikes)->ArgsProduct({{0, 1}, {6, 200}});

}  // namespace
}  // namespace ortung::bench

BENCHMARK_MAIN();
