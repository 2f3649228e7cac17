#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "Commands.hpp"
#include "Console.hpp"
#include "Interrupt.hpp"
#include "Numbers.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "ortung/robot/RobotTables.hpp"
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

/// What the player `learner` takes, and who it is for.
PlayerWish wishOf(const LearnArguments& arguments, const std::filesystem::path& out) {
  PlayerWish wish;
  wish.plugin = "learner";
  wish.robot = std::filesystem::absolute(arguments.robot);
  wish.options = Parameters("ortung learn");
  wish.options.set("out", std::filesystem::absolute(out).string());
  wish.options.set("cell_m", arguments.cell);
  wish.options.set("heading_step_deg", 360.0 / std::round(360.0 / arguments.headingStepDeg));
  wish.options.set("threads", static_cast<double>(arguments.threads));
  wish.options.set("area", arguments.area);
  if (arguments.area != "auto" && arguments.area != "all") {
    const std::vector<double> point = parseNumbers(arguments.area, "--area", {"x", "y"});
    wish.options.set("area", fmt::format("{};{}", point[0], point[1]));
  }
  return wish;
}

/// Hears what the learner says.
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
        needs_.push_back(fmt::format("{} in {:g} headings", what, number));
      } else if (std::sscanf(heard.text.c_str(), "leaves out %lf", &number) == 1) {
        note(fmt::format(
            "{}: {:.1f} m^2 that walls part from where the robot is are left out (--area)",
            arguments_.world.string(), number));
      }
    }
  }
  const std::vector<std::string>& needs() const { return needs_; }

 private:
  static constexpr const char* kName = "ortung-learn";
  const LearnArguments& arguments_;
  SceneRun& run_;
  Progress progress_;
  std::vector<std::string> needs_;
};

/// Lets the player learn until it ends. @returns in how many headings features were learned
std::vector<std::string> letLearn(const LearnArguments& arguments,
                                  const std::filesystem::path& out) {
  Scene scene;
  scene.world = arguments.world;
  PluginFactory factory(PluginFactory::standardFolders());
  Simulation::Config simulation;
  simulation.noise = false;
  std::string problem;
  PlayerControl::Config players;
  players.budget = 0.0;  // it takes what it needs
  players.onProblem = [&problem](const std::string& what) { problem = what; };
  SceneRun run(scene, simulation, factory, players);
  Listener listener(arguments, run);
  run.addPlayer(wishOf(arguments, out), 0);
  while (problem.empty() && interruptSignal() == 0 && !run.players().isEmpty()) {
    run.step();
    listener.listen();
  }
  if (!problem.empty()) throw std::runtime_error(problem);
  return listener.needs();
}

std::size_t countOf(const std::vector<std::uint8_t>& mask) {
  return static_cast<std::size_t>(
      std::count_if(mask.begin(), mask.end(), [](auto m) { return m != 0; }));
}

}  // namespace

int runLearn(const LearnArguments& arguments) {
  const auto begin = std::chrono::steady_clock::now();
  checkHeadingStep(arguments.headingStepDeg);
  Outputs outputs(arguments.force);
  outputs.reads(arguments.world);
  outputs.reads(arguments.robot);
  outputs.writes("--out", arguments.out, OutputKind::kTables);
  readRobot(arguments.robot);
  const std::vector<std::string> needs = letLearn(arguments, outputs.ready(arguments.out));
  checkInterrupt();
  const RobotTables tables(arguments.out);
  const TableInfo& info = tables.info();
  if (info.features.empty())
    warn(arguments.robot.string() +
         ": has no feature that localizes, so there was nothing to learn");
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  for (const std::string& need : needs) fmt::print("  {}\n", need);
  fmt::print(
      "{}: {} features of {} in {} ({}), {} x {} cells of {:g} m, {} open, {} standable, "
      "{:.1f} MB, {:.2f} s\n",
      arguments.out.string(), info.features.size(), info.robot, info.world, info.worldFingerprint,
      info.region.grid.columns, info.region.grid.rows, info.region.grid.cell,
      countOf(info.region.open), countOf(info.region.standable),
      static_cast<double>(std::filesystem::file_size(arguments.out)) / 1e6, seconds);
  return 0;
}

}  // namespace ortung::app
