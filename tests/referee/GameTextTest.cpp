// How a game stands, as a text: for the protocol and for players on the other side of it.
#include <gtest/gtest.h>

#include <stdexcept>

#include "ortung/base/Random.hpp"
#include "ortung/sim_api/Game.hpp"
#include "ortung/sim_api/Referee.hpp"

namespace ortung::test {
namespace {

TEST(GameText, SaysHowTheGameStands) {
  Game game;
  game.phase = Game::Phase::kReady;
  game.restart = Game::Restart::kKickOff;
  game.restartOf = 0;
  game.half = 1;
  game.clock = 12.5;
  game.teams[1].score = 1;
  EXPECT_EQ(toText(game),
            "phase=ready restart=kick-off restart_of=blue half=1 clock_s=12.5 blue=0 "
            "yellow=1 left=blue");
}

TEST(GameText, AnyGameIsReadAsItWas) {
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    Game game;
    game.phase = static_cast<Game::Phase>(random.below(5));
    game.restart = static_cast<Game::Restart>(random.below(8));
    if (random.below(2) == 0) game.restartOf = random.below(2);
    game.teams = {Game::Team{"cyan", static_cast<int>(random.below(20))},
                  Game::Team{"magenta", static_cast<int>(random.below(20))}};
    game.teamOnTheLeft = random.below(2);
    game.half = static_cast<int>(random.below(5));
    game.clock = random.uniform(0.0, 1e4);
    ASSERT_EQ(gameIn(toText(game)), game) << toText(game);
  }
}

TEST(GameText, RefusesWhatIsNone) {
  for (const char* text :
       {"", "phase", "phase=ready", "phase=asleep blue=0 yellow=0 left=blue",
        "phase=ready blue=0 yellow=0", "phase=ready blue=0 yellow=0 left=red",
        "phase=ready blue=0 yellow=0 red=1 left=blue", "phase=ready blue=x yellow=0 left=blue",
        "phase=ready clock_s=nan blue=0 yellow=0 left=blue", "blue=0 yellow=0 left=blue",
        "phase=ready restart_of=red blue=0 yellow=0 left=blue",
        "phase=free =0 yellow=0 left=yellow",
        "phase=free half=99999999999 blue=0 yellow=0 left=blue",
        "phase=ready restart=never blue=0 yellow=0 left=blue"})
    EXPECT_THROW(gameIn(text), std::invalid_argument) << text;
  EXPECT_NO_THROW(gameIn("phase=ready blue=0 yellow=0 left=blue"));
}

TEST(GameText, AnEventIsALineThatCanBePrinted) {
  EXPECT_EQ(toText(RefereeEvent{0, "goal", "blue", "1 : 0"}), "goal blue: 1 : 0");
  EXPECT_EQ(toText(RefereeEvent{0, "half-time", "", "a\nb"}), "half-time: a?b");
  EXPECT_EQ(toText(RefereeEvent{0, "foul", "", std::string(1000, 'x')}).size(), 400u);
}

}  // namespace
}  // namespace ortung::test
