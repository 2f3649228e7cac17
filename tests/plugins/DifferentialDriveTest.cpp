#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "MotionRig.hpp"
#include "ortung/formats/Words.hpp"

namespace ortung {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;  // [rad]

TEST(DifferentialDrive, AcceleratesAsPhysicsSays) {
  const auto drive = makeDrive("differential", "acceleration_m_s2 = 0.5\nmax_speed_m_s = 1.0");
  drive->setTranslationalVelocity(5.0);  // more than it can
  Pose2 pose;
  for (int i = 0; i < 100; ++i) pose = pose * drive->relocate(0.01, nullptr);
  EXPECT_NEAR(pose.x, 0.25, 1e-9);  // a t^2 / 2
  EXPECT_NEAR(drive->velocity().x, 0.5, 1e-9);
  for (int i = 0; i < 200; ++i) drive->relocate(0.01, nullptr);
  EXPECT_NEAR(drive->velocity().x, 1.0, 1e-9);
}

TEST(DifferentialDrive, DrivesAnExactCircle) {
  const auto drive =
      makeDrive("differential", "acceleration_m_s2 = 100\nturn_acceleration_deg_s2 = 36000");
  drive->setTranslationalVelocity(0.5);
  drive->setRotationalVelocity(1.0);
  drive->relocate(0.01, nullptr);  // at speed from here on
  Pose2 pose;
  for (int i = 0; i < 100; ++i) pose = pose * drive->relocate(0.01, nullptr);
  EXPECT_NEAR(pose.x, 0.5 * std::sin(1.0), 1e-9);
  EXPECT_NEAR(pose.y, 0.5 * (1.0 - std::cos(1.0)), 1e-9);
  EXPECT_NEAR(pose.theta, 1.0, 1e-9);
}

TEST(DifferentialDrive, TurnsWheelSpeedsIntoVelocitiesAndKeepsTheCurveAtItsLimits) {
  const auto drive = makeDrive("differential", R"(axle_m = 0.4
    acceleration_m_s2 = 100
    turn_acceleration_deg_s2 = 36000
    max_speed_m_s = 1)");
  ASSERT_EQ(drive->commandSize(), 2u);
  drive->setCommand(std::array{0.4, 0.6});
  drive->relocate(0.1, nullptr);
  EXPECT_NEAR(drive->velocity().x, 0.5, 1e-12);      // mean of both wheels
  EXPECT_NEAR(drive->velocity().theta, 0.5, 1e-12);  // 0.2 m/s over 0.4 m
  drive->setCommand(std::array{1.6, 2.4});           // 2 m/s on the same curve
  drive->relocate(0.1, nullptr);
  EXPECT_NEAR(drive->velocity().x, 1.0, 1e-12);
  EXPECT_NEAR(drive->velocity().theta, 1.0, 1e-12);
  drive->measure({}, nullptr);
  ASSERT_EQ(drive->motionData().size(), 4u);
  EXPECT_NEAR(words::toSignedMetres(drive->motionData()[0]), 0.8, 0.0006);
  EXPECT_NEAR(words::toSignedMetres(drive->motionData()[1]), 1.2, 0.0006);
  // The command, of which its limits have made less.
  EXPECT_NEAR(words::toSignedMetres(drive->motionData()[2]), 1.0, 0.0006);
  EXPECT_NEAR(words::toRate(drive->motionData()[3]), 1.0, 0.0002);
}

TEST(DifferentialDrive, WheelsThatSlipGetLessFarThanTheyMeasure) {
  const auto drive = makeDrive("differential", R"(slip_share = 0.1
    acceleration_m_s2 = 100
    odometry_distance_sigma_m = 0
    odometry_heading_sigma_deg = 0
    odometry_turn_sigma_deg = 0)");
  drive->setTranslationalVelocity(0.5);
  drive->relocate(0.1, nullptr);
  const Pose2 change = drive->relocate(0.1, nullptr);
  EXPECT_NEAR(change.x, 0.045, 1e-12);
  Random noise(1);
  EXPECT_NEAR(drive->measure(change, &noise).x, 0.05, 1e-12);
}

TEST(DifferentialDrive, SlipsAtRandomByTheSigmaThatItsFileSays) {
  Statistics ways;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    const auto drive = makeDrive("differential", "slip_sigma_m = 0.05\nacceleration_m_s2 = 100");
    Random noise(seed);
    drive->setTranslationalVelocity(0.5);
    drive->relocate(0.01, &noise);
    double way = 0.0;
    for (int i = 0; i < 20; ++i) way += drive->relocate(0.1, &noise).x;
    ways.add(way);
  }
  EXPECT_NEAR(ways.mean(), 1.0, 0.004);
  EXPECT_NEAR(ways.sigma(), 0.05 / std::sqrt(2.0), 0.003);  // of the mean of two wheels, over 1 m
}

