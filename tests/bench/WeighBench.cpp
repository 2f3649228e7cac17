/// Cost of weighing samples with one scan: a naive pose table, MRPT's likelihood field, and ours.
/// 180 beams, 18 x 12 m field at 0.10 m, 10,000 samples, one thread.

#include <benchmark/benchmark.h>

#include <cstdio>
#include <functional>
#include <map>

#include "BenchField.hpp"
#include "NaiveScan.hpp"
#include "ScanCost.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/formats/ScanData.hpp"
#ifdef ORTUNG_BENCH_MRPT
#include "MrptScan.hpp"
#endif

namespace ortung::bench {
namespace {

using Weigh = std::function<void(const SampleView&, std::span<float>)>;

/// Weighs a cloud over and over, and says how the time compares with those measured before.
void measure(benchmark::State& state, const std::string& name, bool spread, const Weigh& weigh) {
  const SampleSet samples = cloud(spread, kSamples);
  std::vector<float> logProbability(kSamples, 0.0F);
  const double perSample = fastest(state,
                                   [&] {
                                     weigh(samples.view(), logProbability);
                                     benchmark::DoNotOptimize(logProbability.data());
                                     benchmark::ClobberMemory();
                                   }) /
                           static_cast<double>(kSamples);
  state.counters["ns/sample"] = perSample;
  const std::string where = spread ? "spread" : "concentrated";
  remember(name + "/" + where, perSample);
  for (const char* other : {"naive", "mrpt"}) {
    const auto theirs = recall(std::string(other) + "/" + where);
    if (theirs && name != other) state.counters[std::string("x_") + other] = *theirs / perSample;
  }
}

/// A container with one scanner that has learned the field; made once for each table.
const SensorContainer& containerOf(ScanData::Perception perception, double headingStepDegrees) {
  static std::map<std::pair<ScanData::Perception, double>, std::unique_ptr<SensorContainer>> made;
  std::unique_ptr<SensorContainer>& container = made[{perception, headingStepDegrees}];
  if (!container) {
    container = std::make_unique<SensorContainer>();
    container->add(learnedScan(perception, headingStepDegrees));
  }
  return *container;
}

void weighNaively(benchmark::State& state, bool spread) {
  static const NaiveScan scan = [] {
    NaiveScan made(2.0);
    made.setReading(scanAt(kRobot));
    return made;
  }();
  state.counters["table_MB"] = static_cast<double>(scan.bytes()) / 1e6;
  measure(state, "naive", spread, [](const SampleView& samples, std::span<float> out) {
    scan.getProbability(samples, out);
  });
}

#ifdef ORTUNG_BENCH_MRPT
void weighByMrpt(benchmark::State& state, bool spread) {
  static const MrptScan scan;
  measure(state, "mrpt", spread, [](const SampleView& samples, std::span<float> out) {
    scan.getProbability(samples, out);
  });
}
#endif

struct Ours {
  const char* name;
  ScanData::Perception perception;
  double headingStepDegrees;
  InstructionSet set;
};

void weighByOurs(benchmark::State& state, const Ours& ours, bool spread) {
  if (scanCostKernel(ours.set) == nullptr) {
    state.SkipWithError("this machine does not have these instructions");
    return;
  }
  const SensorContainer& container = containerOf(ours.perception, ours.headingStepDegrees);
  useInstructionSet(ours.set);
  measure(state, ours.name, spread, [&](const SampleView& samples, std::span<float> out) {
    container.getProbability(samples, out);
  });
  useInstructionSet(std::nullopt);
}

constexpr auto kRays = ScanData::Perception::kRays;
constexpr auto kEndPoints = ScanData::Perception::kEndPoints;
constexpr Ours kOurs[] = {
    {"rays_2deg_portable", kRays, 2.0, InstructionSet::kPortable},
    {"rays_2deg_avx2", kRays, 2.0, InstructionSet::kAvx2},
    {"rays_2deg_avx512", kRays, 2.0, InstructionSet::kAvx512},
    {"rays_2deg_neon", kRays, 2.0, InstructionSet::kNeon},
    {"rays_1deg_portable", kRays, 1.0, InstructionSet::kPortable},
    {"rays_1deg_avx2", kRays, 1.0, InstructionSet::kAvx2},
    {"rays_1deg_avx512", kRays, 1.0, InstructionSet::kAvx512},
    {"rays_1deg_neon", kRays, 1.0, InstructionSet::kNeon},
    {"endpoints_portable", kEndPoints, 2.0, InstructionSet::kPortable},
    {"endpoints_avx2", kEndPoints, 2.0, InstructionSet::kAvx2},
    {"endpoints_avx512", kEndPoints, 2.0, InstructionSet::kAvx512},
};

void registerAll() {
  for (const bool spread : {true, false}) {
    const std::string where = spread ? "/spread" : "/concentrated";
    const auto add = [&](const std::string& name, auto run) {
      benchmark::RegisterBenchmark((name + where).c_str(), run)->Unit(benchmark::kMicrosecond);
    };
    add("naive_2deg", [spread](benchmark::State& state) { weighNaively(state, spread); });
#ifdef ORTUNG_BENCH_MRPT
    add("mrpt_likelihood_field", [spread](benchmark::State& state) { weighByMrpt(state, spread); });
#endif
    for (const Ours& ours : kOurs) {
      add(ours.name,
          [&ours, spread](benchmark::State& state) { weighByOurs(state, ours, spread); });
    }
  }
}

}  // namespace
}  // namespace ortung::bench

int main(int count, char** arguments) {
  ortung::bench::registerAll();
  std::printf(
      "a scan of %d beams, %zu samples; times are of one call for all samples,\nns/sample is the "
      "fastest call's\n",
      ortung::bench::kBeams, ortung::bench::kSamples);
  benchmark::Initialize(&count, arguments);
  if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
