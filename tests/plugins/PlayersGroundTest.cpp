// What all players of games share: the ground that they know, and how a drive takes them over it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "players/common/Chassis.hpp"
#include "players/common/Ground.hpp"

namespace ortung {
namespace {

constexpr double kPi = std::numbers::pi;

/// The velocities that it was told last.
class Told : public RobotCommands {
 public:
  ~Told() override = default;
  void setTranslationalVelocity(double v) override { ahead = v; }
  void setRotationalVelocity(double w) override { turn = w; }
  void setMotion(std::span<const double>) override {}
  void setManipulator(std::string_view, std::string_view) override {}
  double ahead = NAN;
  double turn = NAN;
};

TEST(PlayersChassis, OnTwoWheelsFacesWhereItGoesBeforeItGoes) {
  const DriveLimits limits{.speed = 2.0, .turn = 4.0};
  const Chassis chassis(limits, std::nullopt);
  const auto move = [&](double heading, const FloorPoint& velocity) {
    Told told;
    chassis.move({0.0, 0.0, heading}, velocity, kPi, told);
    return told;
  };
  EXPECT_EQ(move(0.0, {1.0, 0.0}).ahead, 1.0);
  EXPECT_EQ(move(0.0, {1.0, 0.0}).turn, 0.0);
  EXPECT_EQ(move(kPi / 2, {0.0, 9.0}).ahead, 2.0) << "no faster than it can";
  const double slowed = move(0.4, {1.0, 0.0}).ahead;
  EXPECT_GT(slowed, 0.2);
  EXPECT_LT(slowed, 0.8);
  EXPECT_LT(move(0.2, {1.0, 0.0}).turn, 0.0);
  EXPECT_GT(move(-0.2, {1.0, 0.0}).turn, 0.0);
  for (const double heading : {kPi / 2, -kPi / 2, kPi, -2.0})
    EXPECT_EQ(move(heading, {1.0, 0.0}).ahead, 0.0) << "it turns on the spot from " << heading;
  EXPECT_EQ(move(kPi, {0.0, 0.0}).turn, 0.0) << "who stands faces as is wanted";
}

/// A field of 8 x 4 m whose goals are the walls.
FieldModel fieldOf(const std::vector<FieldWall>& walls) {
  FieldModel field;
  field.walls = walls;
  for (const double x : {-4.0, 4.0}) field.landmarks.push_back({1, "goal", x, 0.0, 0.5});
  FieldLine line;
  line.shape = FieldLine::Shape::kStraight;
  line.x0 = -4.0, line.x1 = 4.0;
  line.y0 = line.y1 = 2.0;
  field.lines.push_back(line);
  return field;
}

TEST(PlayersGround, IsAsLargeAsItsGoalsAndLinesSayUnlessItIsTold) {
  const Ground ground = Ground::of(fieldOf({}), {});
  EXPECT_EQ(ground.halfLength, 4.0);
  EXPECT_EQ(ground.halfWidth, 2.0);
  Ground sizes;
  sizes.halfLength = 5.0;
  sizes.halfWidth = 3.0;
  EXPECT_EQ(Ground::of(fieldOf({}), sizes).halfLength, 5.0);
  EXPECT_EQ(Ground::of(fieldOf({}), sizes).halfWidth, 3.0);
  EXPECT_THROW(Ground::of({}, {}), std::runtime_error);
}

TEST(PlayersGround, ItsGoalsAreAsWideAsTheirSidesAreApart) {
  const auto mouth = [](const std::vector<FieldWall>& walls) {
    Ground sizes;
    sizes.halfMouth = 0.0;  // nobody has said
    return Ground::of(fieldOf(walls), sizes).halfMouth;
  };
  const auto side = [](double y, bool ofGoal) {
    return FieldWall{.x0 = 4.0, .y0 = y, .x1 = 4.5, .y1 = y, .zHigh = 1.0, .ofGoal = ofGoal};
  };
  EXPECT_EQ(mouth({side(0.7, true), side(-0.75, true)}), 0.7);
  EXPECT_EQ(mouth({side(0.7, true), side(0.3, false)}), 0.7) << "a wall is no goal";
  EXPECT_EQ(mouth({}), 1.0) << "as usual";
  EXPECT_EQ(mouth({side(0.1, true)}), 1.0) << "no ball fits through";
}

}  // namespace
}  // namespace ortung
