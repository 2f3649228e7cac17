#include <gtest/gtest.h>

#include "Restarts.hpp"

namespace ortung::soccer {
namespace {

using Kind = Game::Restart;

const Pitch kPitch{.halfLength = 6.0,
                   .halfWidth = 4.0,
                   .penaltyMark = 1.8,
                   .goalArea = {0.5, 3.0},
                   .penaltyArea = {1.5, 5.0}};

/// Places that all differ from the lines.
Rules::Places places() {
  Rules::Places places;
  places.cornerInside = 0.2;
  places.throwInInside = 0.3;
  places.marksX = 2.0;  // and y = 8 m * 0.25
  return places;
}

/// A game in which blue, team 0, plays towards positive x.
Game game() {
  Game game;
  game.teams[0].name = "blue";
  game.teams[1].name = "yellow";
  game.teamOnTheLeft = 0;
  return game;
}

void expectAt(const Restart& restart, double x, double y) {
  EXPECT_NEAR(restart.place.x, x, 1e-12);
  EXPECT_NEAR(restart.place.y, y, 1e-12);
}

// By symmetry, for either team and on either side.
TEST(Restarts, AreAtThePlacesOfTheRules) {
  for (const std::size_t team : {0u, 1u})
    for (const double side : {1.0, -1.0}) {
      SCOPED_TRACE(std::to_string(team) + (side > 0.0 ? " left" : " right"));
      const double forward = team == 0 ? 1.0 : -1.0;
      const auto at = [&](Kind kind, double x) {
        const Restart restart = restartAt(kind, team, {x, 1.0 * side}, kPitch, places(), game());
        EXPECT_EQ(restart.kind, kind);
        EXPECT_EQ(restart.team, team);
        return restart;
      };
      expectAt(at(Kind::kKickOff, 3.0), 0.0, 0.0);
      expectAt(at(Kind::kThrowIn, 3.0), 3.0, side * 3.7);
      expectAt(at(Kind::kCorner, 3.0), forward * 5.8, side * 3.8);
      expectAt(at(Kind::kGoalKick, 3.0), -forward * 5.5, side * 1.5);
      expectAt(at(Kind::kFreeKick, 3.0), 3.0, side);
      expectAt(at(Kind::kPenalty, 3.0), forward * 4.2, 0.0);
      expectAt(at(Kind::kNone, 3.0), 3.0, side);
    }
}

TEST(Restarts, NeverHaveTheBallOffThePitch) {
  for (const Kind kind : {Kind::kThrowIn, Kind::kFreeKick, Kind::kDroppedBall}) {
    const FloorPoint place = restartAt(kind, 0, {-9.0, 9.0}, kPitch, {}, game()).place;
    EXPECT_EQ(place.x, -6.0);
    EXPECT_EQ(place.y, 4.0);
  }
}

TEST(Restarts, GoalKicksMayHaveAPlaceOfTheirOwn) {
  Rules::Places own = places();
  own.goalKickDepth = 1.0;
  own.goalKickAside = 2.0;
  expectAt(restartAt(Kind::kGoalKick, 0, {0.0, -1.0}, kPitch, own, game()), -5.0, -2.0);
}

TEST(Restarts, AreAtTheNearestMarkWhereTheRulesSaySo) {
  const auto place = [](Kind kind, const FloorPoint& at, bool dropsAtMark, bool freeKickAtMark) {
    Rules::Places own = places();
    own.dropsAtMark = dropsAtMark;
    own.freeKickAtMark = freeKickAtMark;
    return restartAt(kind, 0, at, kPitch, own, game());
  };
  for (const double x : {1.0, -1.0})
    for (const double y : {1.0, -1.0}) {
      expectAt(place(Kind::kDroppedBall, {0.1 * x, 3.0 * y}, true, false), 2.0 * x, 2.0 * y);
      expectAt(place(Kind::kDroppedBall, {0.1 * x, 3.0 * y}, false, true), 0.1 * x, 3.0 * y);
      // In a penalty area, which ends at |x| = 4.5 and |y| = 2.5.
      expectAt(place(Kind::kFreeKick, {4.6 * x, 2.4 * y}, false, true), 2.0 * x, 2.0 * y);
      expectAt(place(Kind::kFreeKick, {4.6 * x, 2.4 * y}, true, false), 4.6 * x, 2.4 * y);
      expectAt(place(Kind::kFreeKick, {4.4 * x, 2.4 * y}, false, true), 4.4 * x, 2.4 * y);
      expectAt(place(Kind::kFreeKick, {4.6 * x, 2.6 * y}, false, true), 4.6 * x, 2.6 * y);
    }
  EXPECT_EQ(place(Kind::kDroppedBall, {}, true, false).team, std::nullopt) << "it is of both";
  Rules::Places none;
  none.dropsAtMark = true;
  expectAt(restartAt(Kind::kDroppedBall, 0, {1.0, 2.0}, kPitch, none, game()), 1.0, 2.0);
}

TEST(Restarts, AfterTheBallLeftGoToTheOtherTeam) {
  using Over = Leaving::Over;
  const auto after = [](const Leaving& leaving, std::optional<std::size_t> last) {
    return restartAfter(leaving, last, kPitch, places(), game());
  };
  const auto expect = [](const Restart& restart, Kind kind, std::size_t team) {
    EXPECT_EQ(restart.kind, kind);
    EXPECT_EQ(restart.team, team);
  };
  for (const std::size_t last : {0u, 1u})
    expect(after({Over::kTouchLine, 2.0, 4.0}, last), Kind::kThrowIn, 1 - last);
  // Where nobody touched it, it is for who defends that half: blue at negative x.
  expect(after({Over::kTouchLine, 2.0, 4.0}, std::nullopt), Kind::kThrowIn, 1);
  expect(after({Over::kTouchLine, -2.0, 4.0}, std::nullopt), Kind::kThrowIn, 0);
  for (const std::size_t defender : {0u, 1u}) {
    const double end = defender == 0 ? -6.0 : 6.0;
    expect(after({Over::kGoalLine, end, 2.0}, defender), Kind::kCorner, 1 - defender);
    expect(after({Over::kGoalLine, end, 2.0}, 1 - defender), Kind::kGoalKick, defender);
    expect(after({Over::kGoalLine, end, 2.0}, std::nullopt), Kind::kGoalKick, defender);
    expectAt(after({Over::kGoalLine, end, -2.0}, defender), end > 0.0 ? 5.8 : -5.8, -3.8);
  }
}

TEST(Restarts, PutBackIsInsideOfTheLineThatWasCrossed) {
  using Over = Leaving::Over;
  const auto expectBack = [](const Leaving& leaving, double x, double y) {
    const FloorPoint back = putBack(leaving, kPitch, 0.5);
    EXPECT_NEAR(back.x, x, 1e-12);
    EXPECT_NEAR(back.y, y, 1e-12);
  };
  for (const double side : {1.0, -1.0}) {
    expectBack({Over::kTouchLine, 5.9, side * 4.0}, 5.9, side * 3.5);
    expectBack({Over::kGoalLine, side * 6.0, 3.9}, side * 5.5, 3.9);
  }
}

}  // namespace
}  // namespace ortung::soccer
