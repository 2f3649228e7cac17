#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "FakeWorld.hpp"
#include "WorldFiles.hpp"
#include "ortung/sim/RoutePlanner.hpp"

namespace ortung {
namespace {

/// A room cut in two by a row of posts with one gap at y = @p gap, or none.
FakeWorld cutRoom(double gap) {
  FakeWorld room(8.0, 6.0);
  for (double y = -3.0; y <= 3.0; y += 0.2)
    if (std::abs(y - gap) > 0.55) room.addPost({1.0, y, 0.15});
  return room;
}

TEST(RoutePlanner, GoesStraightWhereNothingIsInTheWay) {
  const RoutePlanner planner(FakeWorld(8.0, 6.0), {0.25});
  const std::vector<FloorPoint> route = planner.route({-3.0, -2.0}, {3.0, 2.0});
  ASSERT_EQ(route.size(), 1u);
  EXPECT_NEAR(route[0].x, 3.0, 0.11);
  EXPECT_NEAR(route[0].y, 2.0, 0.11);
}

TEST(RoutePlanner, PlansInLargeWorlds) {
  // Cells become coarser, but no way leads through a thin wall.
  for (const double width : {900.0, 3000.0}) {
    const std::string w = std::to_string(width / 2.0);
    const auto world = test::worldOf("[world]\nx_m = [-" + w + ", " + w +
                                     "]\ny_m = [-100, 100]\n[[rectangle]]\ncenter_m = "
                                     "[0, -20]\nsize_m = [0.05, 160]\n");
    const RoutePlanner planner(*world, {0.25});
    const std::vector<FloorPoint> route =
        planner.route({-width / 4.0, -50.0}, {width / 4.0, -50.0});
    ASSERT_GE(route.size(), 2u) << width;
    FloorPoint from{-width / 4.0, -50.0};
    double way = 0.0;
    for (const FloorPoint& to : route) {
      if ((from.x < 0.0) != (to.x < 0.0)) {
        const double y = from.y - from.x / (to.x - from.x) * (to.y - from.y);
        EXPECT_GT(y, 60.25) << width;  // around its end
      }
      way += std::hypot(to.x - from.x, to.y - from.y);
      from = to;
    }
    EXPECT_LT(way, 1.1 * 2.0 * std::hypot(width / 4.0, 112.0)) << width;
  }
}

TEST(RoutePlanner, FindsTheGapAndKeepsClear) {
  const FakeWorld room = cutRoom(2.0);
  const RoutePlanner planner(room, {0.25});
  const FloorPoint start{0.0, -2.0};
  const std::vector<FloorPoint> route = planner.route(start, {3.0, -2.0});
  ASSERT_GE(route.size(), 2u);
  FloorPoint from = start;
  double way = 0.0;
  for (const FloorPoint& to : route) {
    for (int i = 0; i <= 100; ++i) {
      const double share = i / 100.0;
      EXPECT_TRUE(
          room.isFree(from.x + share * (to.x - from.x), from.y + share * (to.y - from.y), {0.25}));
    }
    way += std::hypot(to.x - from.x, to.y - from.y);
    from = to;
  }
  // By the gap's middle it is hypot(1, 4) + hypot(2, 4); cells cost a little more.
  EXPECT_LT(way, 1.1 * (std::hypot(1.0, 4.0) + std::hypot(2.0, 4.0)));
}

TEST(RoutePlanner, KeepsToTheLargestPart) {
  const FakeWorld room = cutRoom(100.0);
  const RoutePlanner planner(room, {0.25});
  EXPECT_TRUE(planner.contains(-2.0, 0.0));
  EXPECT_FALSE(planner.contains(2.0, 0.0));  // 3 m wide, the other is 5 m
  Random random(1);
  for (int i = 0; i < 200; ++i) EXPECT_LT(planner.randomPose(random).x, 1.0);
}

// As the learner does: walls around 36 m^2 in a world of 100 m^2 make a hall, not a hut.
TEST(RoutePlanner, KeepsToTheHallThoughThereIsMoreOutside) {
  std::string toml = "[world]\nx_m = [-5, 5]\ny_m = [-5, 5]\n";
  for (const char* wall : {"[0, 3]\nsize_m = [6.1, 0.1]", "[0, -3]\nsize_m = [6.1, 0.1]",
                           "[3, 0]\nsize_m = [0.1, 6.1]", "[-3, 0]\nsize_m = [0.1, 6.1]"})
    toml += std::string("[[rectangle]]\ncenter_m = ") + wall + "\n";
  const RoutePlanner planner(*test::worldOf(toml), {0.25});
  EXPECT_TRUE(planner.contains(0.0, 0.0));
  EXPECT_TRUE(planner.contains(2.5, -2.5));
  EXPECT_FALSE(planner.contains(4.0, 4.0));
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Pose2 pose = planner.randomPose(random);
    EXPECT_LT(std::max(std::abs(pose.x), std::abs(pose.y)), 3.0);
  }
}

TEST(RoutePlanner, TheEndsOfTheFieldAreNotNeighbours) {
  // So small a robot that the outermost cells are free, too: what lies beyond one side of the field
  // is not the other side.
  const FakeWorld room = cutRoom(100.0);
  const RoutePlanner planner(room, {0.01}, 0.0);
  EXPECT_TRUE(planner.contains(-3.97, 0.0));
  EXPECT_TRUE(planner.contains(-3.97, -2.97));
  EXPECT_FALSE(planner.contains(3.97, 0.0));
  EXPECT_FALSE(planner.contains(2.0, 0.0));
  const FakeWorld open(8.0, 6.0);
  const RoutePlanner everywhere(open, {0.01}, 0.0);
  ASSERT_EQ(everywhere.cells().size(), 80u * 60u);
  // From end to end there is nothing shorter than straight on.
  EXPECT_EQ(everywhere.route({-3.95, 0.05}, {3.95, 0.05}).size(), 1u);
}

TEST(RoutePlanner, LeadsBackFromWhereItsMapEnds) {
  const RoutePlanner planner(FakeWorld(8.0, 6.0), {0.25});
  const std::vector<FloorPoint> route = planner.route({-3.74, 0.0}, {2.0, 0.0});
  ASSERT_FALSE(route.empty());
  EXPECT_TRUE(planner.contains(route.front().x, route.front().y));
}

TEST(RoutePlanner, RefusesARobotThatFitsNowhere) {
  EXPECT_THROW(RoutePlanner(FakeWorld(1.0, 1.0), {0.6}), std::invalid_argument);
}

}  // namespace
}  // namespace ortung
