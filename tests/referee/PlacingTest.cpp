// What holds of every restart, wherever robots and ball have been before.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <stdexcept>

#include "FakeStage.hpp"
#include "Paths.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/sim_api/Referee.hpp"

namespace ortung::test {
namespace {

constexpr double kRadius = 0.25;
constexpr double kHair = 1e-4;

struct AreaOf {
  double depth, width;
};

struct Places {
  std::string field;
  double halfLength, halfWidth;
  AreaOf penaltyArea;
};

/// In names of tests.
void PrintTo(const Places& places, std::ostream* out) {  // NOLINT: GoogleTest looks for this name
  *out << places.field;
}

std::unique_ptr<Referee> refereeBy(const std::string& rules, const std::string& control = "rules") {
  Parameters p("test");
  p.set("rules", ORTUNG_SOURCE_DIR "/maps/rules/" + rules + ".toml");
  p.set("control", control);
  return PluginFactory(PluginFactory::standardFolders()).make<Referee>("soccer", p);
}

/// A stage on a field with robots and ball anywhere, but none in another.
void scatter(FakeStage& stage, const Places& places, int robots, Random& random) {
  const auto anywhere = [&] {
    return Pose2{random.uniform(-places.halfLength + 0.3, places.halfLength - 0.3),
                 random.uniform(-places.halfWidth + 0.3, places.halfWidth - 0.3),
                 random.uniform(-3.0, 3.0)};
  };
  for (int i = 0; i < robots; ++i) {
    const bool isBlue = i % 2 == 0;
    const std::string name = (isBlue ? "b" : "y") + std::to_string(i);
    stage.set(StagedRobot{name, isBlue ? "blue" : "yellow", {100.0 + i, 100.0, 0.0}, {}, kRadius});
    for (bool isPlaced = false; !isPlaced;) try {
        stage.placeRobot(name, anywhere());
        isPlaced = true;
      } catch (const std::invalid_argument&) {  // refused: somebody is there
      }
  }
  const Pose2 ball = anywhere();
  stage.set(StagedThing{"ball", "ball", {ball.x, ball.y, 0.0}, {}});
}

class PlacingTest : public testing::TestWithParam<Places> {
 protected:
  void expectRoomForAll(const FakeStage& stage, const std::string& about) const {
    const Pose2& ball = stage.things()[0].pose;
    for (std::size_t i = 0; i < stage.robots().size(); ++i) {
      const StagedRobot& one = stage.robots()[i];
      EXPECT_GE(distance(one.pose, ball), kRadius + FakeStage::kBallRadius - kHair)
          << one.name << " is on the ball " << about;
      EXPECT_TRUE(stage.world().isFree(one.pose.x, one.pose.y, {kRadius, 0.2})) << about;
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GE(distance(one.pose, stage.robots()[j].pose), 2.0 * kRadius - kHair)
            << one.name << " is in " << stage.robots()[j].name << about;
    }
  }

