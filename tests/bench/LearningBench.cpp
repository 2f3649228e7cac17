// Steps of environments per second and core, beside a naive loop that makes its environment anew
// for each episode. docs/learning.md has the figures.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "ortung/learning/Batch.hpp"

namespace {

using namespace ortung::learning;

void act(const Batch& batch, std::vector<float>& actions) {
  const EnvironmentInfo& info = batch.info();
  const std::size_t seen = info.observation.size();
  const std::size_t width = info.actionSize();
  actions.resize(batch.size() * info.agents.size() * width);
  for (std::size_t i = 0; i < batch.size() * info.agents.size(); ++i)
    heuristic(info, i % info.agents.size(), batch.observations().subspan(i * seen, seen),
              std::span(actions).subspan(i * width, width));
}

/// With episodes that begin anew by themselves. Arguments: episodes, threads.
void steps(benchmark::State& state, const char* id, const Options& options) {
  Batch batch(id, options,
              {.episodes = static_cast<std::size_t>(state.range(0)),
               .threads = static_cast<unsigned>(state.range(1))});
  std::vector<float> actions;
  for (auto _ : state) {
    act(batch, actions);
    batch.step(actions);
  }
  state.counters["steps/s"] = benchmark::Counter(static_cast<double>(state.range(0)),
                                                 benchmark::Counter::kIsIterationInvariantRate);
}

/// One after the other, each in an environment that is made for it.
void naive(benchmark::State& state, const char* id, const Options& options) {
  std::vector<float> actions;
  double count = 0.0;
  std::uint64_t seed = 1;
  for (auto _ : state) {
    Batch batch(id, options, {.autoreset = Autoreset::kDisabled, .seed = seed++});
    for (; batch.endings()[0] == 0; count += 1.0) {
      act(batch, actions);
      batch.step(actions);
    }
  }
  state.counters["steps/s"] = benchmark::Counter(count, benchmark::Counter::kIsRate);
}

const Options kShot = {{"striker", {std::string("shot")}}};

BENCHMARK_CAPTURE(naive, goalkeeper, "goalkeeper-v0", {});
BENCHMARK_CAPTURE(naive, goalkeeper_shot, "goalkeeper-v0", kShot);
BENCHMARK_CAPTURE(steps, goalkeeper, "goalkeeper-v0", {})
    ->ArgsProduct({{1, 8, 64, 256, 1024}, {1}});  // by computing time, as all with one thread
BENCHMARK_CAPTURE(steps, goalkeeper_threads, "goalkeeper-v0", {})
    ->ArgsProduct({{64, 256}, {2}})
    ->UseRealTime();
BENCHMARK_CAPTURE(steps, goalkeeper_shot, "goalkeeper-v0", kShot)->Args({64, 1});
BENCHMARK_CAPTURE(steps, striker, "striker-v0", {})->Args({64, 1});
BENCHMARK_CAPTURE(steps, keeper_vs_striker, "keeper-vs-striker-v0", {})->Args({64, 1});
BENCHMARK_CAPTURE(steps, localize_and_score, "localize-and-score-v0", {})->Args({16, 1});

}  // namespace

BENCHMARK_MAIN();
