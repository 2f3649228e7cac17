#include <gtest/gtest.h>

#include "FakeStage.hpp"
#include "Paths.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/refbox/BoxCommand.hpp"
#include "ortung/sim_api/Referee.hpp"

namespace ortung {
namespace {

class BoxOrders : public testing::Test {
 protected:
  BoxOrders() {
    Parameters p("test");
    p.set("rules", ORTUNG_SOURCE_DIR "/maps/rules/msl.toml");
    p.set("control", "orders");
    referee = PluginFactory(PluginFactory::standardFolders()).make<Referee>("soccer", p);
    stage.set(StagedRobot{"b1", "blue", {-3, 0, 0}, {}, 0.25});
    stage.set(StagedRobot{"y1", "yellow", {3, 0, 0}, {}, 0.25});
    stage.set(StagedThing{"ball", "ball", {2, 2, 0}, {}});
  }

  const Game& say(const std::string& command, const std::string& team = "") {
    std::string why;
    const auto order = refbox::orderOf({command, team, {}}, {"blue", "yellow", "us"}, why);
    EXPECT_TRUE(order) << command << ": " << why;
    if (order && !order->empty()) referee->order(*order);
    stage.step([this](const std::string& name) { return referee->holds(name); });
    return referee->watch(stage);
  }

  test::FakeStage stage{ORTUNG_SOURCE_DIR "/maps/fields/msl.toml", 0.01};
  std::unique_ptr<Referee> referee;
};

/// Each command of the protocol comes through to the referee: an order that it did not know would
/// throw.
TEST_F(BoxOrders, AreKnownToTheReferee) {
  for (const char* command :
       {"START", "STOP", "DROP_BALL", "HALF_TIME", "END_PART", "PARK", "FIRST_HALF", "SECOND_HALF",
        "FIRST_HALF_OVERTIME", "SECOND_HALF_OVERTIME", "TESTMODE_ON", "WELCOME", "END_GAME",
        "GAMEOVER", "GAME_OVER", "RESET"})
    EXPECT_NO_THROW(say(command)) << command;
  for (const char* command :
       {"KICKOFF", "FREEKICK", "GOALKICK", "THROWIN", "CORNER", "PENALTY", "GOAL", "SUBGOAL",
        "REPAIR", "REPAIR_END", "YELLOW_CARD", "DOUBLE_YELLOW", "RED_CARD", "SUBSTITUTION"})
    EXPECT_NO_THROW(say(command, "us")) << command;
}

/// A short game as a person at a box leads it.
TEST_F(BoxOrders, LeadAGame) {
  EXPECT_EQ(say("FIRST_HALF").half, 1);
  EXPECT_EQ(say("KICKOFF", "us").phase, Game::Phase::kStopped);
  EXPECT_EQ(say("START").phase, Game::Phase::kReady);
  EXPECT_FALSE(referee->holds("b1"));
  EXPECT_TRUE(referee->holds("y1"));
  stage.ball()->pose = {1, 0, 0};
  EXPECT_EQ(say("IS_ALIVE", "us").phase, Game::Phase::kPlaying);
  EXPECT_EQ(say("STOP").phase, Game::Phase::kStopped);
  EXPECT_EQ(say("GOAL", "them").teams[1].score, 1);
  EXPECT_EQ(say("SUBGOAL", "them").teams[1].score, 0);
  EXPECT_EQ(say("CORNER", "them").restart, Game::Restart::kCorner);
  EXPECT_NEAR(std::abs(stage.ball()->pose.x), 11.0, 1e-9);
  EXPECT_EQ(say("END_PART").phase, Game::Phase::kStopped);
  EXPECT_EQ(say("SECOND_HALF").half, 2);
  EXPECT_EQ(say("GAMEOVER").phase, Game::Phase::kOver);
}

}  // namespace
}  // namespace ortung