  /// @param keepAway of the other team [m]
  void expectDistances(const FakeStage& stage, const Game& game, double keepAway,
                       const std::string& about) const {
    const Pose2& ball = stage.things()[0].pose;
    for (const StagedRobot& robot : stage.robots()) {
      const double gap = distance(robot.pose, ball) - kRadius - FakeStage::kBallRadius;
      const double end = -game.directionOf(robot.team);
      const bool mayStay =
          robot.pose.x * end > GetParam().halfLength - GetParam().penaltyArea.depth &&
          std::abs(robot.pose.y) < GetParam().penaltyArea.width / 2.0;
      if (game.restart == Game::Restart::kKickOff) {
        EXPECT_GE(end * robot.pose.x, kRadius - kHair) << robot.name << about;
      }
      const bool isOther = game.restartOf && game.find(robot.team) != game.restartOf;
      if (isOther && !mayStay) {
        EXPECT_GE(gap, keepAway - kHair) << robot.name << about;
      }
      if (!game.restartOf) {  // a dropped ball
        EXPECT_GE(gap, (keepAway > 2.0 ? 1.0 : 0.5) - kHair) << robot.name << about;
      }
    }
  }
};

/// A stage that counts how often robots are placed.
class CountingStage final : public Stage {
 public:
  explicit CountingStage(Stage& stage) : stage_(stage) {}
  Timestamp now() const override { return stage_.now(); }
  double cycle() const override { return stage_.cycle(); }
  const World& world() const override { return stage_.world(); }
  std::span<const StagedRobot> robots() const override { return stage_.robots(); }
  std::span<const StagedThing> things() const override { return stage_.things(); }
  void placeRobot(std::string_view robot, const Pose2& pose) override {
    ++placed;
    stage_.placeRobot(robot, pose);
  }
  void placeThing(std::string_view thing, const Pose2& pose, const Twist& velocity) override {
    ++balls;
    stage_.placeThing(thing, pose, velocity);
  }
  std::shared_ptr<const FloorPlan> floorPlan(const RobotSize& size) override {
    return stage_.floorPlan(size);
  }
  std::size_t placed = 0;
  std::size_t balls = 0;

