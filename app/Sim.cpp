#include "Commands.hpp"
#include "Console.hpp"
#include "Serving.hpp"
#include "ortung/server/ServedSimulation.hpp"

namespace ortung::app {

int runSim(const SimArguments& arguments) {
  if (arguments.serving.listen.empty()) throw UsageError("--listen [ADDRESS:]PORT is missing");
  ServedSimulation simulation(
      arguments.world,
      {.cycle = arguments.cycleMs / 1000.0, .seed = arguments.seed, .noise = !arguments.noNoise});
  serve(simulation, arguments.serving);
  return 0;
}

}  // namespace ortung::app