TEST(DifferentialDrive, EncodersTellWholeTicks) {
  const auto drive = makeDrive("differential", R"(encoder_ticks_per_m = 100
    odometry_distance_sigma_m = 0
    odometry_heading_sigma_deg = 0
    odometry_turn_sigma_deg = 0)");
  Random noise(1);
  double sum = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double seen = drive->measure({0.0043, 0.0, 0.0}, &noise).x;
    EXPECT_NEAR(seen * 100.0, std::round(seen * 100.0), 1e-9);
    sum += seen;
  }
  EXPECT_NEAR(sum, 4.3, 0.0101);  // no way gets lost but the last tick's
}

TEST(DifferentialDrive, ReadsAndRefusesByName) {
  EXPECT_EQ(makeDrive("differential", "max_speed_m_s = 2")->limits().speed, 2.0);
  try {
    makeDrive("differential", "max_speed = 2");
    FAIL() << "an unknown key was accepted";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("max_speed"), std::string::npos) << error.what();
  }
  EXPECT_THROW(makeDrive("differential", "max_speed_m_s = 1e9"), ConfigError);
}

/// Odometry over @p steps equal steps that together are @p way and @p turn.
void measureMany(double way, double turn, int steps, Statistics& ways, Statistics& turns) {
  const auto drive = makeDrive("differential", R"(odometry_distance_sigma_m = 0.02
    odometry_heading_sigma_deg = 1.0
    odometry_turn_sigma_deg = 4.0)");
  Random noise(1);
  for (int run = 0; run < 2000; ++run) {
    double sum = 0.0;
    double angle = 0.0;
    for (int i = 0; i < steps; ++i) {
      const Pose2 seen = drive->measure({way / steps, 0.0, turn / steps}, &noise);
      sum += seen.x * std::cos(seen.theta / 2.0) + seen.y * std::sin(seen.theta / 2.0);
      angle += seen.theta;
    }
    ways.add(sum);
    turns.add(angle);
  }
}

TEST(DifferentialDrive, DriftsAsMuchInManyStepsAsInFew) {
  for (const int steps : {1, 50}) {
    Statistics ways;
    Statistics turns;
    measureMany(4.0, 0.0, steps, ways, turns);
    EXPECT_NEAR(ways.mean(), 4.0, 0.004);                       // 4 sigma / sqrt(2000)
    EXPECT_NEAR(ways.sigma(), 0.04, 0.003);                     // 0.02 sqrt(4)
    EXPECT_NEAR(turns.sigma(), 2.0 * kDegree, 0.15 * kDegree);  // 1 sqrt(4)
  }
  Statistics ways;
  Statistics turns;
  measureMany(0.0, 2.0 * std::numbers::pi, 50, ways, turns);
  EXPECT_NEAR(turns.sigma(), 4.0 * kDegree, 0.3 * kDegree);
  EXPECT_EQ(ways.sigma(), 0.0);
}

TEST(DifferentialDrive, ScalesAreSystematic) {
  const auto drive = makeDrive("differential", R"(odometry_distance_sigma_m = 0
    odometry_heading_sigma_deg = 0
    odometry_turn_sigma_deg = 0
    odometry_distance_scale = 1.1
    odometry_turn_scale = 0.9)");
  Random noise(1);
  EXPECT_NEAR(drive->measure({-1.0, 0.0, 0.0}, &noise).x, -1.1, 1e-12);
  EXPECT_NEAR(drive->measure({0.0, 0.0, 1.0}, &noise).theta, 0.9, 1e-12);
  const Pose2 exact = drive->measure({0.3, 0.1, 0.2}, nullptr);
  EXPECT_EQ(exact.x, 0.3);
  EXPECT_EQ(exact.y, 0.1);
}

}  // namespace
}  // namespace ortung
