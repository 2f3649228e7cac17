// Runs one hot call of a robot's loop, so that its instructions can be counted
// (scripts/check-arm.sh --counts):
//
//   counted_calls CALL SET REPEATS
//
// Two numbers of repeats differ by the call alone. It prints how many things one call does.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "FakeRoom.hpp"
#include "Kld.hpp"
#include "Resampling.hpp"
#include "ScanCost.hpp"
#include "ortung/base/InstructionSet.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/motion/OdometryMotion.hpp"

namespace ortung {
namespace {

constexpr std::size_t kSamples = 500;  ///< what a robot that knows its place has
constexpr int kBeams = 180;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr test::Room kRoom{6.0, 4.0};

/// A call, and how many things it does: beams of samples, numbers, samples.
struct Call {
  std::function<void()> run;
  std::size_t things;
};

SampleSet cloud() {
  SampleSet samples;
  samples.resize(kSamples);
  Random random(1);
  for (std::size_t i = 0; i < kSamples; ++i) {
    samples.x[i] = static_cast<float>(0.3 + 0.1 * random.gaussian());
    samples.y[i] = static_cast<float>(-0.4 + 0.1 * random.gaussian());
    samples.theta[i] = static_cast<float>(0.7 + 0.05 * random.gaussian());
  }
  return samples;
}

Call weighing(ScanData::Perception perception) {
  ScanData::Config config;
  config.beams = kBeams;
  config.firstAngle = -std::numbers::pi / 2;
  config.angleStep = kDegree;
  config.maxRange = 8.0;
  config.perception = perception;
  auto scan = std::make_shared<ScanData>(SensorId{"laser", "LRF", "scan"}, Pose2{}, config);
  test::learnEverywhere(*scan, kRoom.region(0.25, 0.2), 2.0 * kDegree, [&](const Pose2& sensor) {
    return test::scanWords(kRoom, sensor, config);
  });
  scan->setData(1, test::scanWords(kRoom, {0.3, -0.4, 0.7}, config));
  return {[scan, samples = cloud(), log = std::vector<float>(kSamples)]() mutable {
            scan->getProbability(samples.view(), log);
          },
          kSamples * kBeams};
}

/// The cost of rows that lie in the nearest cache.
Call costs(bool hasSteps) {
  struct Scan {
    std::vector<std::uint8_t> bytes;
    std::vector<std::uint8_t> caps;
    std::vector<std::uint8_t> steps;
    std::vector<const std::uint8_t*> rows;
    std::array<std::uint32_t, 64> costs{};
  };
  constexpr std::size_t kPadded = (kBeams + kScanBlock - 1) / kScanBlock * kScanBlock;
  auto scan = std::make_shared<Scan>();
  Random random(2);
  for (std::size_t i = 0; i < 2 * kPadded; ++i)
    scan->bytes.push_back(static_cast<std::uint8_t>(100 + random.below(40)));
  scan->caps.assign(kPadded, 0);
  std::fill_n(scan->caps.begin(), kBeams, std::uint8_t{250});
  if (hasSteps) scan->steps.assign(kPadded, 90);
  for (std::size_t i = 0; i < scan->costs.size(); ++i) scan->rows.push_back(&scan->bytes[i]);
  return {[scan] {
            ScanReading reading{
                std::span(scan->bytes).first(kPadded), scan->caps, scan->steps, 6, {}};
            for (std::size_t i = 0; i < kLevelDifferences; ++i)
              reading.costs[i] = static_cast<std::uint8_t>(8 * i);
            scanCostKernel()(reading, scan->rows, scan->costs.data());
          },
          scan->costs.size() * kBeams};
}

Call numbers(void (*fill)(std::uint64_t, std::uint64_t, std::uint64_t, std::span<float>)) {
  return {[fill, out = std::vector<float>(4 * kSamples)]() mutable { fill(1, 2, 0, out); },
          4 * kSamples};
}

Call moving() {
  return {[motion = std::make_shared<OdometryMotion>(), s = cloud()]() mutable {
            motion->sampleMotion({s.x, s.y, s.theta}, {0.05, 0.002, 0.03}, 1, 2, 0);
          },
          kSamples};
}

Call estimating() {
  return {[samples = cloud(), weights = std::vector<double>(kSamples, 1.0 / kSamples)] {
            const MclConfig config;
            estimateOf(PoseBins(config, samples.view()), samples.view(), weights);
          },
          kSamples};
}

Call normalizing() {
  return {[log = std::vector<float>(kSamples, -1.0F)] { normalized(log); }, kSamples};
}

Call callOf(const std::string& name) {
  const std::map<std::string, std::function<Call()>> calls{
      {"costs", [] { return costs(false); }},
      {"costs_steps", [] { return costs(true); }},
      {"weigh_rays", [] { return weighing(ScanData::Perception::kRays); }},
      {"weigh_end_points", [] { return weighing(ScanData::Perception::kEndPoints); }},
      {"uniform", [] { return numbers(fillUniform); }},
      {"gaussian", [] { return numbers(fillGaussian); }},
      {"motion", moving},
      {"weights", normalizing},
      {"bins_estimate", estimating}};
  return calls.at(name)();
}

}  // namespace
}  // namespace ortung

int main(int argc, char** argv) {
  using ortung::InstructionSet;
  if (argc != 4) {
    std::fprintf(stderr, "counted_calls CALL portable|avx2|avx512|neon REPEATS\n");
    return 2;
  }
  const std::map<std::string, InstructionSet> sets{{"portable", InstructionSet::kPortable},
                                                   {"avx2", InstructionSet::kAvx2},
                                                   {"avx512", InstructionSet::kAvx512},
                                                   {"neon", InstructionSet::kNeon}};
  ortung::useInstructionSet(sets.at(argv[2]));
  const ortung::Call call = ortung::callOf(argv[1]);
  const int repeats = std::atoi(argv[3]);
  for (int i = 0; i < repeats; ++i) call.run();
  std::printf("%zu\n", call.things);
}
