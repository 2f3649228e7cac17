#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "SensorRig.hpp"
#include "ortung/sim/Drive.hpp"

namespace ortung {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;  // [rad]

TEST(DifferentialDrive, AcceleratesAsPhysicsSays) {
  DriveConfig config;
  config.acceleration = 0.5;
  config.maxSpeed = 1.0;
  DifferentialDrive drive(config);
  drive.setTranslationalVelocity(5.0);  // more than it can
  Pose2 pose;
  for (int i = 0; i < 100; ++i) pose = pose * drive.relocate(0.01);
  EXPECT_NEAR(pose.x, 0.25, 1e-9);  // a t^2 / 2
  EXPECT_NEAR(drive.translationalVelocity(), 0.5, 1e-9);
  for (int i = 0; i < 200; ++i) drive.relocate(0.01);
  EXPECT_NEAR(drive.translationalVelocity(), 1.0, 1e-9);
}

TEST(DifferentialDrive, DrivesAnExactCircle) {
  DriveConfig config;
  config.acceleration = 100.0;
  config.turnAcceleration = 600.0;
  DifferentialDrive drive(config);
  drive.setTranslationalVelocity(0.5);
  drive.setRotationalVelocity(1.0);
  drive.relocate(0.01);  // at speed from here on
  Pose2 pose;
  for (int i = 0; i < 100; ++i) pose = pose * drive.relocate(0.01);
  EXPECT_NEAR(pose.x, 0.5 * std::sin(1.0), 1e-9);
  EXPECT_NEAR(pose.y, 0.5 * (1.0 - std::cos(1.0)), 1e-9);
  EXPECT_NEAR(pose.theta, 1.0, 1e-9);
}

TEST(DriveConfig, ReadsAndRefusesByName) {
  const DriveConfig config =
      DriveConfig::read(parseToml("max_speed_m_s = 2\nmax_turn_deg_s = 90", "robot.toml"));
  EXPECT_EQ(config.maxSpeed, 2.0);
  EXPECT_NEAR(config.maxTurn, 90 * kDegree, 1e-12);
  try {
    DriveConfig::read(parseToml("max_speed = 2", "robot.toml"));
    FAIL() << "an unknown key was accepted";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("max_speed"), std::string::npos) << error.what();
  }
  EXPECT_THROW(DriveConfig::read(parseToml("max_speed_m_s = 1e9", "robot.toml")), ConfigError);
}

/// Odometry over @p steps equal steps that together are @p way and @p turn.
void measureMany(const DriveConfig& config, double way, double turn, int steps, Statistics& ways,
                 Statistics& turns) {
  Random noise(1);
  for (int run = 0; run < 2000; ++run) {
    double sum = 0.0;
    double angle = 0.0;
    for (int i = 0; i < steps; ++i) {
      const Pose2 seen = config.measure({way / steps, 0.0, turn / steps}, &noise);
      sum += seen.x * std::cos(seen.theta / 2.0) + seen.y * std::sin(seen.theta / 2.0);
      angle += seen.theta;
    }
    ways.add(sum);
    turns.add(angle);
  }
}

TEST(DriveConfig, DriftsAsMuchInManyStepsAsInFew) {
  DriveConfig config;
  config.distanceSigma = 0.02;
  config.headingSigma = 1.0 * kDegree;
  config.turnSigma = 4.0 * kDegree;
  for (const int steps : {1, 50}) {
    Statistics ways;
    Statistics turns;
    measureMany(config, 4.0, 0.0, steps, ways, turns);
    EXPECT_NEAR(ways.mean(), 4.0, 0.004);                       // 4 sigma / sqrt(2000)
    EXPECT_NEAR(ways.sigma(), 0.04, 0.003);                     // 0.02 sqrt(4)
    EXPECT_NEAR(turns.sigma(), 2.0 * kDegree, 0.15 * kDegree);  // 1 sqrt(4)
  }
  Statistics ways;
  Statistics turns;
  measureMany(config, 0.0, 2.0 * std::numbers::pi, 50, ways, turns);
  EXPECT_NEAR(turns.sigma(), 4.0 * kDegree, 0.3 * kDegree);
  EXPECT_EQ(ways.sigma(), 0.0);
}

TEST(DriveConfig, ScalesAreSystematic) {
  DriveConfig config;
  config.distanceSigma = config.headingSigma = config.turnSigma = 0.0;
  config.distanceScale = 1.1;
  config.turnScale = 0.9;
  Random noise(1);
  const Pose2 way = config.measure({-1.0, 0.0, 0.0}, &noise);
  EXPECT_NEAR(way.x, -1.1, 1e-12);
  EXPECT_NEAR(config.measure({0.0, 0.0, 1.0}, &noise).theta, 0.9, 1e-12);
  const Pose2 exact = config.measure({0.3, 0.1, 0.2}, nullptr);
  EXPECT_EQ(exact.x, 0.3);
  EXPECT_EQ(exact.y, 0.1);
}

}  // namespace
}  // namespace ortung
