#include "LearnMotion.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "Console.hpp"
#include "Interrupt.hpp"
#include "MotionLogs.hpp"
#include "MotionToml.hpp"
#include "Numbers.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "ortung/run/Robot.hpp"
#include "ortung/study/MotionLearner.hpp"

namespace ortung::app {
namespace {

/// Returns the [motion] with which learning begins.
Parameters baseOf(const LearnMotionArguments& arguments, const Robot& robot) {
  if (!arguments.motion.empty()) return readMotionFile(arguments.motion);
  Parameters motion("learn-motion");
  const bool isGiven = !arguments.plugin.empty();
  motion.set("plugin",
             isGiven ? arguments.plugin : robot.config.motion.textOr("plugin", "odometry"));
  return motion;
}

MotionLearning optionsOf(const LearnMotionArguments& arguments) {
  MotionLearning options;
  options.interval = arguments.interval;
  if (arguments.delay) options.earliestDelay = options.latestDelay = *arguments.delay;
  return options;
}

}  // namespace

int runLearnMotion(const LearnMotionArguments& arguments) {
  Outputs outputs(arguments.force);
  for (const std::string& source : arguments.sources) outputs.readsSource(source);
  outputs.reads(arguments.robot);
  outputs.reads(arguments.motion);
  outputs.writes("--out", arguments.out, OutputKind::kMotion);
  std::vector<MotionLog> logs;
  std::unique_ptr<Robot> robot = openRobot(arguments.robot);
  const Parameters base = baseOf(arguments, *robot);
  double before = 0.0;  // delay for which the base corrects [s]
  {
    Progress progress("reading", arguments.progress);
    for (const std::string& source : arguments.sources) {
      const auto follower = makeMotion(base, robot->factory);
      logs.push_back(readMotionLog(source, arguments.robot, arguments.from, arguments.to, *follower,
                                   progress));
      before = follower->delay();
    }
  }
  std::unique_ptr<MotionModel> model;
  LearnedMotion learned;
  {
    Progress progress("learning", arguments.progress);
    const auto make = [&] { return makeMotion(base, robot->factory); };
    learned = learnMotion(logs, optionsOf(arguments), make, model, [&](double share) {
      progress.update(share);
      return interruptSignal() == 0;
    });
  }
  checkInterrupt();
  Parameters settings = model->settings();
  settings.set("delay_s", before + learned.delay);
  const std::string text = motionToml(arguments.sources, learned, base, settings);
  outputs.write(arguments.out, text);
  fmt::print("{}", text);
  if (!arguments.delay) {
    fmt::print("# mean ln p of a piece: {:.3f}; without the delay {:.3f}\n", learned.logLikelihood,
               learned.undelayed);
  }
  return 0;
}

}  // namespace ortung::app
