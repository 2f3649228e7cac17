#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "Files.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/sim/PlayerWish.hpp"
#include "ortung/sim/SceneRun.hpp"

namespace ortung {
namespace {

constexpr double kBraking = 0.03 * 9.81;  // of the shipped fields [m/s^2]

/// A goalkeeper on the F2000 field, who begins on its line.
struct Keeping {
  explicit Keeping(const std::string& options,
                   const std::filesystem::path& world = shippedFile("fields", "f2000.toml"))
      : factory(PluginFactory::standardFolders()),
        run(scene(world), {.seed = 3}, factory, players()) {
    robot = &run.addPlayer(parsePlayer("goalkeeper:" + options + "@blue"), 1);
  }
  static Scene scene(const std::filesystem::path& world) {
    Scene scene;
    scene.world = world;
    return scene;
  }
  PlayerControl::Config players() {
    return {.budget = 0.0, .onProblem = [this](const std::string& what) { problem = what; }};
  }
  Pose2 pose() const { return robot->state().pose; }
  Pose2 ball() { return run.simulation().things()[0].pose; }
  void roll(const Pose2& from, double vx, double vy) {
    run.simulation().placeThing(0, from, {vx, vy, 0.0});
  }
  void steps(int n) {
    for (int i = 0; i < n && problem.empty(); ++i) run.step();
  }

