/// Cost of one whole update of MCL with 100,000 samples and a scan of 180 beams, and of its parts
/// after weighing: resampling, clusters, estimate.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "BenchField.hpp"
#include "Kld.hpp"
#include "NaiveScan.hpp"
#include "Resampling.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/mcl/Mcl.hpp"
#include "ortung/motion/OdometryMotion.hpp"

namespace ortung::bench {
namespace {

constexpr std::size_t kMany = 100'000;
constexpr int kPlaces = 64;             // of a circle on which the robot drives
constexpr double kRadius = 1.0;         // [m]
constexpr Timestamp kPeriod = 100'000;  // [us]

Pose2 placeOf(std::size_t step) {
  const double angle = 2 * std::numbers::pi * static_cast<double>(step % kPlaces) / kPlaces;
  return {kRobot.x + kRadius * std::sin(angle), kRobot.y - kRadius * std::cos(angle),
          wrapAngle(angle)};
}

const std::vector<std::vector<float>>& scans() {
  static const std::vector<std::vector<float>> made = [] {
    std::vector<std::vector<float>> out;
    for (std::size_t step = 0; step < kPlaces; ++step) out.push_back(scanAt(placeOf(step)));
    return out;
  }();
  return made;
}

void perSample(benchmark::State& state, const std::string& name, double nanoseconds) {
  const double each = nanoseconds / static_cast<double>(kMany);
  state.counters["ns/sample"] = each;
  if (const auto naive = recall(name); naive && *naive != each)
    state.counters["x_naive"] = *naive / each;
}

/// What a textbook's program does: structures of samples, the standard library's generator, nested
/// tables, resampling by search in the sums, mean of all.
class NaiveFilter {
 public:
  NaiveFilter() : scan_(2.0), samples_(kMany) {
    const Pose2 start = placeOf(0);
    for (Sample& s : samples_) {
      s = {start.x + 0.1 * gaussian_(generator_), start.y + 0.1 * gaussian_(generator_),
           start.theta + 0.05 * gaussian_(generator_), 1.0};
    }
  }

  Pose2 update(const Pose2& change, std::span<const float> ranges) {
    const double way0 = std::hypot(change.x, change.y);
    const double turn0 = std::atan2(change.y, change.x);
    scan_.setReading(ranges);
    std::vector<double> sums;
    double sum = 0.0;
    for (Sample& s : samples_) {
      const double heading = s.theta + turn0 + 0.02 * gaussian_(generator_);
      const double way = way0 + 0.01 * gaussian_(generator_);
      s.x += way * std::cos(heading);
      s.y += way * std::sin(heading);
      s.theta = heading + change.theta - turn0 + 0.02 * gaussian_(generator_);
      const auto x = static_cast<float>(s.x);
      const auto y = static_cast<float>(s.y);
      const auto theta = static_cast<float>(s.theta);
      float logProbability = 0.0F;
      scan_.getProbability({{&x, 1}, {&y, 1}, {&theta, 1}}, {&logProbability, 1});
      s.weight = std::exp(static_cast<double>(logProbability));
      sums.push_back(sum += s.weight);
    }
    Pose2 mean;
    double c = 0.0;
    double s = 0.0;
    for (const Sample& sample : samples_) {
      mean.x += sample.weight / sum * sample.x;
      mean.y += sample.weight / sum * sample.y;
      c += sample.weight / sum * std::cos(sample.theta);
      s += sample.weight / sum * std::sin(sample.theta);
    }
    mean.theta = std::atan2(s, c);
    std::vector<Sample> drawn;
    std::uniform_real_distribution<double> uniform(0.0, sum);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const auto at =
          std::lower_bound(sums.begin(), sums.end(), uniform(generator_)) - sums.begin();
      drawn.push_back(samples_[std::min(static_cast<std::size_t>(at), samples_.size() - 1)]);
    }
    samples_ = drawn;
    return mean;
  }

