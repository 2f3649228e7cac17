#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <functional>
#include <numbers>

#include "CountedAllocations.hpp"
#include "Paths.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung {
namespace {

/// Ten robots that crowd a ball.
class Crowd {
 public:
  explicit Crowd(const std::function<bool(const SensorConfig&)>& isUnwanted)
      : simulation_(readWorld(ORTUNG_SOURCE_DIR "/maps/fields/msl.toml"), {}) {
    RobotConfig config =
        readRobot(std::filesystem::path(ORTUNG_SOURCE_DIR "/maps/robots/msl_omni.toml"));
    std::erase_if(config.sensors, isUnwanted);
    for (int i = 0; i < 10; ++i) {
      config.name = "robot" + std::to_string(i);
      const double angle = 0.2 * std::numbers::pi * i;
      SimRobot& robot = simulation_.addRobot(
          config, factory_, {2.0 * std::cos(angle), 2.0 * std::sin(angle), wrapAngle(angle + 3.1)});
      robot.drive().setTranslationalVelocity(1.0);  // all to the middle, where the ball is
    }
  }
  std::size_t runAndCount(int cycles) {
    const std::size_t before = allocations.load();
    for (int i = 0; i < cycles; ++i) simulation_.step();
    return allocations.load() - before;
  }

 private:
  PluginFactory factory_{PluginFactory::standardFolders()};
  Simulation simulation_;
};

TEST(Cycle, AllocatesNothing) {
  Crowd crowd([](const SensorConfig& one) { return one.plugin == "iconic_omnivision"; });
  EXPECT_GT(crowd.runAndCount(500), 0u);  // buffers grow, the counter counts
  EXPECT_EQ(crowd.runAndCount(1000), 0u);
}

// A list that is longer than all before makes its buffers grow: ten cameras take a hundred looks
// each at five features here, and only a few of these see more than ever.
TEST(Cycle, AllocatesWithCamerasOnlyWhatMakesBuffersGrow) {
  Crowd crowd([](const SensorConfig&) { return false; });
  crowd.runAndCount(2000);
  EXPECT_LT(crowd.runAndCount(1000), 100u);
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
