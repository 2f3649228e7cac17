// What footballers decide: who attacks, which way is free, where to shoot, where the ball is met.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Aim.hpp"
#include "Go.hpp"
#include "Intercept.hpp"
#include "Places.hpp"
#include "Roles.hpp"
#include "Situation.hpp"
#include "TeamTalk.hpp"

namespace ortung::football {
namespace {

TEST(FootballRoles, AreSharedSoThatEachIsThereOnce) {
  const std::vector<Candidate> all = {{"a", 3.0, {2.0, 0.0}},
                                      {"b", 1.0, {0.0, 1.0}},
                                      {"c", 2.0, {-3.0, 0.0}},
                                      {"d", 4.0, {1.0, 1.0}}};
  const auto role = [&](const char* name) { return shareRoles(all, name, {-2.5, 0.0}, 1.0); };
  EXPECT_EQ(role("b"), Role::kAttack);
  EXPECT_EQ(role("c"), Role::kCover);
  EXPECT_EQ(role("a"), Role::kSupport);
  EXPECT_EQ(role("d"), Role::kWing);
  // The other way round the foremost is another one.
  EXPECT_EQ(shareRoles(all, "d", {-2.5, 0.0}, -1.0), Role::kSupport);
}

TEST(FootballRoles, EqualsAreToldApartByName) {
  const std::vector<Candidate> all = {{"b", 1.0, {}}, {"a", 1.0, {}}};
  EXPECT_EQ(shareRoles(all, "a", {}, 1.0), Role::kAttack);
  EXPECT_EQ(shareRoles(all, "b", {}, 1.0), Role::kCover);
  EXPECT_EQ(shareRoles({{"a", 1000.0, {}}}, "a", {}, 1.0), Role::kAttack);
}

TEST(FootballTalk, IsReadAsItWasSaid) {
  const Word said{1.25, {-3.5, 2.125}, RollingBall{{0.5, -0.25}, 1.0, -2.0, 0.3}};
  const auto heard = Word::parse(said.text(), 0.3);
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->cost, 1.25);
  EXPECT_EQ(heard->at.x, -3.5);
  EXPECT_EQ(heard->at.y, 2.125);
  ASSERT_TRUE(heard->ball);
  EXPECT_EQ(heard->ball->at.y, -0.25);
  EXPECT_EQ(heard->ball->speedY, -2.0);
  EXPECT_FALSE(Word::parse(Word{1.0, {}, std::nullopt}.text(), 0.3)->ball);
}

TEST(FootballTalk, NonsenseIsNoWord) {
  for (const char* text : {"", "hello", "fb", "fb 1 2 3", "fb 1 2 3 1 4 5 6 7 8",
                           "fb nan 2 3 1 4 5 6 7", "fb 1 2 inf 1 4 5 6 7", "fb 1 2 3 1 4 5 6 1e300",
                           "FB 1 2 3 1 4 5 6 7", "fb 1 2 3 1 4 5 6 7x"})
    EXPECT_FALSE(Word::parse(text, 0.3)) << text;
}

TEST(FootballTalk, WhoIsSilentIsForgotten) {
  Mates mates(0.3);
  const std::vector<Heard> heard = {{"b2", 1'000'000, Word{1.0, {1, 1}, std::nullopt}.text()},
                                    {"b3", 1'000'000, "something else"}};
  mates.hear(heard, 1'010'000);
  EXPECT_EQ(mates.told().size(), 1u);
  mates.hear({}, 1'900'000);
  EXPECT_EQ(mates.told().size(), 1u);
  mates.hear({}, 2'100'000);
  EXPECT_TRUE(mates.told().empty());
}

// By hand: a disc of 0.4 m two metres ahead needs 0.4 + 0.36 + 0.06 m; nothing is nearer than 1.2
// m.
TEST(FootballGo, GoesStraightWhereNothingIsNear) {
  Go go;
  EXPECT_DOUBLE_EQ(*go.direction({}, {5.0, 0.0}, 0.36, {}), 0.0);
  EXPECT_DOUBLE_EQ(*go.direction({}, {5.0, 0.0}, 0.36, {{{2.1, 0.0}, 0.4}}), 0.0);
  EXPECT_DOUBLE_EQ(*go.direction({}, {5.0, 0.0}, 0.36, {{{-0.5, 0.0}, 0.4}}), 0.0) << "behind it";
  EXPECT_DOUBLE_EQ(*go.direction({}, {0.0, -5.0}, 0.36, {}), -std::numbers::pi / 2.0);
}

TEST(FootballGo, GoesRoundWhatIsInTheWay) {
  for (const double aside : {-0.3, 0.0, 0.3}) {
    Go go;
    const Disc disc{{1.2, aside}, 0.4};
    const auto way = go.direction({}, {5.0, 0.0}, 0.36, {disc});
    ASSERT_TRUE(way);
    EXPECT_GE(distanceToWay(disc.at, {}, 1.2 * towards(*way)), 0.36 + 0.4);
    EXPECT_LE(*way * aside, 0.0) << "round the nearer side";
  }
}

TEST(FootballGo, KeepsToItsSide) {
  Go go;
  const auto first = go.direction({}, {5.0, 0.0}, 0.36, {{{1.2, 0.05}, 0.4}});
  const auto then = go.direction({}, {5.0, 0.0}, 0.36, {{{1.2, -0.05}, 0.4}});
  EXPECT_GT(*first * *then, 0.0);
}

TEST(FootballGo, LeavesWhatItTouchesAndStandsWhereItIsShutIn) {
  Go go;
  EXPECT_TRUE(go.direction({}, {5.0, 0.0}, 0.36, {{{-0.5, 0.0}, 0.4}, {{-0.4, 0.3}, 0.4}}));
  std::vector<Disc> ring;
  for (int i = 0; i < 12; ++i) ring.push_back({0.9 * towards(i * std::numbers::pi / 6.0), 0.4});
  EXPECT_FALSE(go.direction({}, {5.0, 0.0}, 0.36, ring));
}

// A ball that rolls away with 2 m/s and is braked by 0.3 m/s^2 is caught where both have been as
// long.
TEST(FootballIntercept, MeetsARollingBallWhereBothComeAtTheSameTime) {
  const DriveLimits limits{3.0, 6.0, 4.0, 20.0};
  const RollingBall ball{{2.0, 0.0}, 2.0, 0.0, 0.3};
  const Meeting meeting = meet(ball, {0.0, 0.0, 0.0}, limits);
  EXPECT_NEAR(meeting.at.x, ball.later(meeting.after).x, 0.25);
  EXPECT_NEAR(meeting.at.x / 3.0, meeting.after, 0.5);
  EXPECT_GT(meeting.after, 2.0 / 3.0);
  // One that lies is met where it lies.
  const Meeting lying = meet({{3.0, 0.0}, 0.0, 0.0, 0.3}, {0.0, 0.0, 0.0}, limits);
  EXPECT_EQ(lying.at.x, 3.0);
  EXPECT_NEAR(lying.after, 1.0 + 0.375, 1e-9);  // its way and half the time to get fast
}

TEST(FootballAim, ShootsWhereTheKeeperIsNot) {
  Situation s;
  s.view.others = {{{5.5, 0.5}, {}, 0.32, false, false}};
  const auto corner = openCorner(s.moment(), {2.0, 0.0});
  ASSERT_TRUE(corner);
  EXPECT_LT(corner->y, -0.3);
  EXPECT_EQ(corner->x, 6.0);
  // Nobody comes through a wall of three.
  s.view.others = {{{3.0, 0.0}, {}, 0.4, false, false},
                   {{3.0, 0.7}, {}, 0.4, false, false},
                   {{3.0, -0.7}, {}, 0.4, false, false}};
  EXPECT_FALSE(openCorner(s.moment(), {2.0, 0.0}));
}

TEST(FootballAim, PassesToAMateWhoIsFreeAndAhead) {
  Situation s;
  const Other ahead{{3.0, 1.5}, {}, 0.36, true, false};
  const Other behind{{-3.0, 1.5}, {}, 0.36, true, false};
  s.view.others = {behind, ahead};
  auto mate = bestMate(s.moment(), {0.28, 0.0}, 0.5);
  ASSERT_TRUE(mate);
  EXPECT_NEAR(mate->x, 3.4, 1e-9);  // into his way
  EXPECT_NEAR(mate->y, 1.5, 1e-9);
  s.view.others.push_back({{1.7, 0.75}, {}, 0.36, false, false});  // in between
  EXPECT_FALSE(bestMate(s.moment(), {0.28, 0.0}, 0.5));
  EXPECT_TRUE(bestMate(s.moment(), {0.28, 0.0}, 4.0)) << "back, if need be";
  s.view.others = {{{3.0, 1.5}, {}, 0.36, true, true}};
  EXPECT_FALSE(bestMate(s.moment(), {0.28, 0.0}, 0.5)) << "not to the keeper";
}

TEST(FootballPlaces, CoverIsBetweenBallAndGoalAndNobodyIsInTheTakersWay) {
  const Ground ground = field();
  for (const double forward : {1.0, -1.0}) {
    const FloorPoint ball{forward * 2.0, 1.0};
    const FloorPoint cover = placeOf(Role::kCover, ground, forward, ball);
    EXPECT_NEAR(distanceToWay(cover, ball, ground.goal(-forward)), 0.0, 1e-9);
    for (double x = -6.0; x <= 6.0; x += 0.5)
      for (double y = -4.0; y <= 4.0; y += 0.5)
        for (const Role role : {Role::kCover, Role::kSupport, Role::kWing}) {
          const FloorPoint place = placeOf(role, ground, forward, {x, y});
          EXPECT_LE(std::abs(place.x), 6.0 - 0.4 + 1e-9);
          EXPECT_LE(std::abs(place.y), 4.0 - 0.4 + 1e-9);
          EXPECT_GT(lengthOf(place - FloorPoint{x, y}), 0.7);
        }
  }
}

}  // namespace
}  // namespace ortung::football
