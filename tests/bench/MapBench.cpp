// HEATMAP on the F2000 field: p(s given l) of a Pioneer's readings all over it, as clients get it.
#include <benchmark/benchmark.h>

#include "../mcl_served/FakeRobots.hpp"
#include "Paths.hpp"
#include "ortung/mcl_served/WorldTables.hpp"
#include "ortung/served/ServedSimulation.hpp"

namespace {

using namespace ortung;

const std::string kField = ORTUNG_SOURCE_DIR "/maps/fields/f2000.toml";
const std::string kPioneer = ORTUNG_SOURCE_DIR "/maps/robots/pioneer.toml";

/// A Pioneer with its tables, and the readings of where it stood for a moment.
std::shared_ptr<const Robot> pioneer() {
  const auto goOn = [](double) { return true; };
  const auto tables = learnedTables(kField)(*openRobot(kPioneer), goOn);
  std::shared_ptr<Robot> robot = openRobot(kPioneer, *tables);
  Scene scene;
  scene.world = kField;
  SceneRobot& pioneer = scene.robots.emplace_back();
  pioneer.file = kPioneer;
  pioneer.name = "pioneer";
  pioneer.start = Pose2{1.53, -0.72, 0.6};
  ServedSimulation world(scene, {.noise = false});
  for (int cycle = 0; cycle < 15; ++cycle) {
    world.step();
    robot->container.set(world.readings(1));
  }
  return robot;
}

void drawMap(benchmark::State& state, const std::string& line) {
  static const std::shared_ptr<const Robot> robot = pioneer();
  test::FakeRobots robots(robot);
  const test::Asking client(robots);
  std::size_t cells = 0;
  for (auto _ : state) cells = client.ask(line).bytes.size();
  state.counters["cells"] = static_cast<double>(cells);
  state.counters["maps/s"] = benchmark::Counter(1.0, benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK_CAPTURE(drawMap, all, "HEATMAP")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drawMap, scan, "HEATMAP */LRF/*")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drawMap, all_at_a_heading, "HEATMAP theta_deg=30")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drawMap, expectation, "HEATMAP */LRF/* of=expectation index=90")
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
