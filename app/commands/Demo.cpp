#include "Commands.hpp"
#include "Console.hpp"
#include "ortung/core/ShippedFiles.hpp"

namespace ortung::app {

/// `ortung sim` with everything chosen.
int runDemo(const DemoArguments& arguments) {
  SimArguments sim;
  sim.world = shippedFile("fields", "f2000.toml");
  sim.robots = {shippedFile("robots", "pioneer.toml")};
  sim.localize = {"all"};
  sim.serving = arguments.serving;
  sim.serving.isViewing = true;
  note("a robot wanders over the field and finds out where it is; Ctrl+C ends it");
  return runSim(sim);
}

}  // namespace ortung::app
