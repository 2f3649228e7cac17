/// The roll and pitch of a robot at any time.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "TiltHistory.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung::ros2 {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Quaterniond turned(double roll, double pitch, double yaw) {
  return AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(pitch, Vector3d::UnitY()) *
         AngleAxisd(roll, Vector3d::UnitX());
}
Quaternion told(const Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }
Quaternion told(double roll, double pitch, double yaw) { return told(turned(roll, pitch, yaw)); }

void expectTilt(const std::optional<Matrix3d>& found, double roll, double pitch,
                double within = 1e-6) {
  ASSERT_TRUE(found);
  EXPECT_LT((*found - turned(roll, pitch, 0.0).toRotationMatrix()).norm(), within);
}

TEST(TiltHistory, TheHeadingIsLeftOut) {
  TiltHistory tilts;
  for (int i = 0; i < 20; ++i) {
    const double roll = 0.02 * i - 0.2;
    const double pitch = 0.3 - 0.03 * i;
    ASSERT_TRUE(tilts.add(i, told(roll, pitch, 0.6 * i)));
    expectTilt(tilts.at(i, Matrix3d::Identity()), roll, pitch);
  }
}

// A unit that is mounted upside down and turned tells the same of the robot.
TEST(TiltHistory, TheUnitMayBeMountedInAnyWay) {
  const Quaterniond unit = turned(kTurn / 2, 0.4, 1.3);
  TiltHistory tilts;
  tilts.add(0, told(turned(0.1, -0.05, 2.0) * unit));
  expectTilt(tilts.at(0, unit.toRotationMatrix()), 0.1, -0.05);
}

TEST(TiltHistory, BetweenTwoAttitudesItIsInterpolatedWhateverTheirOrder) {
  TiltHistory tilts;
  tilts.add(200'000, told(0.04, 0.02, 3.1));
  tilts.add(100'000, told(0.02, 0.00, -3.1));
  expectTilt(tilts.at(150'000, Matrix3d::Identity()), 0.03, 0.01, 1e-4);
  expectTilt(tilts.at(100'000, Matrix3d::Identity()), 0.02, 0.00);
}

TEST(TiltHistory, AnAttitudeOfAnotherTimeIsNoneOfThisOne) {
  TiltHistory tilts;
  EXPECT_FALSE(tilts.at(0, Matrix3d::Identity()));
  tilts.add(1'000'000, told(0.1, 0.0, 0.0));
  tilts.add(3'000'000, told(0.3, 0.0, 0.0));
  expectTilt(tilts.at(500'000, Matrix3d::Identity()), 0.1, 0.0);
  EXPECT_FALSE(tilts.at(499'999, Matrix3d::Identity()));
  expectTilt(tilts.at(1'500'000, Matrix3d::Identity()), 0.1, 0.0);
  EXPECT_FALSE(tilts.at(2'000'000, Matrix3d::Identity()));
  expectTilt(tilts.at(2'500'000, Matrix3d::Identity()), 0.3, 0.0);
  EXPECT_FALSE(tilts.at(3'500'001, Matrix3d::Identity()));
}

TEST(TiltHistory, WhatIsNoRotationIsIgnoredAndARobotOnItsSideHasNoTilt) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  TiltHistory tilts;
  EXPECT_FALSE(tilts.add(0, {0, 0, 0, 0}));
  EXPECT_FALSE(tilts.add(0, {0, 0, 0, nan}));
  EXPECT_FALSE(tilts.add(0, {0, 0, 0, 1e300}));
  EXPECT_TRUE(tilts.isEmpty());
  EXPECT_TRUE(tilts.add(0, {0, 0, 0, 5}));
  expectTilt(tilts.at(0, Matrix3d::Identity()), 0, 0);
  EXPECT_TRUE(tilts.add(1'000'000, told(1.0, 0.0, 0.0)));
  EXPECT_FALSE(tilts.at(1'000'000, Matrix3d::Identity()));
}

TEST(TiltHistory, OnlyTheNewestAreKept) {
  TiltHistory tilts(10);
  for (int i = 0; i < 100; ++i) tilts.add(i * 1'000'000, told(0.001 * i, 0, 0));
  EXPECT_LT(tilts.size(), 20u);
  EXPECT_FALSE(tilts.at(50'000'000, Matrix3d::Identity()));
  expectTilt(tilts.at(95'000'000, Matrix3d::Identity()), 0.095, 0.0);
}

}  // namespace
}  // namespace ortung::ros2
