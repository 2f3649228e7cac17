#include "Demo.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "Console.hpp"
#include "Interrupt.hpp"
#include "Sim.hpp"
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
/// It sees landmarks from nearby alone, so that one sees how it finds its place.
std::filesystem::path demoRobot() { return shippedFile("robots", "pioneer_near.toml"); }
/// With this seed two opposite places fit its readings for eight seconds; then it passes a goal.
constexpr std::uint64_t kSeed = 3;

/// Where a visitor's records go: here, if that is possible.
std::filesystem::path folderForRecords() {
  std::error_code error;
  std::filesystem::path here = std::filesystem::current_path(error);
  if (!error && ::access(here.c_str(), W_OK) == 0) return here;
  return std::filesystem::temp_directory_path(error);
}

/// Follows the estimates of the demo's filter.
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
  /// The robot's pose, once the filter is tracking.
  std::optional<Pose2> found() const { return isTracking_ ? pose_ : std::nullopt; }

 private:
  std::optional<Pose2> pose_;
  bool isTracking_ = false;
};

/// Runs the demo without a page until the robot is localized, for scripts and servers.
int findOnce() {
  constexpr double kPatience = 60.0;  // [s]
  constexpr double kRight = 0.5;      // [m], error bound of the status "tracking"
  Scene scene = Scene::open(demoWorld());
  SceneRobot robot;
  robot.file = demoRobot();
  robot.name = "pioneer";
  robot.wanders = true;
  scene.robots.push_back(robot);
  Simulation::Config config;
  config.seed = kSeed;
  ServedSimulation simulation(scene, config, {1.0, warn});
  LocalizedWorld world(
      simulation,
      {[](RobotId) { return demoRobot(); }, learnedTables(simulation.worldFile()), {"all"}, 1});
  const RobotId id = world.residents().front().robot;
  world.want(id, std::vector<SensorId>{{"mcl", "LOCALIZATION", "pose"},
                                       {"mcl", "LOCALIZATION", "status"}});
  note("a robot wanders over the field and localizes itself");
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  Finding finding;
  while (!finding.found()) {
    checkInterrupt();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (seconds > kPatience) {
      fail(fmt::format("the robot was not localized within {:g} s", kPatience));
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
  fmt::print("localized after {:.1f} s: x {:.2f} m, y {:.2f} m, error {:.1f} cm\n",
             toSeconds(world.now()), finding.found()->x, finding.found()->y, 100.0 * error);
  return error < kRight ? 0 : 1;
}

}  // namespace

/// Runs `ortung sim` with fixed arguments.
int runDemo(const DemoArguments& arguments) {
  if (arguments.once) return findOnce();
  SimArguments sim;
  sim.world = demoWorld();
  sim.robots = {demoRobot()};
  sim.localize = {"all"};
  sim.serving = arguments.serving;
  sim.seed = kSeed;
  sim.serving.isViewing = true;
  sim.serving.pageKeys = "panel=localization&demo=1";
  if (sim.serving.recordInto.empty()) sim.serving.recordInto = folderForRecords();
  note("a robot wanders over the field and localizes itself; Ctrl+C ends it");
  return runSim(sim);
}

}  // namespace ortung::app
