/// The velocity of a robot at the time of a sweep.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "VelocityHistory.hpp"

namespace ortung::ros2 {
namespace {

TEST(VelocityHistory, BetweenTwoItIsInterpolated) {
  VelocityHistory velocities;
  velocities.add(200'000, {2, 0.2, 0.02});
  velocities.add(100'000, {1, 0.1, 0.01});
  EXPECT_EQ(velocities.at(100'000).forward, 1.0);
  EXPECT_NEAR(velocities.at(150'000).left, 0.15, 1e-12);
  EXPECT_EQ(velocities.at(200'000).turn, 0.02);
  EXPECT_EQ(velocities.at(700'000).forward, 2.0);
  EXPECT_EQ(velocities.at(700'001).forward, 0.0) << "it is too old";
  EXPECT_EQ(velocities.at(50'000).forward, 1.0) << "the first one holds before, too";
  EXPECT_EQ(velocities.at(-400'001).forward, 0.0);
}

TEST(VelocityHistory, WhatNoRobotHasIsLeftOut) {
  VelocityHistory velocities;
  velocities.add(0, {101, 0, 0});
  velocities.add(0, {0, 0, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_EQ(velocities.at(0).forward, 0.0);
  EXPECT_EQ(velocities.at(0).turn, 0.0);
}

// A quarter of a turn on the spot and a step to the left, each in a tenth of a second.
TEST(VelocityHistory, PosesTellItInTheRobotsFrame) {
  VelocityHistory velocities;
  const double quarter = std::numbers::pi / 2;
  velocities.addPose(0, {1, 1, quarter});
  velocities.addPose(100'000, {1, 1, 2 * quarter});
  velocities.addPose(200'000, {1, 0.9, 2 * quarter});
  velocities.addPose(200'000, {5, 5, 0});
  velocities.addPose(900'000, {5, 6, 0});
  EXPECT_NEAR(velocities.at(100'000).turn, quarter / 0.1, 1e-9);
  EXPECT_NEAR(velocities.at(100'000).left, 0.0, 1e-9);
  EXPECT_NEAR(velocities.at(200'000).left, 1.0, 1e-9);
  EXPECT_NEAR(velocities.at(200'000).forward, 0.0, 1e-9);
  EXPECT_EQ(velocities.at(900'000).forward, 0.0) << "0.7 s are no step";
}

TEST(VelocityHistory, OnlyTheNewestAreKept) {
  VelocityHistory velocities(10);
  for (int i = 0; i < 100; ++i) velocities.add(i * 1'000'000, {1.0 + i, 0, 0});
  EXPECT_EQ(velocities.at(50'000'000).forward, 0.0);
  EXPECT_EQ(velocities.at(95'000'000).forward, 96.0);
}

}  // namespace
}  // namespace ortung::ros2
