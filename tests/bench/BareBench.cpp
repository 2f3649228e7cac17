// The arena in bare Box2D, for sim_bench. In a process of its own, since libortung_sim takes the
// place of some of Box2D's functions, by which bare Box2D becomes faster, too.
// bare_bench N SECONDS: prints simulated seconds a second of computing time, of physics alone and
// with rays, and the mean range [m].
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "BareBox2d.hpp"
#include "Measured.hpp"

int main(int argc, char** argv) {
  using namespace ortung::bench;
  if (argc != 3) return 2;
  const auto robots = static_cast<std::size_t>(std::atoi(argv[1]));
  const double seconds = std::atof(argv[2]);
  BareBox2d alone(robots);
  const double physics = measure(seconds, [&](int) { alone.step(); });
  BareBox2d bare(robots);
  std::vector<float> ranges;
  bare.cast(ranges);
  double sum = 0.0;
  for (const float range : ranges) sum += static_cast<double>(range);
  const double withRays = measure(seconds, [&](int cycle) {
    bare.step();
    if (cycle % kCyclesAScan == 0) bare.cast(ranges);
  });
  std::printf("%.9g %.9g %.9g\n", physics, withRays, sum / static_cast<double>(ranges.size()));
  return 0;
}
