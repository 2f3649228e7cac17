// What is learned does not depend on the number of threads.
#include <gtest/gtest.h>

#include <list>
#include <numbers>

#include "Files.hpp"
#include "Paths.hpp"
#include "ortung/robot/TableInfo.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/Learner.hpp"

namespace ortung {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;  // [rad]

/// Tables of everything that a robot learns, as bytes.
std::string tablesOf(const SimWorld& world, const std::string& toml, std::size_t threads) {
  PluginFactory factory({ORTUNG_PLUGINS_DIR});
  const RobotConfig robot = readRobot(parseToml(toml, "robot.toml"));
  std::list<SensorContainer> containers;
  std::vector<std::vector<Device>> devices;
  for (std::size_t i = 0; i < 1 + threads; ++i) {
    containers.emplace_back();
    devices.push_back(fillContainer(containers.back(), robot, factory));
  }
  const LearnArea area = learnArea(world, 0.25, {robot.radius});
  Learner learner(world, area.region, devices.front(), std::span(devices).subspan(1), factory,
                  {0.25, 5.0 * kDegree});
  double share = 0.0;
  while (learner.step()) {
    EXPECT_GE(learner.share(), share);
    share = learner.share();
  }
  EXPECT_EQ(learner.share(), 1.0);
  TableInfo info;
  info.headingStep = 5.0 * kDegree;
  info.region = area.region;
  const test::TemporaryFolder folder;
  writeTables(folder / "tables", containers.front(), info);
  return test::readBytes(folder / "tables");
}

/// Rays, cones, landmarks and what is made of other features, by one thread and by several.
TEST(LearnerThreads, LearnTheSame) {
  const auto world = readWorld(ORTUNG_SOURCE_DIR "/maps/fields/f2000.toml");
  const std::string toml = R"(
[[sensor]]
plugin = "lrf"
[[sensor]]
plugin = "sonar"
[[sensor]]
plugin = "landmarks"
kind = "post"
[[sensor]]
plugin = "iconic_omnivision"
)";
  const std::string alone = tablesOf(*world, toml, 0);
  EXPECT_GT(alone.size(), 100'000u);
  EXPECT_EQ(tablesOf(*world, toml, 1), alone);
  EXPECT_EQ(tablesOf(*world, toml, 3), alone);
}

}  // namespace
}  // namespace ortung
