#include <gtest/gtest.h>

#include <algorithm>

#include "NeuralRig.hpp"
#include "ortung/formats/Words.hpp"

namespace ortung {
namespace {

using NeuralPlugin = NeuralRig;

TEST_F(NeuralPlugin, DrivesAsItsNetworkSaysInAnyCycle) {
  for (const double dt : {0.01, 0.1, 0.033}) {
    const auto drive = makeDrive("neural", settings(obedientNetwork(false)));
    drive->setTranslationalVelocity(0.5);
    drive->setRotationalVelocity(0.0);
    Pose2 pose;
    double t = 0.0;
    for (; t + dt <= 1.0 + 1e-9; t += dt) pose = pose * drive->relocate(dt, nullptr);
    EXPECT_NEAR(pose.x, 0.5 * t, 1e-9) << dt;
    EXPECT_NEAR(drive->velocity().x, 0.5, 1e-12);
  }
}

// The network looks at the command once a step, of 0.1 s: one at 0.33 s counts from 0.4 s on.
TEST_F(NeuralPlugin, ACommandWithinAStepCountsFromTheNextOneOn) {
  const auto drive = makeDrive("neural", settings(obedientNetwork(false)));
  drive->setTranslationalVelocity(0.5);
  Pose2 pose;
  for (int i = 1; i <= 100; ++i) {
    if (i == 34) drive->setTranslationalVelocity(-0.2);
    pose = pose * drive->relocate(0.01, nullptr);
    const double t = 0.01 * i;
    EXPECT_NEAR(pose.x, 0.5 * std::min(t, 0.4) - 0.2 * std::max(t - 0.4, 0.0), 1e-9) << t;
    EXPECT_NEAR(drive->velocity().x, i <= 40 ? 0.5 : -0.2, 1e-9) << t;
  }
}

TEST_F(NeuralPlugin, TellsItsCommandsAndKeepsToItsLimits) {
  const auto drive = makeDrive("neural", settings(obedientNetwork(false)));
  drive->setTranslationalVelocity(9.0);
  drive->setRotationalVelocity(-9.0);
  drive->measure({}, nullptr);
  ASSERT_EQ(drive->motionData().size(), 2U);
  EXPECT_NEAR(words::toSignedMetres(drive->motionData()[0]), 2.0, 0.0006);
  EXPECT_NEAR(words::toRate(drive->motionData()[1]), -3.0, 0.0002);
}

TEST_F(NeuralPlugin, ACommandVectorIsItsTwoVelocities) {
  const auto drive = makeDrive("neural", settings(obedientNetwork(false)));
  drive->setCommand(std::array{0.5, -1.25});
  drive->measure({}, nullptr);
  ASSERT_EQ(drive->motionData().size(), 2U);
  EXPECT_NEAR(words::toSignedMetres(drive->motionData()[0]), 0.5, 0.0006);
  EXPECT_NEAR(words::toRate(drive->motionData()[1]), -1.25, 0.0002);
}

// Commands of 1 m/s from 0.1 s on: the network sees each at the beginning of its step.
TEST_F(NeuralPlugin, FollowsCommandsInsteadOfOdometry) {
  const auto motion = makeMotion("neural", settings(obedientNetwork(true)));
  EXPECT_FALSE(motion->odometryAt(0));
  for (int i = 0; i <= 100; ++i) {
    const double v = i >= 10 ? 1.0 : 0.0;
    motion->follow(i * 10000, {{7, 7, 1}, v, 0.0, {}});  // what its pose says is of no concern
  }
  ASSERT_TRUE(motion->odometryAt(1000000));
  EXPECT_NEAR(motion->odometryAt(1000000)->x, 0.9, 1e-9);
  EXPECT_NEAR(motion->odometryAt(500000)->x, 0.4, 1e-9);
  motion->forget();
  EXPECT_FALSE(motion->odometryAt(1000000));
}

TEST_F(NeuralPlugin, RefusesBadFilesAndMisspeltKeys) {
  EXPECT_THROW(makeDrive("neural", ""), ConfigError);
  EXPECT_THROW(makeDrive("neural", "network_file = \"/nowhere/net.json\""), ConfigError);
  test::writeBytes(folder_ / "bad.json", "{}");
  EXPECT_THROW(makeDrive("neural", "network_file = \"" + (folder_ / "bad.json").string() + "\""),
               ConfigError);
  EXPECT_THROW(makeMotion("neural", settings(obedientNetwork(true)) + "\nturn_per_trun = 1"),
               ConfigError);
}

}  // namespace
}  // namespace ortung