 private:
  struct Sample {
    double x;
    double y;
    double theta;
    double weight;
  };
  NaiveScan scan_;
  std::vector<Sample> samples_;
  std::mt19937 generator_{1};
  std::normal_distribution<double> gaussian_;
};

void updateNaively(benchmark::State& state) {
  NaiveFilter filter;
  std::size_t step = 0;
  const double taken = fastest(state, [&] {
    ++step;
    benchmark::DoNotOptimize(
        filter.update(inverse(placeOf(step - 1)) * placeOf(step), scans()[step % kPlaces]));
  });
  perSample(state, "update", taken);
  remember("update", taken / static_cast<double>(kMany));
}
BENCHMARK(updateNaively)->Unit(benchmark::kMillisecond);

void updateOurs(benchmark::State& state) {
  SensorContainer container;
  container.add(std::make_unique<OdometryData>(SensorId{"Bench", "Odometry", "Pose"}));
  container.add(learnedScan(ScanData::Perception::kRays, 2.0));
  MclConfig config;
  config.maxSamples = config.minSamples = kMany;
  config.threads = static_cast<unsigned>(state.range(0));
  Mcl mcl(config, fieldRegion(), std::make_unique<OdometryMotion>());
  mcl.startAt(placeOf(0), 0.1, 0.05);
  std::size_t step = 0;
  double worst = 0.0;
  const double taken = fastest(state, [&] {
    ++step;
    const Timestamp stamp = static_cast<Timestamp>(step) * kPeriod;
    std::vector<std::uint32_t> words;
    ScanData::encode(scans()[step % kPlaces], kMaxRange, words);
    container.all()[0]->setData(stamp, OdometryData::encode({.pose = placeOf(step),
                                                             .translationalVelocity = 0.0,
                                                             .rotationalVelocity = 0.0,
                                                             .motionData = {}}));
    container.all()[1]->setData(stamp, words);
    if (!mcl.update(container)) state.SkipWithError("there was no update");
    if (step > 5) worst = std::max(worst, distance(mcl.estimate().pose, placeOf(step)));
  });
  if (worst > 0.5) state.SkipWithError("the filter got lost");
  state.counters["worst_m"] = worst;
  perSample(state, "update", taken);
  if (config.threads == 1) remember("update by one thread", taken);
  if (const auto alone = recall("update by one thread"); alone && config.threads > 1)
    state.counters["x_one_thread"] = *alone / taken;
}
BENCHMARK(updateOurs)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Log weights of a cloud under a scan.
std::vector<float> weightsOf(const SampleSet& samples) {
  const auto scan = learnedScan(ScanData::Perception::kRays, 2.0);
  std::vector<float> logWeights(samples.size());
  scan->getProbability(samples.view(), logWeights);
  return logWeights;
}

void normalizeWeights(benchmark::State& state) {
  const std::vector<float> logWeights = weightsOf(concentratedCloud(kMany));
  perSample(state, "", fastest(state, [&] { benchmark::DoNotOptimize(normalized(logWeights)); }));
}
BENCHMARK(normalizeWeights)->Unit(benchmark::kMicrosecond);

void drawByLowVariance(benchmark::State& state) {
  const std::vector<double> weights = normalized(weightsOf(concentratedCloud(kMany)));
  perSample(state, "",
            fastest(state, [&] { benchmark::DoNotOptimize(lowVariance(weights, kMany, 0.5)); }));
}
BENCHMARK(drawByLowVariance)->Unit(benchmark::kMicrosecond);

void sortIntoBins(benchmark::State& state) {
  const SampleSet samples = cloud(state.range(0) == 0, kMany);
  state.SetLabel(state.range(0) == 0 ? "spread" : "concentrated");
  const MclConfig config;
  perSample(state, "", fastest(state, [&] {
              benchmark::DoNotOptimize(PoseBins(config, samples.view()).count());
            }));
}
BENCHMARK(sortIntoBins)->DenseRange(0, 1)->Unit(benchmark::kMicrosecond);

void estimatePose(benchmark::State& state) {
  const SampleSet samples = cloud(state.range(0) == 0, kMany);
  state.SetLabel(state.range(0) == 0 ? "spread" : "concentrated");
  const std::vector<double> weights = normalized(weightsOf(samples));
  const MclConfig config;
  perSample(state, "", fastest(state, [&] {
              benchmark::DoNotOptimize(estimateOf(config, samples.view(), weights));
            }));
}
BENCHMARK(estimatePose)->DenseRange(0, 1)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace ortung::bench

BENCHMARK_MAIN();
