// A robot file of one's own, with all plugins: its features, shape, drive, [motion] and [mcl], then
// a few cycles in a small world. network.json is there for those that name a network.
#include "Fuzz.hpp"
#include "Paths.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/run/Robot.hpp"
#include "ortung/sim/Simulation.hpp"

namespace {

using namespace ortung;

constexpr double kMostRays = 20'000;  // a second: more would take long, and show nothing new
constexpr std::size_t kMostSensors = 8;

std::unique_ptr<Simulation> makeSimulation() {
  test::writeBytes(
      fuzz::folder() / "network.json",
      test::readBytes(std::filesystem::path(ORTUNG_SOURCE_DIR) / "tests/data/network1.json"));
  const auto world = fuzz::write("world.toml", R"([world]
x_m = [-4, 4]
y_m = [-3, 3]
[[rectangle]]
kind = "wall"
center_m = [3.5, 0]
size_m = [0.2, 5]
[[rectangle]]
kind = "goal"
center_m = [-3.5, 0]
size_m = [0.2, 2]
colour = "blue"
[[ellipse]]
kind = "line"
center_m = [0, 0]
size_m = [1, 1]
stroke_m = 0.05
[[ellipse]]
kind = "ball"
name = "ball"
center_m = [1.5, 0.5]
size_m = [0.2, 0.2]
z_m = [0, 0.2]
[[landmark]]
kind = "post"
identity = 1
position_m = [1, 1, 0.5]
)");
  return std::make_unique<Simulation>(readWorld(world), Simulation::Config{});
}

/// A robot in the world, gone with this.
class Guest {
 public:
  Guest(Simulation& simulation, const RobotConfig& config, PluginFactory& factory)
      : simulation_(simulation), robot_(simulation.addRobot(config, factory, {0.0, 0.0, 0.3})) {}
  ~Guest() { simulation_.removeRobot(robot_); }
  Guest(const Guest&) = delete;
  Guest& operator=(const Guest&) = delete;
  SimRobot& operator*() { return robot_; }

 private:
  Simulation& simulation_;
  SimRobot& robot_;
};

void drive(Simulation& simulation, const RobotConfig& config, PluginFactory& factory) {
  simulation.placeThing(0, {1.5, 0.5, 0.0});
  Guest guest(simulation, config, factory);
  SimRobot& robot = *guest;
  if (robot.raysPerSecond(simulation.cycle()) > kMostRays) return;
  fuzz::refusedOrDone<std::invalid_argument>([&] { robot.setTranslationalVelocity(0.5); });
  for (int i = 0; i < 3; ++i) simulation.step();
  fuzz::require(isFinite(robot.state().pose));
}

void read(std::string_view text) {
  static const std::unique_ptr<Simulation> kSimulation = makeSimulation();
  static PluginFactory factory({ORTUNG_PLUGINS_DIR});
  const RobotConfig config = readRobot(parseToml(text, "robot"));
  if (config.sensors.size() > kMostSensors) return;
  RobotShape::read(config);
  MclConfig::read(config.mcl);
  makeMotion(config.motion, factory);
  drive(*kSimulation, config, factory);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  fuzz::refusedOrDone<ConfigError, PluginError, std::invalid_argument>([&] {
    try {
      read({reinterpret_cast<const char*>(bytes), size});
    } catch (const PluginError& error) {
      const std::string_view what = error.what();
      if (what.find("not loaded: ") != what.npos) std::abort();
      throw;
    }
  });
  return 0;
}
