#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "NeuralRig.hpp"

/// Limits and noise of the drives, by hand.
namespace ortung {
namespace {

constexpr const char* kNoNoise =
    "\nodometry_distance_sigma_m = 0\nodometry_heading_sigma_deg = 0\nodometry_turn_sigma_deg = "
    "0\n";
constexpr const char* kAgile =
    "acceleration_m_s2 = 100\nturn_acceleration_deg_s2 = 36000\naxle_m = 0.4\n";

TEST(DriveSettings, NoWheelOfADifferentialDriveTurnsFasterThanItCan) {
  const auto drive = makeDrive("differential", std::string(kAgile) +
                                                   "max_speed_m_s = 2\nmax_turn_deg_s = 720\n"
                                                   "max_wheel_speed_m_s = 0.6");
  drive->setTranslationalVelocity(1.0);
  drive->setRotationalVelocity(2.5);  // wheels of 0.5 and 1.5 m/s
  for (int i = 0; i < 100; ++i) drive->relocate(0.01, nullptr);
  EXPECT_NEAR(drive->velocity().x, 0.4, 1e-9);  // both 0.4 times as fast, on the same curve
  EXPECT_NEAR(drive->velocity().theta, 1.0, 1e-9);
}

TEST(DriveSettings, EncodersOfADifferentialDriveErrAtRandom) {
  const auto drive =
      makeDrive("differential", std::string("encoder_sigma_m = 0.05\naxle_m = 0.4") + kNoNoise);
  Random noise(1);
  Statistics ways;
  Statistics turns;
  for (int i = 0; i < 4000; ++i) {
    const Pose2 seen = drive->measure({1.0, 0.0, 0.0}, &noise);
    ways.add(seen.x * std::cos(seen.theta / 2.0) + seen.y * std::sin(seen.theta / 2.0));
    turns.add(seen.theta);
  }
  // Each wheel's way errs by 0.05 m after 1 m: the mean of both, and their difference by the axle.
  EXPECT_NEAR(ways.sigma(), 0.05 / std::sqrt(2.0), 0.0017);  // 4 sigma of 4000 draws: 4.5 %
  EXPECT_NEAR(turns.sigma(), 0.05 * std::sqrt(2.0) / 0.4, 0.008);
}

/// On a left turn on the spot both wheels lose the same share: it turns less, and still left.
TEST(DriveSettings, SlipMakesATurnSmaller) {
  const auto drive =
      makeDrive("differential", std::string(kAgile) + "slip_share = 0.25\nmax_turn_deg_s = 720");
  drive->setRotationalVelocity(1.0);
  drive->relocate(0.1, nullptr);
  EXPECT_NEAR(drive->relocate(0.1, nullptr).theta, 0.075, 1e-9);
  // On a curve the outer wheel, which goes farther, loses more: it gets straighter by the same
  // share.
  drive->setTranslationalVelocity(0.4);
  drive->relocate(0.1, nullptr);
  const Pose2 change = drive->relocate(0.1, nullptr);
  EXPECT_NEAR(change.theta, 0.075, 1e-9);
  EXPECT_NEAR(std::hypot(change.x, change.y), 0.75 * 0.04, 1e-4);
}

TEST(DriveSettings, WheelsSlipAtRandomOnlyWhereNoiseIsWanted) {
  const auto drive = makeDrive("differential", std::string(kAgile) + "slip_sigma_m = 0.05");
  drive->setTranslationalVelocity(0.5);
  drive->relocate(0.1, nullptr);
  for (int i = 0; i < 10; ++i) {
    const Pose2 change = drive->relocate(0.1, nullptr);
    EXPECT_NEAR(change.x, 0.05, 1e-12);
    EXPECT_EQ(change.y, 0.0);
    EXPECT_EQ(change.theta, 0.0);
  }
  Random noise(1);
  Statistics turns;
  for (int i = 0; i < 4000; ++i) turns.add(drive->relocate(0.1, &noise).theta);
  // Each wheel's way errs by 0.05 sqrt(0.05) m; 4 sigma of 4000 draws: 4.5 %.
  const double sigma = 0.05 * std::sqrt(0.05) * std::sqrt(2.0) / 0.4;
  EXPECT_NEAR(turns.sigma(), sigma, 0.045 * sigma);
}

TEST(DriveSettings, OdometryOfAnOmniDriveHasTheSignsOfItsMotion) {
  const auto drive = makeDrive("omni", std::string("odometry_distance_scale = 1.1\n"
                                                   "odometry_turn_scale = 0.9") +
                                           kNoNoise);
  Random noise(1);
  const Pose2 seen = drive->measure({0.3, -0.2, 0.1}, &noise);
  EXPECT_NEAR(seen.x, 0.33, 1e-12);
  EXPECT_NEAR(seen.y, -0.22, 1e-12);
  EXPECT_NEAR(seen.theta, 0.09, 1e-12);
}

TEST(DriveSettings, OdometryOfAnOmniDriveErrsAlikeInAllDirections) {
  const auto drive = makeDrive("omni",
                               "odometry_distance_sigma_m = 0.05\n"
                               "odometry_heading_sigma_deg = 2\nodometry_turn_sigma_deg = 0");
  Random noise(1);
  Statistics x, y, theta;
  for (int i = 0; i < 4000; ++i) {
    const Pose2 seen = drive->measure({0.0, 4.0, 0.0}, &noise);
    x.add(seen.x);
    y.add(seen.y);
    theta.add(seen.theta);
  }
  EXPECT_NEAR(y.mean(), 4.0, 0.007);
  EXPECT_NEAR(x.sigma(), 0.1, 0.005);  // 0.05 sqrt(4)
  EXPECT_NEAR(y.sigma(), 0.1, 0.005);
  EXPECT_NEAR(theta.sigma(), 4.0 * std::numbers::pi / 180.0, 0.0035);
}

TEST(DriveSettings, AnOmniDriveIsNoFasterThanItsFileSays) {
  const std::string agile = "wheel_acceleration_m_s2 = 100\nmax_wheel_speed_m_s = 5\n";
  const auto slow = makeDrive("omni", agile + "max_speed_m_s = 0.5");
  EXPECT_EQ(slow->limits().speed, 0.5);
  slow->setTranslationalVelocity(2.0);
  slow->relocate(0.5, nullptr);
  EXPECT_NEAR(slow->velocity().x, 0.5, 1e-9);
  const auto steady = makeDrive("omni", agile + "max_turn_deg_s = 45");
  EXPECT_NEAR(steady->limits().turn, std::numbers::pi / 4.0, 1e-12);
  steady->setTranslationalVelocity(1.0);
  steady->setRotationalVelocity(std::numbers::pi / 2.0);
  steady->relocate(0.5, nullptr);
  EXPECT_NEAR(steady->velocity().theta, std::numbers::pi / 4.0, 1e-9);
  EXPECT_NEAR(steady->velocity().x, 0.5, 1e-9);  // on the same curve
}

/// Its network keeps whatever velocity the robot has.
class Coasting : public NeuralRig {
 protected:
  std::unique_ptr<Drive> drive(const std::string& more) {
    return makeDrive("neural", settings(linearNetwork(std::vector<double>(20, 0.0),
                                                      std::vector<double>(5, 0.0), false)) +
                                   more);
  }
};

TEST_F(Coasting, ANetworkHearsOfCollisions) {
  // Something pushes it: slowly, faster than it can, and around.
  for (const auto& [pushed, kept] : {std::pair{Twist{0.8, 0.0, 0.0}, Twist{0.8, 0.0, 0.0}},
                                     {Twist{9.0, 0.0, 0.0}, Twist{2.0, 0.0, 0.0}},
                                     {Twist{0.0, 0.0, 0.5}, Twist{0.0, 0.0, 0.5}},
                                     {Twist{0.0, 0.0, -9.0}, Twist{0.0, 0.0, -3.0}}}) {
    const auto base = drive("");
    base->setVelocity(pushed);
    for (int i = 0; i < 30; ++i) base->relocate(0.01, nullptr);
    EXPECT_NEAR(base->velocity().x, kept.x, 1e-9);
    EXPECT_NEAR(base->velocity().theta, kept.theta, 1e-9);
  }
}

// What it is pushed to counts at once, not from the network's next step on; no faster than it can.
TEST_F(Coasting, ACollisionWithinAStepChangesTheRestOfIt) {
  const auto base = drive("");
  base->setVelocity({1.0, 0.0, 0.0});
  base->relocate(0.02, nullptr);
  for (const auto& [pushed, kept] : {std::pair{Twist{0.4, -0.3, 0.0}, Twist{0.4, -0.3, 0.0}},
                                     {Twist{9.0, -9.0, 0.0}, Twist{2.0, -2.0, 0.0}},
                                     {Twist{-9.0, 9.0, 9.0}, Twist{-2.0, 2.0, 3.0}}}) {
    base->setVelocity(pushed);
    const Twist velocity = base->velocity();
    EXPECT_EQ(velocity.x, kept.x);
    EXPECT_EQ(velocity.y, kept.y);
    EXPECT_EQ(velocity.theta, kept.theta);
    const Pose2 change = base->relocate(0.02, nullptr);
    EXPECT_NEAR(change.theta, 0.02 * kept.theta, 1e-12);
    if (kept.theta != 0.0) continue;
    EXPECT_NEAR(change.x, 0.02 * kept.x, 1e-12);
    EXPECT_NEAR(change.y, 0.02 * kept.y, 1e-12);
  }
}

TEST_F(Coasting, OdometryOfANeuralDriveHasTheSignsOfItsMotion) {
  const auto base = drive(std::string("odometry_distance_scale = 1.1") + kNoNoise);
  Random noise(1);
  EXPECT_NEAR(base->measure({0.3, 0.0, 0.0}, &noise).x, 0.33, 1e-12);
  EXPECT_NEAR(base->measure({-0.3, 0.0, 0.0}, &noise).x, -0.33, 1e-12);
  const Pose2 curve = base->measure({0.2 * std::cos(0.2), 0.2 * std::sin(0.2), 0.4}, &noise);
  EXPECT_NEAR(curve.x, 0.22 * std::cos(0.2), 1e-12);
  EXPECT_NEAR(curve.y, 0.22 * std::sin(0.2), 1e-12);
}

}  // namespace
}  // namespace ortung
