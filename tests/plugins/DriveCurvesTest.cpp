#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "NeuralRig.hpp"

/// Ways of drives and motion models on curves, in closed form.
namespace ortung {
namespace {

// Round the right wheel, which stands: only the left one has a way of which it can lose.
TEST(DriveCurves, AWheelThatStandsLosesNothingAndTheOtherItsShare) {
  const auto drive = makeDrive("differential",
                               "acceleration_m_s2 = 100\nturn_acceleration_deg_s2 = 36000\n"
                               "axle_m = 0.4\nmax_turn_deg_s = 720\nslip_share = 0.25");
  for (const bool isLeft : {true, false}) {
    drive->setCommand(std::array{isLeft ? 0.4 : 0.0, isLeft ? 0.0 : 0.4});
    drive->relocate(0.1, nullptr);
    const Pose2 change = drive->relocate(0.1, nullptr);  // the wheel gets 0.03 m of 0.04 m
    const double turn = (isLeft ? -0.03 : 0.03) / 0.4;
    EXPECT_NEAR(change.theta, turn, 1e-12);
    // The middle goes round the wheel that stands, at half of the axle.
    EXPECT_NEAR(change.x, 0.2 * std::sin(std::abs(turn)), 1e-12);
    EXPECT_NEAR(change.y, std::copysign(0.2 * (1.0 - std::cos(turn)), turn), 1e-12);
  }
}

// Odometry that errs by constant shares tells velocities that err by them, and without noise those
// that are.
TEST(DriveCurves, MeasuredVelocitiesHaveTheScalesOfOdometryUnlessNoNoiseIsWanted) {
  for (const char* plugin : {"differential", "omni"}) {
    const auto drive =
        makeDrive(plugin, "odometry_distance_scale = 1.2\nodometry_turn_scale = 0.8");
    drive->setTranslationalVelocity(0.2);
    drive->setRotationalVelocity(0.3);
    for (int i = 0; i < 100; ++i) drive->relocate(0.02, nullptr);
    EXPECT_NEAR(drive->measuredVelocity(false).x, 0.2, 1e-9) << plugin;
    EXPECT_NEAR(drive->measuredVelocity(false).theta, 0.3, 1e-9) << plugin;
    EXPECT_NEAR(drive->measuredVelocity(true).x, 0.24, 1e-9) << plugin;
    EXPECT_NEAR(drive->measuredVelocity(true).theta, 0.24, 1e-9) << plugin;
  }
}

using NeuralCurves = NeuralRig;

// A base that keeps its velocity and slides 0.03 m to the left in each step: wherever a step is
// cut, at its end the robot is where the network said.
TEST_F(NeuralCurves, AStepLeadsToWhereTheNetworkSaysOnAnArc) {
  for (const double turn : {0.0, 2.0, -2.5}) {
    const auto drive = makeDrive(
        "neural", settings(linearNetwork(std::vector<double>(20, 0.0), {0, 0.03, 0, 0, 0}, false)));
    drive->setVelocity({0.8, 0.0, turn});
    Pose2 pose;
    for (const double dt : {0.03, 0.05, 0.02}) pose = pose * drive->relocate(dt, nullptr);
    EXPECT_NEAR(pose.x, 0.08, 1e-9) << turn;
    EXPECT_NEAR(pose.y, 0.03, 1e-9) << turn;
    EXPECT_NEAR(pose.theta, 0.1 * turn, 1e-9);
    EXPECT_NEAR(drive->velocity().theta, turn, 1e-9);
    // On an arc the speed is that of the chord times (h / sin h), h half of the turn.
    const double h = 0.05 * turn;
    const double stretch = h == 0.0 ? 1.0 : h / std::sin(h);
    EXPECT_NEAR(std::hypot(drive->velocity().x, drive->velocity().y),
                stretch * std::hypot(0.08, 0.03) / 0.1, 1e-9);
  }
}

// A base that drives at what it is told when a step begins: 0, 1, 1, 0 and 0.5 m/s. Each reading
// comes at the end of a step, which is known then, and begins the next one.
TEST_F(NeuralCurves, AReadingAtTheEndOfAStepCommandsTheNextOne) {
  const auto motion = makeMotion("neural", settings(obedientNetwork(true)));
  double expected = 0.0;
  double last = 0.0;
  Timestamp stamp = 0;
  for (const double command : {0.0, 1.0, 1.0, 0.0, 0.5, 0.5}) {
    motion->follow(stamp, {{7, 7, 1}, command, 0.0, {}});
    expected += 0.1 * last;
    ASSERT_TRUE(motion->odometryAt(stamp));
    EXPECT_NEAR(motion->odometryAt(stamp)->x, expected, 1e-9) << toSeconds(stamp);
    last = command;
    stamp += 100'000;
  }
}

}  // namespace
}  // namespace ortung
