#include "Learn.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "Console.hpp"
#include "Interrupt.hpp"
#include "LearnParts.hpp"
#include "Numbers.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "RobotSettings.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/SceneRun.hpp"

namespace ortung::app {
namespace {

/// @throws UsageError unless it divides a turn
void checkHeadingStep(double stepDeg) {
  const double steps = 360.0 / stepDeg;
  if (std::abs(steps - std::round(steps)) > 1e-6) {
    throw UsageError(
        fmt::format("--heading-step is {}, expected degrees that divide a turn, "
                    "e.g. 1, 2 or 2.5",
                    stepDeg));
  }
}

/// Returns the options and the robot of the player `learner`.
PlayerWish wishOf(const LearnArguments& arguments, const std::filesystem::path& out) {
  PlayerWish wish;
  wish.plugin = "learner";
  wish.robot = std::filesystem::absolute(arguments.robot);
  wish.options = Parameters("ortung learn");
  wish.options.set("out", std::filesystem::absolute(out).string());
  wish.options.set("cell_m", arguments.cell);
  wish.options.set("heading_step_deg", 360.0 / std::round(360.0 / arguments.headingStepDeg));
  wish.options.set("threads", static_cast<double>(arguments.threads));
  wish.options.set("area", areaOf(arguments));
  return wish;
}

/// Takes the messages of the learner.
class Listener {
 public:
  Listener(const LearnArguments& arguments, SceneRun& run)
      : arguments_(arguments), run_(run), progress_("learning", arguments.progress) {
    run_.players().join(kName, "");
  }
  void listen() {
    for (const Heard& heard : run_.players().takeHeard(kName)) {
      double number = 0.0;
      char what[200] = "";
      if (std::sscanf(heard.text.c_str(), "learned %lf", &number) == 1) {
        progress_.update(number / 100.0);
      } else if (std::sscanf(heard.text.c_str(), "needs %lf headings for %199s", &number, what) ==
                 2) {
        needs.push_back(fmt::format("{} in {:g} headings", what, number));
      } else if (std::sscanf(
                     heard.text.c_str(),
                     "wrote %zu bytes: %zu features, %zu x %zu cells, %zu open, %zu standable",
                     &bytes, &features, &columns, &rows, &open, &standable) == 6) {
        continue;
      } else if (std::sscanf(heard.text.c_str(), "leaves out %lf", &number) == 1) {
        note(fmt::format(
            "{}: {:.1f} m^2 that walls separate from the robot's area are left out (--area)",
            arguments_.world.string(), number));
      }
    }
  }

  std::vector<std::string> needs;  ///< number of headings of each feature, as text
  /// Size of what was written.
  std::size_t bytes = 0, features = 0, columns = 0, rows = 0, open = 0, standable = 0;

 private:
  static constexpr const char* kName = "ortung-learn";
  const LearnArguments& arguments_;
  SceneRun& run_;
  Progress progress_;
};

/// Runs the player until it ends, and prints the result.
void letLearn(const LearnArguments& arguments, const std::filesystem::path& out) {
  const auto begin = std::chrono::steady_clock::now();
  Scene scene;
  scene.world = arguments.world;
  PluginFactory factory(PluginFactory::standardFolders());
  Simulation::Config simulation;
  simulation.noise = false;
  std::string problem;
  PlayerControl::Config players;
  players.budget = 0.0;  // unlimited
  players.onProblem = [&problem](const std::string& what) { problem = what; };
  SceneRun run(scene, simulation, factory, players);
  Listener listener(arguments, run);
  const std::string robot = run.addPlayer(wishOf(arguments, out), 0).config().name;
  while (problem.empty() && interruptSignal() == 0 && !run.players().isEmpty()) {
    run.step();
    run.players().deliver();
    listener.listen();
  }
  if (!problem.empty()) throw std::runtime_error(problem);
  checkInterrupt();
  if (listener.needs.empty())
    warn(arguments.robot.string() +
         ": has no feature that localizes, so there was nothing to learn");
  for (const std::string& need : listener.needs) fmt::print("  {}\n", need);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const SimWorld& world = run.simulation().world();
  fmt::print(
      "{}: {} features of {} in {} ({}), {} x {} cells of {:g} m, {} open, {} standable, "
      "{:.1f} MB, {:.2f} s\n",
      arguments.out.string(), listener.features, robot, world.name(), world.fingerprint(),
      listener.columns, listener.rows, arguments.cell, listener.open, listener.standable,
      static_cast<double>(listener.bytes) / 1e6, seconds);
}

}  // namespace

std::string areaOf(const LearnArguments& arguments) {
  if (arguments.area == "auto" || arguments.area == "all") return arguments.area;
  const std::vector<double> point = parseNumbers(arguments.area, "--area", {"x", "y"});
  return fmt::format("{};{}", point[0], point[1]);
}

int runLearn(const LearnArguments& arguments) {
  checkHeadingStep(arguments.headingStepDeg);
  Outputs outputs(arguments.force);
  outputs.reads(arguments.world);
  if (isGridMap(arguments.world)) note(arguments.world.string() + ": is a map, taken as a world");
  outputs.reads(arguments.robot);
  const bool isPart = !arguments.shard.empty();
  outputs.writes("--out", arguments.out, isPart ? OutputKind::kPart : OutputKind::kTables);
  return withSettings(arguments.robot, arguments.settings, [&] {
    readRobot(arguments.robot);
    if (isPart) {
      learnShard(arguments, readShard(arguments.shard), outputs.ready(arguments.out));
    } else {
      letLearn(arguments, outputs.ready(arguments.out));
    }
    return 0;
  });
}

}  // namespace ortung::app
