// Clients learn how the game stands, as players in the simulator do.
#include <gtest/gtest.h>

#include <vector>

#include "GameText.hpp"
#include "RunningBoard.hpp"
#include "ortung/remote/RemotePlay.hpp"
#include "ortung/served/PlayerCommands.hpp"
#include "ortung/served/ServedSimulation.hpp"

namespace ortung::test {
namespace {

TEST(RemoteGame, TheServersTextIsRead) {
  const Game game = remote::parseGame(
      "phase=ready restart=corner restart_of=reds half=2 clock_s=12.25 reds=3 whites=1 "
      "left=whites");
  EXPECT_EQ(game.phase, Game::Phase::kReady);
  EXPECT_EQ(game.restart, Game::Restart::kCorner);
  EXPECT_EQ(game.restartOf, 0u);
  EXPECT_EQ(game.half, 2);
  EXPECT_EQ(game.clock, 12.25);
  EXPECT_EQ(game.teams[0].name, "reds");
  EXPECT_EQ(game.teams[0].score, 3);
  EXPECT_EQ(game.teams[1].name, "whites");
  EXPECT_EQ(game.teamOnTheLeft, 1u);
}

TEST(RemoteGame, NonsenseOfAServerIsToldAsIt) {
  const std::string good = "phase=free restart=none half=0 clock_s=0 blue=0 yellow=0 left=blue";
  EXPECT_NO_THROW(remote::parseGame(good));
  for (const char* text :
       {"", "phase=free", "phase=lost restart=none half=0 clock_s=0 blue=0 yellow=0 left=blue",
        "phase=free restart=none half=x clock_s=0 blue=0 yellow=0 left=blue",
        "phase=free restart=none half=0 clock_s=nan blue=0 yellow=0 left=blue",
        "phase=free restart=none half=0 clock_s=0 blue=0 yellow=0 left=green",
        "phase=free restart=none half=0 clock_s=0 blue=0 left=blue",
        "phase=free restart=none restart_of=green half=0 clock_s=0 blue=0 yellow=0 left=blue",
        "phase=free restart=none half=0 clock_s=0 =0 yellow=0 left=yellow",
        "phase=free restart=none half=99999999999 clock_s=0 blue=0 yellow=0 left=blue"})
    EXPECT_THROW(remote::parseGame(text), std::runtime_error) << text;
}

/// Notes how the game stands each time it acts.
class Watcher : public Player {
 public:
  explicit Watcher(std::vector<Game>& games) : games_(games) {}
  double period() const override { return 0.1; }
  bool senseAndAct(PlayerSeat& seat) override {
    games_.push_back(seat.game());
    return seat.now() < fromSeconds(15.0);
  }

 private:
  std::vector<Game>& games_;
};

Scene refereed() {
  Scene scene = Scene::open(ORTUNG_SOURCE_DIR "/maps/fields/f2000.toml");
  scene.referee = parseReferee("soccer:kick_off=yellow&left=yellow");
  return scene;
}

TEST(RemoteGame, IsThatOfTheSimulator) {
  const std::string robot = ORTUNG_SOURCE_DIR "/maps/robots/pioneer.toml";
  constexpr Pose2 kStart{-2.0, 1.0, 0.0};
  PluginFactory factory({ORTUNG_PLUGINS_DIR});
  std::vector<Game> inside;
  {
    SceneRun run(refereed(), {.noise = false}, factory);
    PlayerWish wish;
    wish.team = "blue";
    run.players().own(run.addRobot(readRobot(robot), factory, kStart, 0),
                      std::make_unique<Watcher>(inside), wish, Random(1));
    while (!run.players().isEmpty()) run.step();
  }
  std::vector<Game> outside;
  {
    ServedSimulation world(refereed(), {.noise = false});
    BoardConfig config = lockstepConfig();
    config.commands = playerCommands(world);
    const RunningBoard board(world, config);
    RemotePlayConfig play;
    play.session.port = board.port();
    play.session.start = kStart;
    play.robot = robot;
    play.team = "blue";
    play.isLockstep = true;
    RemotePlay(std::make_unique<Watcher>(outside), play).run();
  }
  ASSERT_GT(inside.size(), 100u);
  EXPECT_EQ(inside, outside);
  EXPECT_EQ(outside.front().phase, Game::Phase::kStopped);
  EXPECT_EQ(outside.back().phase, Game::Phase::kPlaying);
  EXPECT_EQ(outside.back().directionOf("blue"), -1.0);
}

TEST(RemoteGame, IsFreeWhereTheServerKnowsNone) {
  ServedSimulation world(refereed(), {.noise = false});
  const RunningBoard board(world, lockstepConfig());  // without GAME
  std::vector<Game> games;
  RemotePlayConfig play;
  play.session.port = board.port();
  play.robot = ORTUNG_SOURCE_DIR "/maps/robots/pioneer.toml";
  play.isLockstep = true;
  play.duration = 1.0;
  RemotePlay(std::make_unique<Watcher>(games), play).run();
  ASSERT_FALSE(games.empty());
  EXPECT_EQ(games.back(), Game());
}

}  // namespace
}  // namespace ortung::test
