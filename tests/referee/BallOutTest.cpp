#include <gtest/gtest.h>

#include "BallOut.hpp"

namespace ortung::soccer {
namespace {

constexpr double kRadius = 0.1;
const Pitch kPitch{.halfLength = 6.0, .halfWidth = 4.0, .halfGoal = 1.0};

Scene::Ball ballAt(double x, double y) {
  return {.name = "ball", .x = x, .y = y, .radius = kRadius};
}

/// How a ball leaves that goes straight, by rules by which a goal takes the whole ball and being
/// out only its middle.
std::optional<Leaving::Over> leaving(const FloorPoint& from, const FloorPoint& to) {
  BallOut out({.wholeBall = false}, {.wholeBall = true});
  EXPECT_FALSE(out.look(ballAt(from.x, from.y), kPitch));
  const auto left = out.look(ballAt(to.x, to.y), kPitch);
  return left ? std::optional(left->over) : std::nullopt;
}

TEST(BallOut, InTheMouthOfTheGoalItIsNeitherOutNorAGoalYet) {
  using Over = Leaving::Over;
  for (const double end : {1.0, -1.0}) {
    EXPECT_EQ(leaving({end * 5.9, 0.9}, {end * 6.05, 0.9}), std::nullopt);
    EXPECT_EQ(leaving({end * 5.9, -0.9}, {end * 6.15, -0.9}), Over::kIntoGoal);
    EXPECT_EQ(leaving({end * 5.9, 1.1}, {end * 6.05, 1.1}), Over::kGoalLine) << "beside it";
    EXPECT_EQ(leaving({end * 5.9, 1.2}, {end * 6.05, 0.9}), Over::kGoalLine) << "from beside it";
    EXPECT_EQ(leaving({end * 5.9, -1.1}, {end * 6.15, -1.1}), Over::kGoalLine);
    EXPECT_EQ(leaving({end * 5.0, 3.9}, {end * 5.0, 4.05}), Over::kTouchLine);
  }
}

TEST(BallOut, OfAFastBallTellsWhereItCrossed) {
  BallOut out({.wholeBall = true, .margin = 0.3}, {.wholeBall = true});
  EXPECT_FALSE(out.look(ballAt(1.0, 3.4), kPitch));
  const auto left = out.look(ballAt(3.0, 5.4), kPitch);  // at y = 4 + 0.1 + 0.3: half of its way
  ASSERT_TRUE(left);
  EXPECT_EQ(left->over, Leaving::Over::kTouchLine);
  EXPECT_NEAR(left->x, 2.0, 1e-12);
  EXPECT_EQ(left->y, 4.0);
}

}  // namespace
}  // namespace ortung::soccer
