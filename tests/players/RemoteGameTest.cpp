// Clients learn how the game stands, as players in the simulator do.
#include <gtest/gtest.h>

#include <vector>

#include "Paths.hpp"
#include "PlayedScene.hpp"
#include "RunningBoard.hpp"
#include "ortung/remote/RemotePlay.hpp"
#include "ortung/served/PlayerCommands.hpp"
#include "ortung/served/ServedSimulation.hpp"

namespace ortung::test {
namespace {

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
    playToTheEnd(run);
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
