#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "MotionRig.hpp"
#include "ortung/formats/Words.hpp"

namespace ortung {
namespace {

/// Wheels at 60, 180 and 300 degrees, 0.2 m from the middle: by hand from
/// w_i = -sin(a_i) x + cos(a_i) y + 0.2 theta.
std::array<double, 3> wheelsOf(const Twist& v) {
  const double s = std::sqrt(3.0) / 2.0;
  return {-s * v.x + 0.5 * v.y + 0.2 * v.theta, -v.y + 0.2 * v.theta,
          s * v.x + 0.5 * v.y + 0.2 * v.theta};
}

void expectNear(const Twist& found, const Twist& expected, double tolerance) {
  EXPECT_NEAR(found.x, expected.x, tolerance);
  EXPECT_NEAR(found.y, expected.y, tolerance);
  EXPECT_NEAR(found.theta, expected.theta, tolerance);
}

constexpr const char* kAgile = "wheel_acceleration_m_s2 = 100\nmax_wheel_speed_m_s = 3";

TEST(OmniDrive, GoesWhereItsWheelsSay) {
  for (const Twist& wanted : {Twist{1.0, 0.0, 0.0}, Twist{0.0, -1.0, 0.0}, Twist{0.3, 0.4, 2.0}}) {
    const auto drive = makeDrive("omni", kAgile);
    ASSERT_EQ(drive->commandSize(), 3u);
    drive->setCommand(wheelsOf(wanted));
    drive->relocate(0.5, nullptr);
    expectNear(drive->velocity(), wanted, 1e-12);
    drive->measure({}, nullptr);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(words::toSignedMetres(drive->motionData()[i]), wheelsOf(wanted)[i], 0.0006);
  }
}

TEST(OmniDrive, MovesOnAnArcWhileItTurns) {
  const auto drive = makeDrive("omni", kAgile);
  const Twist wanted{0.3, 0.4, 2.0};
  drive->setCommand(wheelsOf(wanted));
  drive->relocate(0.5, nullptr);
  Pose2 fine;  // Euler's method in a million steps
  const int steps = 1'000'000;
  for (int i = 0; i < steps; ++i) {
    const double dt = 0.7 / steps;
    fine.x += (wanted.x * std::cos(fine.theta) - wanted.y * std::sin(fine.theta)) * dt;
    fine.y += (wanted.x * std::sin(fine.theta) + wanted.y * std::cos(fine.theta)) * dt;
    fine.theta += wanted.theta * dt;
  }
  const Pose2 change = drive->relocate(0.7, nullptr);
  EXPECT_NEAR(change.x, fine.x, 1e-5);
  EXPECT_NEAR(change.y, fine.y, 1e-5);
  EXPECT_NEAR(change.theta, fine.theta, 1e-5);
}

TEST(OmniDrive, LimitsKeepTheDirectionOfVelocitiesAndOfTheirChanges) {
  const auto drive = makeDrive("omni", "wheel_acceleration_m_s2 = 2\nmax_wheel_speed_m_s = 1");
  drive->setCommand(wheelsOf({6.0, 8.0, 0.0}));  // far too fast
  Twist last;
  for (int i = 0; i < 200; ++i) {
    drive->relocate(0.01, nullptr);
    const Twist now = drive->velocity();
    EXPECT_NEAR(now.y * 6.0, now.x * 8.0, 1e-9);
    EXPECT_NEAR(now.theta, 0.0, 1e-9);
    const auto change = wheelsOf({now.x - last.x, now.y - last.y, now.theta - last.theta});
    for (const double wheel : change) EXPECT_LE(std::abs(wheel), 0.02 + 1e-9);
    last = now;
  }
  double fastest = 0.0;
  for (const double wheel : wheelsOf(last)) fastest = std::max(fastest, std::abs(wheel));
  EXPECT_NEAR(fastest, 1.0, 1e-9);
}

TEST(OmniDrive, TakesTheStandardCommands) {
  const auto drive = makeDrive("omni", kAgile);
  drive->setTranslationalVelocity(0.5);
  drive->setRotationalVelocity(-1.0);
  drive->relocate(0.5, nullptr);
  expectNear(drive->velocity(), {0.5, 0.0, -1.0}, 1e-12);
}

TEST(OmniDrive, RefusesWheelsThatCannotHoldIt) {
  EXPECT_THROW(makeDrive("omni", "wheel_angles_deg = [0, 0, 120]"), ConfigError);
  EXPECT_THROW(makeDrive("omni", "wheel_angles_deg = [0, 120]"), ConfigError);
  EXPECT_THROW(makeDrive("omni", "axle_m = 1"), ConfigError);
}

/// Samples moved by one change of pose.
struct Moved {
  Moved(const MotionModel& model, const Pose2& start, const Pose2& change, std::size_t n)
      : x(n, static_cast<float>(start.x)),
        y(n, static_cast<float>(start.y)),
        theta(n, static_cast<float>(start.theta)) {
    model.sampleMotion({x, y, theta}, change, 3, 4, 0);
  }
  std::vector<float> x, y, theta;
};

TEST(OmniMotion, SpreadsTheSameInEveryDirection) {
  const auto model = makeMotion("omni", R"(way_per_m = 0.1
    way_per_turn = 0
    turn_per_m = 0.05
    turn_per_turn = 0
    floor_m = 0
    floor_deg = 0)");
  for (const Pose2& change : {Pose2{1.0, 0.0, 0.0}, Pose2{0.0, 1.0, 0.0}, Pose2{-0.6, 0.8, 0.0}}) {
    const Moved moved(*model, {2.0, 1.0, std::numbers::pi / 2.0}, change, 20000);
    Statistics x, y, theta;
    for (std::size_t i = 0; i < moved.x.size(); ++i) {
      x.add(static_cast<double>(moved.x[i]));
      y.add(static_cast<double>(moved.y[i]));
      theta.add(static_cast<double>(moved.theta[i]));
    }
    EXPECT_NEAR(x.mean(), 2.0 - change.y, 0.003);  // 4 sigma / sqrt(20000)
    EXPECT_NEAR(y.mean(), 1.0 + change.x, 0.003);
    EXPECT_NEAR(x.sigma(), 0.1, 0.002);
    EXPECT_NEAR(y.sigma(), 0.1, 0.002);
    EXPECT_NEAR(theta.sigma(), 0.05, 0.001);
  }
}

/// Of every fourth sample the noise is four times as large: 3/4 + 16/4 of the variance.
TEST(OmniMotion, SlipsAsOftenAsItsFileSays) {
  const auto model = makeMotion("omni", R"(way_per_m = 0.1
    way_per_turn = 0
    turn_per_m = 0
    turn_per_turn = 0
    floor_m = 0
    floor_deg = 0
    slip_share = 0.25)");
  const Moved moved(*model, {}, {1.0, 0.0, 0.0}, 20000);
  Statistics x, y;
  for (std::size_t i = 0; i < moved.x.size(); ++i) {
    x.add(static_cast<double>(moved.x[i]));
    y.add(static_cast<double>(moved.y[i]));
  }
  EXPECT_NEAR(x.sigma(), 0.1 * std::sqrt(4.75), 0.01);
  EXPECT_NEAR(y.sigma(), 0.1 * std::sqrt(4.75), 0.01);
}

TEST(OmniMotion, DependsOnTheSampleAloneNotOnItsBlock) {
  const auto model = makeMotion("omni", "slip_share = 0.1");
  const Moved whole(*model, {}, {0.1, 0.2, 0.3}, 600);
  std::vector<float> x(100, 0.0f), y(100, 0.0f), theta(100, 0.0f);
  model->sampleMotion({x, y, theta}, {0.1, 0.2, 0.3}, 3, 4, 500);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(x[i], whole.x[500 + i]);
    EXPECT_EQ(theta[i], whole.theta[500 + i]);
  }
}

TEST(DifferentialMotion, IsFoundByTheNameOfItsDrive) {
  const auto model = makeMotion("differential", "plugin = \"differential\"\nway_per_m = 0.2");
  const Moved moved(*model, {}, {1.0, 0.0, 0.0}, 20000);
  Statistics x;
  for (const float one : moved.x) x.add(static_cast<double>(one));
  EXPECT_NEAR(x.sigma(), 0.2, 0.01);
}

}  // namespace
}  // namespace ortung