  std::string problem;
  PluginFactory factory;
  SceneRun run;
  SimRobot* robot = nullptr;
};

TEST(Goalkeeper, InterceptsWhereABallComesThatTheFloorBrakes) {
  for (const auto& [y, vy] : {std::pair{0.0, 0.35}, {1.0, -0.9}, {-0.8, 0.2}}) {
    Keeping keeping("policy=intercepting&start=-5.5,0,90");
    keeping.roll({-2.0, y, 0.0}, -2.2, vy);
    // A straight way: 3.5 m on, it has gone 3.5 / 2.2 of its velocity aside.
    const double comes = y + 3.5 / 2.2 * vy;
    ASSERT_LT(std::abs(comes), 0.75);
    ASSERT_GT(2.2 * 2.2, 2.0 * kBraking * 3.6);  // it gets there
    while (keeping.ball().x > -5.0 && keeping.run.simulation().now() < 5'000'000) keeping.steps(1);
    EXPECT_NEAR(keeping.pose().y, comes, 0.03);
    EXPECT_NEAR(keeping.pose().x, -5.5, 0.05);
    keeping.steps(200);
    EXPECT_GT(keeping.ball().x, -6.0) << "it is a goal";
    EXPECT_EQ(keeping.problem, "");
  }
}

TEST(Goalkeeper, BlocksWhatStopsBefore) {
  Keeping keeping("policy=intercepting&start=-5.5,0.5,90");
  keeping.roll({-2.0, 2.0, 0.0}, -0.6, 0.0);  // 0.6 m far
  keeping.steps(600);
  const double share = 0.5 / (keeping.ball().x + 6.0);
  EXPECT_NEAR(keeping.pose().y, share * keeping.ball().y, 0.02);
}

TEST(Goalkeeper, InterceptsByItsOwnCamera) {
  Keeping keeping("policy=intercepting&sees=features&stage=no&start=-5.5,0,90");
  keeping.roll({-2.0, 0.0, 0.0}, -2.2, 0.35);
  while (keeping.ball().x > -4.9 && keeping.run.simulation().now() < 5'000'000) keeping.steps(1);
  EXPECT_NEAR(keeping.pose().y, 3.5 / 2.2 * 0.35, 0.15);
  EXPECT_EQ(keeping.problem, "");
}

TEST(Goalkeeper, StillStaysWhereItWasPut) {
  Keeping keeping("policy=still&start=-5.5,0.3,90");
  keeping.roll({-2.0, 1.5, 0.0}, -2.0, 0.0);
  keeping.steps(200);
  EXPECT_EQ(keeping.pose().x, -5.5);
  EXPECT_EQ(keeping.pose().y, 0.3);
}

TEST(Goalkeeper, IsNoFasterThanItsSkill) {
  for (const double speed : {0.3, 1.0}) {
    Keeping keeping("policy=pattern&start=-5.5,0,90&speed_m_s=" + std::to_string(speed));
    double fastest = 0.0;
    for (int i = 0; i < 1000; ++i) {
      keeping.steps(1);
      fastest = std::max(fastest, std::abs(keeping.robot->state().velocity.y));
      ASSERT_NEAR(keeping.pose().x, -5.5, 0.05);
    }
    EXPECT_NEAR(fastest, speed, 0.02);
  }
}

TEST(Goalkeeper, SteersBackToItsLineUnlessItMayBeOffIt) {
  const auto endsAt = [](const std::string& options) {
    Keeping keeping("policy=pattern&start=-5.35,0,90" + options);
    keeping.steps(600);
    return keeping.pose().x;
  };
  EXPECT_NEAR(endsAt(""), -5.5, 0.05);
  EXPECT_NEAR(endsAt("&slack_m=0.3"), -5.35, 0.05);
}

// It sees by itself, and plays as well where it was put.
TEST(Goalkeeper, InterceptsByMclAndByScansOnItsOwnScanner) {
  for (const char* sees : {"scan", "localized"}) {
    Keeping keeping(std::string("policy=intercepting&stage=no&start=-5.5,0.3,90&sees=") + sees);
    keeping.roll({-2.0, 0.0, 0.0}, -2.2, 0.35);
    while (keeping.ball().x > -4.9 && keeping.run.simulation().now() < 5'000'000) keeping.steps(1);
    EXPECT_NEAR(keeping.pose().y, 3.5 / 2.2 * 0.35, 0.15) << sees;
    EXPECT_EQ(keeping.problem, "");
  }
}

// A referee carries it, and both halves look the same to its scanner: it finds itself in its own.
TEST(Goalkeeper, FindsItselfAtItsOwnGoalAfterItWasCarried) {
  Keeping keeping("policy=intercepting&stage=no&start=-5.5,0,90&sees=localized");
  keeping.steps(100);
  for (const Pose2& place :
       {Pose2{-4.0, 2.0, 0.5}, Pose2{-5.3, -1.2, -2.5}, Pose2{-3.0, -3.0, 1.0},
        Pose2{-5.0, 1.5, 3.0}, Pose2{-2.0, 0.5, -1.0}, Pose2{-4.5, -2.5, 2.0}}) {
    keeping.run.simulation().place(*keeping.robot, place);
    double error = 100.0;
    for (int i = 0; i < 30 && error > 0.2; ++i) {
      // Balls that it wants to meet keep it moving: who stands learns nothing new.
      if (i % 5 == 0) keeping.roll({-2.0, 0.0, 0.0}, -2.0, i % 2 == 0 ? 0.4 : -0.4);
      keeping.steps(20);
      const auto believed = keeping.run.players().believedPose(*keeping.robot);
      ASSERT_TRUE(believed) << keeping.problem;
      error = distance(believed->pose, keeping.pose());
    }
    EXPECT_LE(error, 0.2) << place.x << ", " << place.y;
  }
}

// What it does about a ball that is kicked, it does later by its delay.
TEST(Goalkeeper, KnowsLateWhatItSees) {
  const auto movesAt = [](const std::string& delay) {
    Keeping keeping("policy=intercepting&start=-5.5,0,90&delay_s=" + delay);
    keeping.roll({-2.0, 0.0, 0.0}, 0.0, 0.0);
    keeping.steps(200);
    keeping.roll({-2.0, 0.0, 0.0}, -2.2, 0.4);
    const Timestamp kicked = keeping.run.simulation().now();
    while (std::abs(keeping.pose().y) < 0.02 && keeping.run.simulation().now() < 6'000'000)
      keeping.steps(1);
    return toSeconds(keeping.run.simulation().now() - kicked);
  };
  EXPECT_NEAR(movesAt("0.4") - movesAt("0"), 0.4, 0.041);  // it decides every 0.04 s
}

// A ball that rests before the middle of the goal is blocked in the middle. A line through 16
// places of 0.1 m noise ends within 2 / sqrt(16) of that, 0.05 m, of which the keeper, at an eighth
// of the way from the goal to the ball, goes 6 mm aside. If it took noise for a kick, it would
// believe in velocities between two places of 0.1 m noise, 0.04 s apart: some metres a second.
TEST(Goalkeeper, DoesNotTakeNoiseForAKick) {
  Keeping keeping("policy=intercepting&start=-5.5,0,90&noise_m=0.1");
  keeping.roll({-2.0, 0.0, 0.0}, 0.0, 0.0);
  keeping.steps(200);
  double farthest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    keeping.steps(1);
    farthest = std::max(farthest, std::abs(keeping.pose().y));
  }
  EXPECT_LT(farthest, 5 * 0.006);
  EXPECT_GT(farthest, 0.006 / 5) << "it sees as if there were no noise";
  EXPECT_EQ(keeping.problem, "");
}

TEST(Goalkeeper, KeepsAGoalThatIsNotInTheMiddle) {
  const test::TemporaryFolder folder;
  std::string field = test::readBytes(shippedFile("fields", "f2000.toml"));
  const std::string blue = "position_m = [-6, 0, 0.5]";
  ASSERT_NE(field.find(blue), std::string::npos);
  field.replace(field.find(blue), blue.size(), "position_m = [-6, 1.5, 0.5]");
  test::writeBytes(folder.path() / "aside.toml", field);
  Keeping keeping("policy=pattern&start=-5.5,1.5,90", folder.path() / "aside.toml");
  double least = 10.0, most = -10.0;
  for (int i = 0; i < 1000; ++i) {
    keeping.steps(1);
    least = std::min(least, keeping.pose().y);
    most = std::max(most, keeping.pose().y);
    ASSERT_NEAR(keeping.pose().x, -5.5, 0.05);
  }
  EXPECT_NEAR(least, 1.5 - 0.75, 0.1);  // its reach to both sides of the goal's middle
  EXPECT_NEAR(most, 1.5 + 0.75, 0.1);
}

TEST(Goalkeeper, ComesHomeFromAnywhere) {
  Keeping keeping("policy=blocking&start=2,-2,0");
  keeping.steps(1500);
  EXPECT_NEAR(keeping.pose().x, -5.5, 0.1);
  EXPECT_NEAR(keeping.pose().y, 0.0, 0.05);
}

TEST(Goalkeeper, SaysWhatIsWrongWithItsOptions) {
  const auto why = [](const std::string& options) -> std::string {
    try {
      Keeping keeping(options);
      return keeping.problem;
    } catch (const std::exception& error) {
      return error.what();
    }
  };
  EXPECT_NE(why("policy=lazy").find("must be one of: still"), std::string::npos);
  EXPECT_NE(why("speed_m_s=-1").find("speed_m_s"), std::string::npos);
  EXPECT_NE(why("delay_s=9").find("delay_s"), std::string::npos);
  EXPECT_NE(why("noise=1").find("noise"), std::string::npos);
  EXPECT_NE(why("stage=no").find("needs the world's state"), std::string::npos);
}

}  // namespace
}  // namespace ortung
