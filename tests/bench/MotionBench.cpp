/// Cost of moving samples by odometry, and of the random numbers that this takes.

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "BenchField.hpp"
#include "ortung/base/InstructionSet.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/motion/OdometryMotion.hpp"

namespace ortung::bench {
namespace {

constexpr std::size_t kNumbers = 1 << 14;
constexpr Pose2 kChange{0.05, 0.002, 0.03};  // of a step
constexpr const char* kSetNames[] = {"portable", "avx2", "avx512", "neon"};

/// Runs @p work for each n things with the instruction set that the benchmark's argument names.
template <class Work>
void measure(benchmark::State& state, double n, const char* baseline, bool isBaseline, Work work) {
  const auto set = static_cast<InstructionSet>(state.range(0));
  if (!isBaseline && !hasInstructionSet(set)) {
    state.SkipWithError("this machine does not have these instructions");
    return;
  }
  if (!isBaseline) useInstructionSet(set);
  const double each = fastest(state, work) / n;
  useInstructionSet(std::nullopt);
  state.counters["ns/each"] = each;
  if (isBaseline) {
    remember(baseline, each);
  } else {
    state.SetLabel(kSetNames[state.range(0)]);
    if (const auto theirs = recall(baseline)) state.counters["x_std"] = *theirs / each;
  }
}

void normalDistribution(benchmark::State& state) {
  std::mt19937 generator(1);
  std::normal_distribution<float> gaussian;
  std::vector<float> out(kNumbers);
  measure(state, kNumbers, "gaussian", true, [&] {
    for (float& number : out) number = gaussian(generator);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  });
}
BENCHMARK(normalDistribution)->Arg(0);

void fillGaussianNumbers(benchmark::State& state) {
  std::vector<float> out(kNumbers);
  measure(state, kNumbers, "gaussian", false, [&] {
    fillGaussian(1, 2, 0, out);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  });
}
BENCHMARK(fillGaussianNumbers)->DenseRange(0, 3);

void uniformDistribution(benchmark::State& state) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<float> uniform;
  std::vector<float> out(kNumbers);
  measure(state, kNumbers, "uniform", true, [&] {
    for (float& number : out) number = uniform(generator);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  });
}
BENCHMARK(uniformDistribution)->Arg(0);

void fillUniformNumbers(benchmark::State& state) {
  std::vector<float> out(kNumbers);
  measure(state, kNumbers, "uniform", false, [&] {
    fillUniform(1, 2, 0, out);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  });
}
BENCHMARK(fillUniformNumbers)->DenseRange(0, 3);

/// The same motion model as anybody would write it with the standard library.
void moveNaively(benchmark::State& state) {
  SampleSet samples = concentratedCloud(kSamples);
  std::mt19937 generator(1);
  std::normal_distribution<double> gaussian;
  const double way0 = std::hypot(kChange.x, kChange.y);
  const double turn0 = std::atan2(kChange.y, kChange.x);
  measure(state, static_cast<double>(kSamples), "motion", true, [&] {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double heading =
          static_cast<double>(samples.theta[i]) + turn0 + 0.005 * gaussian(generator);
      const double way = way0 + 0.006 * gaussian(generator);
      const double sideways = 0.003 * gaussian(generator);
      samples.x[i] += static_cast<float>(way * std::cos(heading) - sideways * std::sin(heading));
      samples.y[i] += static_cast<float>(way * std::sin(heading) + sideways * std::cos(heading));
      samples.theta[i] =
          static_cast<float>(heading + kChange.theta - turn0 + 0.005 * gaussian(generator));
    }
    benchmark::ClobberMemory();
  });
}
BENCHMARK(moveNaively)->Arg(0);

void moveByOdometry(benchmark::State& state) {
  SampleSet samples = concentratedCloud(kSamples);
  const OdometryMotion motion;
  std::uint64_t stream = 0;
  measure(state, static_cast<double>(kSamples), "motion", false, [&] {
    motion.sampleMotion({samples.x, samples.y, samples.theta}, kChange, 1, stream++, 0);
    benchmark::ClobberMemory();
  });
}
BENCHMARK(moveByOdometry)->DenseRange(0, 3);

}  // namespace
}  // namespace ortung::bench

BENCHMARK_MAIN();
