#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "Demo.hpp"
#include "Sim.hpp"
#include "Console.hpp"
#include "Interrupt.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/formats/TrackData.hpp"
#include "ortung/mcl_served/LocalizedWorld.hpp"
#include "ortung/mcl_served/WorldTables.hpp"
#include "ortung/served/ServedSimulation.hpp"

namespace ortung::app {
namespace {

std::filesystem::path demoWorld() { return shippedFile("fields", "f2000.toml"); }
std::filesystem::path demoRobot() { return shippedFile("robots", "pioneer.toml"); }

/// What the demo's filter says of the robot, moment by moment.
class Finding {
 public:
  void hear(const Message& message) {
    if (message.id == SensorId{"mcl", "LOCALIZATION", "pose"}) {
      PoseFixData fix(message.id, {});
      fix.setData(message.stamp, message.words);
      if (!fix.reading().empty()) pose_ = fix.reading().front().pose;
    } else if (message.id == SensorId{"mcl", "LOCALIZATION", "status"}) {
      TrackData track;
      track.setData(message.stamp, message.words);
      isTracking_ = track.reading().status == TrackStatus::kTracking;
    }
  }
  /// Where the robot is, once the filter is sure.
  std::optional<Pose2> found() const { return isTracking_ ? pose_ : std::nullopt; }

 private:
  std::optional<Pose2> pose_;
  bool isTracking_ = false;
};

/// The demo without a page, until the robot has found its place; so it can be seen to work where
/// nobody looks, and a script can tell.
int findOnce() {
  constexpr double kPatience = 60.0;  // [s]
  constexpr double kRight = 0.5;      // [m], what "tracking" promises
  Scene scene = Scene::open(demoWorld());
  SceneRobot robot;
  robot.file = demoRobot();
  robot.name = "pioneer";
  robot.wanders = true;
  scene.robots.push_back(robot);
  ServedSimulation simulation(scene, {}, {1.0, warn});
  LocalizedWorld world(
      simulation,
      {[](RobotId) { return demoRobot(); }, learnedTables(simulation.worldFile()), {"all"}, 1});
  const RobotId id = world.residents().front().robot;
  world.want(id, std::vector<SensorId>{{"mcl", "LOCALIZATION", "pose"},
                                       {"mcl", "LOCALIZATION", "status"}});
  note("a robot wanders over the field and finds out where it is");
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  Finding finding;
  while (!finding.found()) {
    checkInterrupt();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (seconds > kPatience) {
      fail(fmt::format("the robot has not found its place within {:g} s", kPatience));
      return 1;
    }
    world.step();
    for (const Message& message : world.readings(id)) finding.hear(message);
    for (const Message& message : world.lateReadings(id)) finding.hear(message);
    const auto ahead = std::chrono::duration<double>(toSeconds(world.now()) - seconds);
    std::this_thread::sleep_for(ahead);  // its filter works beside it, in real time
  }
  const Pose2 truth = simulation.simRobot(id).state().pose;
  const double error = std::hypot(finding.found()->x - truth.x, finding.found()->y - truth.y);
  fmt::print("found after {:.1f} s: x {:.2f} m, y {:.2f} m, {:.1f} cm from where it is\n",
             toSeconds(world.now()), finding.found()->x, finding.found()->y, 100.0 * error);
  return error < kRight ? 0 : 1;
}

}  // namespace

/// `ortung sim` with everything chosen.
int runDemo(const DemoArguments& arguments) {
  if (arguments.once) return findOnce();
  SimArguments sim;
  sim.world = demoWorld();
  sim.robots = {demoRobot()};
  sim.localize = {"all"};
  sim.serving = arguments.serving;
  sim.serving.isViewing = true;
  note("a robot wanders over the field and finds out where it is; Ctrl+C ends it");
  return runSim(sim);
}

}  // namespace ortung::app