 private:
  Stage& stage_;
};

TEST(Placing, MovesNobodyAsideWhosePlaceIsFree) {
  FakeStage stage(ORTUNG_SOURCE_DIR "/maps/fields/msl.toml", 0.01);
  stage.set(StagedThing{"ball", "ball", {3.0, 2.0, 0.0}, {}});
  // Along the touch line, where nobody wants to be.
  for (int i = 0; i < 4; ++i)
    stage.set(StagedRobot{"r" + std::to_string(i),
                          i % 2 == 0 ? "blue" : "yellow",
                          {-1.5 + i, 6.4, 0.0},
                          {},
                          kRadius});
  CountingStage counting(stage);
  const auto referee = refereeBy("msl", "orders");
  referee->order("kick-off blue");
  referee->watch(counting);
  EXPECT_EQ(counting.placed, 4u);
}

// Who comes while a restart is prepared takes part in it, unless it has no team.
TEST(Placing, IsDoneAgainForPlayersThatCome) {
  FakeStage stage(ORTUNG_SOURCE_DIR "/maps/fields/msl.toml", 0.01);
  stage.set(StagedThing{"ball", "ball", {3.0, 2.0, 0.0}, {}});
  const auto add = [&](const std::string& name, const std::string& team, double x) {
    stage.set(StagedRobot{name, team, {x, 6.4, 0.0}, {}, kRadius});
  };
  add("b1", "blue", -1.5);
  CountingStage counting(stage);
  const auto referee = refereeBy("msl", "orders");
  referee->order("kick-off blue");
  referee->watch(counting);
  EXPECT_EQ(counting.placed, 1u);
  EXPECT_EQ(counting.balls, 1u);
  add("guest", "", 0.5);
  referee->watch(counting);
  EXPECT_EQ(counting.placed, 1u) << "nobody came who plays";
  EXPECT_EQ(counting.balls, 1u);
  EXPECT_EQ(stage.find("guest")->pose.x, 0.5);
  add("y1", "yellow", 2.5);
  referee->watch(counting);
  EXPECT_EQ(counting.placed, 2u);
  EXPECT_EQ(counting.balls, 2u);
  EXPECT_GT(stage.find("y1")->pose.x, 0.0);
  referee->watch(counting);
  EXPECT_EQ(counting.placed, 2u) << "it is there";
}

TEST_P(PlacingTest, AllHaveRoomAndKeepAway) {
  const Places& places = GetParam();
  Random random(11);
  for (const std::string rules : {"f2000", "msl"}) {
    const double keepAway = rules == "msl" ? 3.0 : 1.0;
    for (const char* order :
         {"kick-off blue", "kick-off yellow", "throw-in blue", "goal-kick yellow", "corner blue",
          "free-kick yellow", "penalty blue", "dropped-ball"}) {
      for (int scene = 0; scene < 4; ++scene) {
        FakeStage stage(ORTUNG_SOURCE_DIR "/maps/fields/" + places.field + ".toml", 0.01);
        scatter(stage, places, 2 + 4 * scene / 2, random);
        const auto referee = refereeBy(rules, "orders");
        referee->order(order);
        const Game& game = referee->watch(stage);
        const std::string about =
            std::string(" at ") + order + " by " + rules + ", scene " + std::to_string(scene);
        expectRoomForAll(stage, about);
        expectDistances(stage, game, keepAway, about);
        for (const RefereeEvent& event : referee->takeEvents())
          EXPECT_NE(event.what, "problem") << event.text << about;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Fields, PlacingTest,
                         testing::Values(Places{"f2000", 6, 4, {1.5, 5}},
                                         Places{"msl", 11, 7, {2.25, 6.9}},
                                         Places{"soccer18x12", 9, 6, {2.25, 6.9}}),
                         [](const auto& one) { return one.param.field; });

/// Orders in any order, and texts that are none, while robots and ball are put anywhere.
TEST(Orders, InAnyOrderLeaveAGameThatMakesSense) {
  constexpr const char* kOrders[] = {"start",
                                     "stop",
                                     "kick-off blue",
                                     "throw-in yellow",
                                     "goal-kick blue",
                                     "corner blue",
                                     "free-kick blue",
                                     "penalty yellow",
                                     "dropped-ball",
                                     "goal blue",
                                     "no-goal blue",
                                     "half-time",
                                     "first-half",
                                     "second-half",
                                     "first-overtime",
                                     "second-overtime",
                                     "end",
                                     "reset",
                                     "red-card blue",
                                     "nonsense",
                                     "kick-off",
                                     "goal green",
                                     "start start",
                                     "",
                                     "\n\x01"};
  Random random(3);
  for (const char* control : {"rules", "orders"}) {
    FakeStage stage(ORTUNG_SOURCE_DIR "/maps/fields/msl.toml", 0.05);
    scatter(stage, {"msl", 11, 7, {2.25, 6.9}}, 6, random);
    const auto referee = refereeBy("msl", control);
    int refused = 0;
    for (int i = 0; i < 3000; ++i) {
      if (random.uniform() < 0.2) try {
          referee->order(kOrders[static_cast<std::size_t>(random.uniform() * std::size(kOrders))]);
        } catch (const std::invalid_argument& error) {
          EXPECT_NE(std::string(error.what()).find("there are"), std::string::npos) << error.what();
          ++refused;
        }
      if (random.uniform() < 0.05)
        stage.set(StagedThing{"ball",
                              "ball",
                              {random.uniform(-13.0, 13.0), random.uniform(-9.0, 9.0), 0.0},
                              {random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), 0.0}});
      const Game& game = referee->watch(stage);
      for (const auto& team : game.teams) ASSERT_GE(team.score, 0);
      ASSERT_GE(game.half, 0);
      ASSERT_LE(game.half, 4);
      ASSERT_GE(game.clock, 0.0);
      ASSERT_LE(game.clock, 900.0);
      if (game.phase == Game::Phase::kReady) {
        ASSERT_TRUE(game.restartOf);
      }
      const bool isStanding =
          game.phase == Game::Phase::kStopped || game.phase == Game::Phase::kOver;
      for (const StagedRobot& robot : stage.robots())
        ASSERT_EQ(referee->holds(robot.name), isStanding || !game.mayPlay(robot.team));
      ASSERT_LT(referee->takeEvents().size(), 100U);
      stage.step([&](const std::string& name) { return referee->holds(name); });
    }
    EXPECT_GT(refused, 50);
  }
}

}  // namespace
}  // namespace ortung::test
