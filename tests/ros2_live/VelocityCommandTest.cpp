/// What a robot is told at cmd_vel: limits, no numbers, and the end of commands.
#include <gtest/gtest.h>

#include <cmath>

#include "VelocityCommand.hpp"

namespace ortung::ros2 {
namespace {

using Velocity = VelocityCommand::Velocity;

std::string twist(double forward, double turn, double left = 0.0) {
  return toCdr(Twist{{forward, left, 0.0}, {0.0, 0.0, turn}});
}
std::string stamped(std::int64_t stamp, double forward) {
  return toCdr(TwistStamped{{stamp, "base_link"}, {{forward, 0.0, 0.0}, {}}});
}

constexpr Timestamp kSecond = 1'000'000;

TEST(VelocityCommand, SaysOnlyWhatIsNew) {
  VelocityCommand command({});
  EXPECT_EQ(command.due(0), std::nullopt) << "a robot that nobody tells anything stands";
  command.take(twist(0.4, -0.2));
  EXPECT_EQ(command.due(10), (Velocity{0.4, -0.2}));
  command.take(twist(0.4, -0.2));
  EXPECT_EQ(command.due(20), std::nullopt);
  command.take(twist(0.1, 0.0));
  command.take(twist(0.3, 0.0));
  EXPECT_EQ(command.due(30), (Velocity{0.3, 0.0})) << "the newest counts";
}

TEST(VelocityCommand, StopsOnceNothingIsCommanded) {
  VelocityCommand command({});
  command.take(twist(0.4, 0.0));
  EXPECT_TRUE(command.due(kSecond));
  EXPECT_EQ(command.due(kSecond + 499'999), std::nullopt);
  EXPECT_EQ(command.due(kSecond + 500'000), (Velocity{}));
  EXPECT_EQ(command.due(9 * kSecond), std::nullopt);
  command.take(twist(0.4, 0.0));
  EXPECT_EQ(command.due(9 * kSecond), (Velocity{0.4, 0.0})) << "and obeys again";
}

TEST(VelocityCommand, GoesNotBeyondItsLimits) {
  VelocityCommand command({.mostForward = 0.5, .mostTurn = 1.0});
  command.take(twist(-3.0, 2.0));
  EXPECT_EQ(command.due(0), (Velocity{-0.5, 1.0}));
  EXPECT_EQ(command.leftOut().at("more than the robot can do, which is cut"), 2u);
}

TEST(VelocityCommand, RefusesWhatIsNone) {
  VelocityCommand command({});
  command.take("no message");
  command.take(twist(NAN, 0.0));
  command.take(twist(0.0, INFINITY));
  command.takeStamped(twist(0.1, 0.0).substr(0, 20));
  EXPECT_EQ(command.due(0), std::nullopt);
  EXPECT_EQ(command.leftOut().at("a velocity that is no number"), 2u);
  EXPECT_EQ(command.leftOut().size(), 3u);
  command.take(twist(0.1, 0.0, 0.2));
  EXPECT_EQ(command.due(0), (Velocity{0.1, 0.0})) << "what goes sideways is left out";
  EXPECT_EQ(command.leftOut().at("a velocity sideways, which no robot is told"), 1u);
}

TEST(VelocityCommand, LeavesOutWhatIsStampedLongAgo) {
  VelocityCommand command({});
  command.takeStamped(stamped(1'000'000'000, 0.1));
  EXPECT_EQ(command.due(kSecond + 500'001), std::nullopt);
  EXPECT_EQ(command.leftOut().at("a command that is too old"), 1u);
  command.takeStamped(stamped(1'000'000'000, 0.1));
  EXPECT_EQ(command.due(kSecond + 500'002), std::nullopt);
  command.takeStamped(stamped(1'100'000'000, 0.2));
  EXPECT_EQ(command.due(kSecond + 500'003), (Velocity{0.2, 0.0}));
  command.takeStamped(stamped(0, 0.3));
  EXPECT_EQ(command.due(kSecond + 500'004), (Velocity{0.3, 0.0})) << "0: without a time";
}

TEST(VelocityCommand, ForgetsWhenTheClockIsSetBack) {
  VelocityCommand command({});
  command.take(twist(0.4, 0.0));
  EXPECT_TRUE(command.due(5 * kSecond));
  EXPECT_EQ(command.due(0), (Velocity{})) << "a simulation that began anew";
  command.take(twist(0.4, 0.0));
  EXPECT_EQ(command.due(10), (Velocity{0.4, 0.0}));
}

}  // namespace
}  // namespace ortung::ros2
