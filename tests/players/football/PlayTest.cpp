// Single footballers in the simulator.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "ortung/core/ShippedFiles.hpp"
#include "ortung/sim/PlayerWish.hpp"
#include "ortung/sim/SceneRun.hpp"

namespace ortung {
namespace {

/// Some players on a field without referee.
struct Playing {
  explicit Playing(const std::string& field) : run(scene(field), {.seed = 3}, factory, control()) {}
  static Scene scene(const std::string& field) {
    Scene scene;
    scene.world = shippedFile("fields", field);
    return scene;
  }
  PlayerControl::Config control() {
    return {.budget = 0.0, .onProblem = [this](const std::string& what) { problem += what; }};
  }
  SimRobot& add(const std::string& wish) { return run.addPlayer(parsePlayer(wish), ++number); }
  Pose2 ball() { return run.simulation().things()[0].pose; }
  void put(double x, double y, double vx = 0.0, double vy = 0.0) {
    run.simulation().placeThing(0, {x, y, 0.0}, {vx, vy, 0.0});
  }
  /// Until something has come about; whether it has.
  template <class Done>
  bool until(double seconds, const Done& done) {
    const Timestamp end = run.simulation().now() + fromSeconds(seconds);
    while (!done() && run.simulation().now() < end && problem.empty()) run.step();
    EXPECT_EQ(problem, "");
    return done();
  }

  std::string problem;
  std::uint64_t number = 0;
  PluginFactory factory{PluginFactory::standardFolders()};
  SceneRun run;
};

/// In the mouth of the goal at positive x of f2000.
bool isIn(const Pose2& ball) { return ball.x > 6.11 && std::abs(ball.y) < 1.0; }

TEST(Footballer, FetchesABallFromAnySideAndShootsItIntoTheGoal) {
  for (const char* start : {"-1,0,0", "3,0.5,180", "2,-2,90", "5,2,-90"})
    for (const std::string sees : {"truth", "features&stage=no"}) {
      Playing playing("f2000.toml");
      playing.put(1.5, 0.0);
      playing.add("footballer:start=" + std::string(start) + "&sees=" + sees + "@blue");
      EXPECT_TRUE(playing.until(25.0, [&] { return isIn(playing.ball()); })) << start << sees;
    }
}

TEST(Footballer, OnThreeWheelsDoesSo) {
  for (const char* start : {"-1,0,0", "3,0.5,180", "-3,-4,90"})
    for (const std::string sees : {"truth", "features&stage=no"}) {
      Playing playing("msl.toml");
      playing.put(1.5, -1.0);
      playing.add("footballer:robot=msl_omni.toml&start=" + std::string(start) + "&sees=" + sees +
                  "@blue");
      EXPECT_TRUE(playing.until(
          25.0, [&] { return playing.ball().x > 11.11 && std::abs(playing.ball().y) < 1.2; }))
          << start << sees;
    }
}

TEST(Footballer, OfTheOtherTeamShootsAtTheOtherGoal) {
  Playing playing("f2000.toml");
  playing.put(0.0, 1.0);
  playing.add("footballer:start=1,0,0@yellow");
  EXPECT_TRUE(playing.until(
      25.0, [&] { return playing.ball().x < -6.11 && std::abs(playing.ball().y) < 1.0; }));
}

TEST(Footballer, GoesRoundRobotsThatStandInItsWay) {
  Playing playing("f2000.toml");
  playing.put(2.0, 0.0);
  const SimRobot& robot = playing.add("footballer:start=-4,0,0@blue");
  playing.add("goalkeeper:policy=still&name=one&start=-2,0.1,0@yellow");
  playing.add("goalkeeper:policy=still&name=two&start=0,-0.3,0@yellow");
  double still = 0.0;
  for (const auto& other : playing.run.simulation().robots())
    if (other->config().name == "one") still = other->state().pose.x;
  EXPECT_TRUE(playing.until(30.0, [&] { return isIn(playing.ball()); }));
  EXPECT_GT(robot.state().pose.x, 0.5);
  for (const auto& other : playing.run.simulation().robots())
    if (other->config().name == "one") {
      EXPECT_NEAR(other->state().pose.x, still, 0.02);
    }
}

TEST(Footballer, OfTwoOneGoesForTheBallAndTheOtherCovers) {
  for (const std::string sees : {"truth", "features&stage=no"}) {
    Playing playing("f2000.toml");
    playing.put(-1.0, 2.0);
    const SimRobot& near = playing.add("footballer:name=near&start=-2,2,0&sees=" + sees + "@blue");
    const SimRobot& far = playing.add("footballer:name=far&start=-4,-2,0&sees=" + sees + "@blue");
    playing.until(2.5, [] { return false; });
    EXPECT_LT(distance(near.state().pose, playing.ball()), 1.0) << sees;
    EXPECT_GT(distance(far.state().pose, playing.ball()), 1.0) << sees;
    EXPECT_LT(far.state().pose.x, playing.ball().x) << sees;
  }
}

TEST(Footballer, SaysWhatIsWrong) {
  const auto why = [](const std::string& options) -> std::string {
    try {
      Playing playing("f2000.toml");
      playing.add("footballer:" + options + "@blue");
      playing.run.step();
      return playing.problem;
    } catch (const std::exception& error) {
      return error.what();
    }
  };
  EXPECT_NE(why("sees=all").find("must be one of: truth, features, localized"), std::string::npos);
  EXPECT_NE(why("aim_noise_deg=-1").find("aim_noise_deg"), std::string::npos);
  EXPECT_NE(why("stage=no").find("needs the world's state"), std::string::npos);
  EXPECT_NE(why("sees=features&robot=sonar_ring.toml").find("no sensor with a feature 'ball'"),
            std::string::npos);
  Playing nowhere("arena.toml");
  try {
    nowhere.add("footballer:robot=pioneer.toml&name=a");
    nowhere.run.step();
  } catch (const std::exception& error) {
    nowhere.problem = error.what();
  }
  EXPECT_NE(nowhere.problem.find("length_m"), std::string::npos) << nowhere.problem;
}

}  // namespace
}  // namespace ortung
