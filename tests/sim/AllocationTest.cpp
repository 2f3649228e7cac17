#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <numbers>

#include "ortung/container/Formats.hpp"
#include "ortung/container/SensorContainer.hpp"
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
  // Buffers grow with the longest list that a camera has seen yet; the counter counts.
  EXPECT_GT(runAndCount(6000), 0u);
  EXPECT_EQ(runAndCount(1000), 0u);
}

// With a feature that has words of its own and one that the container does not have.
TEST(Frame, IsTakenWithoutAllocating) {
  SensorContainer container;
  container.add(std::make_unique<ScanData>(SensorId{"LMS200", "LRF", "scan"}, Pose2{},
                                           ScanData::Config{.angleStep = 0.01}));
  container.add(std::make_unique<OdometryData>(SensorId{"odometry", "odometry", "pose"}));
  std::vector<Message> frame = {
      {0, {"odometry", "odometry", "pose"}, OdometryData::encode({{1, 2, 0.5}, 0.1, 0.2, {7, 8}})},
      {0, {"cam", "camera", "ball"}, {1}},
      {0, {"LMS200", "LRF", "scan"}, std::vector<std::uint32_t>(180, 1000)}};
  EXPECT_EQ(container.set(frame), 1u);
  const std::size_t before = allocations.load();
  for (Timestamp stamp = 1; stamp < 100; ++stamp) {
    for (Message& message : frame) message.stamp = stamp;
    container.set(frame);
  }
  EXPECT_EQ(allocations.load() - before, 0u);
}

}  // namespace
}  // namespace ortung
