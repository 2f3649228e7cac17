// How long it takes until tables of a building of 100,000 open cells weigh a first reading: opened,
// checked, given to a robot's features and touched all over. The file is in the page cache.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include "BenchField.hpp"
#include "Files.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/robot/RobotTables.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/Learner.hpp"
#include "ortung/sim/RobotShape.hpp"

namespace ortung::bench {
namespace {

constexpr int kColumns = 8;    // rooms from west to east
constexpr int kRows = 5;       // and from south to north
constexpr double kRoom = 5.2;  // edge of a room, from wall to wall [m]
constexpr double kDoor = 1.0;  // width of a door, in the middle of every wall between rooms [m]
constexpr double kWall = 0.1;  // thickness [m]

std::string wall(double x, double y, double width, double height) {
  return "[[rectangle]]\nkind = \"wall\"\ncenter_m = [" + std::to_string(x) + ", " +
         std::to_string(y) + "]\nsize_m = [" + std::to_string(width) + ", " +
         std::to_string(height) + "]\n";
}

/// A world file of rooms that are all connected.
std::string building() {
  std::string text = "[world]\nname = \"rooms\"\n";
  const double width = kColumns * kRoom;
  const double height = kRows * kRoom;
  for (const double y : {0.0, height}) text += wall(width / 2, y, width + kWall, kWall);
  for (const double x : {0.0, width}) text += wall(x, height / 2, kWall, height + kWall);
  const double piece = (kRoom - kDoor) / 2;  // of a wall, to either side of its door
  for (int column = 0; column < kColumns; ++column)
    for (int row = 0; row < kRows; ++row)
      for (const double begin : {0.0, kRoom - piece}) {
        const double middle = begin + piece / 2;
        if (column > 0) text += wall(column * kRoom, row * kRoom + middle, kWall, piece);
        if (row > 0) text += wall(column * kRoom + middle, row * kRoom, piece, kWall);
      }
  return text;
}

/// The Pioneer with a laser, which perceives by rays or by end points.
RobotConfig pioneer(const std::string& perception) {
  const std::string file = ORTUNG_MAPS "/robots/pioneer_lrf.toml";
  std::ifstream in(file);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string key = "perception = \"";
  text.replace(text.find(key) + key.size(), std::string("rays").size(), perception);
  return readRobot(parseToml(text, file));
}

/// Learns the building. @returns how many cells are open
double learn(const RobotConfig& robot, const std::filesystem::path& file) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "rooms.toml") << building();
  const std::unique_ptr<SimWorld> world = readWorld(folder / "rooms.toml");
  const LearnOptions options{.cell = kCell};
  const FieldRegion region = learnArea(*world, options.cell, sizeOf(robot)).region;
  PluginFactory factory(PluginFactory::standardFolders());
  SensorContainer container;
  const std::vector<Device> devices = fillContainer(container, robot, factory);
  Learner learner(*world, region, devices, {}, factory, options);
  while (learner.step()) {
  }
  writeTables(file, container, tableInfoOf(*world, robot, region, options));
  return static_cast<double>(std::count(region.open.begin(), region.open.end(), std::uint8_t{1}));
}

/// A scan of the middle of a room: walls all around, in whole millimetres.
std::vector<std::uint32_t> scan(std::size_t beams) {
  return std::vector<std::uint32_t>(beams, static_cast<std::uint32_t>(1000 * kRoom / 2));
}

void openTables(benchmark::State& state, const std::string& perception) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "rooms.ortung";
  const RobotConfig robot = pioneer(perception);
  state.counters["open cells"] = learn(robot, file);
  state.counters["MB"] = static_cast<double>(std::filesystem::file_size(file)) * 1e-6;
  PluginFactory factory(PluginFactory::standardFolders());
  SampleSet samples;
  samples.resize(kSamples);
  Random random(1);
  for (std::size_t i = 0; i < kSamples; ++i) {
    samples.x[i] = static_cast<float>(random.uniform(0.0, kColumns * kRoom));
    samples.y[i] = static_cast<float>(random.uniform(0.0, kRows * kRoom));
    samples.theta[i] = static_cast<float>(random.uniform(-3.14, 3.14));
  }
  std::vector<float> logProbability(kSamples);
  double open = std::numeric_limits<double>::infinity();
  double given = open;
  double used = open;
  for (auto _ : state) {
    state.PauseTiming();
    SensorContainer container;
    fillContainer(container, robot, factory);
    SensorData& laser = *container.find({"LMS200", "LRF", "180DegreeScan"});
    state.ResumeTiming();
    const Stopwatch watch;
    const RobotTables tables(file);
    open = std::min(open, watch.nanoseconds() * 1e-6);
    tables.giveTo(container);
    given = std::min(given, watch.nanoseconds() * 1e-6);
    laser.setData(1, scan(180));
    laser.weigher()->getProbability(samples.view(), logProbability);
    used = std::min(used, watch.nanoseconds() * 1e-6);
  }
  state.counters["opened ms"] = open;
  state.counters["given ms"] = given;
  state.counters["used ms"] = used;
}

BENCHMARK_CAPTURE(openTables, rays, "rays")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(openTables, end_points, "endpoints")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ortung::bench

BENCHMARK_MAIN();
