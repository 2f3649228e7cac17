#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "FakeWorld.hpp"
#include "SeatOnStage.hpp"
#include "WorldFiles.hpp"
#include "ortung/sim/RoutePlanner.hpp"
#include "ortung/sim/SceneRun.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung {
namespace {

/// Notes what it is told.
struct NotedRobot : RobotCommands {
  void setTranslationalVelocity(double v) override { translational = v; }
  void setRotationalVelocity(double w) override { rotational = w; }
  void setMotion(std::span<const double>) override {}
  void setManipulator(std::string_view, std::string_view) override {}

  double translational = 0.0;
  double rotational = 0.0;
};

/// A stage with one robot that does not get away from where it is.
struct StuckStage : Stage {
  Timestamp now() const override { return time; }
  double cycle() const override { return 0.01; }
  const World& world() const override { return field; }
  std::span<const StagedRobot> robots() const override { return {&robot, 1}; }
  std::span<const StagedThing> things() const override { return {}; }
  void placeRobot(std::string_view, const Pose2&) override {}
  void placeThing(std::string_view, const Pose2&, const Twist&) override {}
  std::shared_ptr<const FloorPlan> floorPlan(const RobotSize& size) override {
    return std::make_shared<RoutePlanner>(field, size);
  }

  FakeWorld field{12.0, 8.0};
  StagedRobot robot{"bert", "", {1.0, 1.0, 0.5}, {}, 0.25};
  Timestamp time = 0;
};

TEST(Wanderer, BacksAfterItWasStuckAndOnlyThen) {
  constexpr Timestamp kCycle = 10'000;
  PluginFactory factory(PluginFactory::standardFolders());
  const auto player = factory.make<Player>("wander", Parameters());
  StuckStage stuck;
  NotedRobot noted;
  test::SeatOnStage seat(stuck, noted, 1);
  seat.able = {0.25, 0.5, {}, "", {}, {}};
  player->begin(seat);
  std::vector<Timestamp> backwards;
  // Whatever it does, it does not get away from here.
  for (Timestamp now = 0; now < 9'500'000; now += kCycle) {
    stuck.time = now;
    EXPECT_TRUE(player->senseAndAct(seat));
    if (noted.translational >= 0.0) continue;
    backwards.push_back(now);
    EXPECT_EQ(noted.rotational, 0.0) << now;
  }
  // Half a second each time when it has been stuck for four.
  ASSERT_EQ(backwards.size(), 100u);
  EXPECT_EQ(backwards[0], 4'000'000);
  EXPECT_EQ(backwards[49], 4'490'000);
  EXPECT_EQ(backwards[50], 8'000'000);
  EXPECT_EQ(backwards[99], 8'490'000);
}

// Each robot has chance of its own for where it begins and for where it wanders: else one would
// look for the places where the next ones began.
TEST(Wanderer, WhereOneGoesHasNothingToDoWithWhereTheNextBegins) {
  const test::TemporaryFolder folder;
  Scene scene;
  scene.world = folder.write("w.toml",
                             "[world]\nx_m = [-8, 8]\ny_m = [-8, 8]\n[[rectangle]]\n"
                             "center_m = [-7.9, -7.9]\nsize_m = [0.1, 0.1]\n");
  const RobotConfig config = readRobot(
      folder.write("r.toml", "[robot]\nradius_m = 0.2\n[[sensor]]\nplugin = \"odometry\"\n"));
  PluginFactory factory(PluginFactory::standardFolders());
  int met = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SceneRun run(scene, {.cycle = 0.05, .seed = seed, .noise = false}, factory);
    const SimRobot& next = run.addRobot(config, factory, std::nullopt, 4);
    const Pose2 place = next.state().pose;
    run.simulation().removeRobot(next);
    SimRobot& robot = run.addRobot(config, factory, Pose2{}, 3);
    run.letWander(robot, 3);
    double nearest = 100.0;
    while (run.simulation().now() < 12'000'000) {
      run.step();
      nearest = std::min(nearest, distance(robot.state().pose, place));
    }
    met += nearest < 0.06 ? 1 : 0;
  }
  // By chance, 10 m of way come within 6 cm of a place in 200 square metres once in 170 times; of
  // three places the nearest is the goal, so the same chance would lead to it every third time.
  EXPECT_LE(met, 2);
}

}  // namespace
}  // namespace ortung
