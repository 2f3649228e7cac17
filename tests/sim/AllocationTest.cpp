#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <numbers>

#include "ortung/sim/Simulation.hpp"

// Counts what this process asks of the memory, in all its libraries.
namespace {
std::atomic<std::size_t> allocations{0};
}  // namespace

extern "C" {
void* __libc_malloc(std::size_t size);
void* malloc(std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
}

namespace ortung {
namespace {

TEST(Cycle, AllocatesNothing) {
  PluginFactory factory(PluginFactory::standardFolders());
  Simulation simulation(readWorld(ORTUNG_SOURCE_DIR "/maps/fields/msl.toml"), {});
  RobotConfig config =
      readRobot(std::filesystem::path(ORTUNG_SOURCE_DIR "/maps/robots/msl_omni.toml"));
  // Of scanner, compass and odometry; the camera's features come with lists.
  std::erase_if(config.sensors,
                [](const SensorConfig& one) { return one.plugin == "iconic_omnivision"; });
  for (int i = 0; i < 10; ++i) {
    config.name = "robot" + std::to_string(i);
    const double angle = 0.2 * std::numbers::pi * i;
    SimRobot& robot = simulation.addRobot(
        config, factory, {2.0 * std::cos(angle), 2.0 * std::sin(angle), wrapAngle(angle + 3.1)});
    robot.drive().setTranslationalVelocity(1.0);  // all to the middle, where the ball is
  }
  const auto runAndCount = [&](int cycles) {
    const std::size_t before = allocations.load();
    for (int i = 0; i < cycles; ++i) simulation.step();
    return allocations.load() - before;
  };
  EXPECT_GT(runAndCount(500), 0u);  // buffers grow, the counter counts
  EXPECT_EQ(runAndCount(1000), 0u);
}

}  // namespace
}  // namespace ortung
