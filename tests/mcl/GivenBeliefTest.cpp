// Beliefs that come from elsewhere: a pose that somebody knows, none at all, one of an earlier run.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "FakeRun.hpp"
#include "Files.hpp"
#include "MovingRobot.hpp"
#include "ortung/mcl/Mcl.hpp"

namespace ortung {
namespace {

using test::FakeRun;
using test::kPi;
using test::messageOf;
using test::MovingRobot;

/// A filter that has followed the run's robot from a known start.
auto trackingAfter(int readings, FakeRun& run) {
  auto mcl = run.mcl(run.config());
  const Pose2 start = FakeRun::onCircle(1, 0.5, 0.3);
  mcl->startAt(start, 0.1, 0.05);
  run.begin(start, 3);
  for (int i = 0; i < readings; ++i) {
    run.drive();
    mcl->update(run.container);
  }
  return mcl;
}

constexpr PoseCovariance kCovariance = {0.25,  0.06,  -0.02,  //
                                        0.06,  0.04,  0.004,  //
                                        -0.02, 0.004, 0.01};

/// Mean and covariance of samples by the textbook's sums.
struct Moments {
  explicit Moments(const SampleSet& s) {
    const auto n = static_cast<double>(s.size());
    const std::array<const std::vector<float>*, 3> values = {&s.x, &s.y, &s.theta};
    for (std::size_t k = 0; k < 3; ++k)
      for (const float v : *values[k]) mean[k] += v / n;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b)
        for (std::size_t i = 0; i < s.size(); ++i)
          covariance[3 * a + b] += ((*values[a])[i] - mean[a]) * ((*values[b])[i] - mean[b]) / n;
  }
  std::array<double, 3> mean{};
  PoseCovariance covariance{};
};

TEST(SetPose, DrawsSamplesWithThatMeanAndCovariance) {
  const MovingRobot robot;
  const auto mcl = robot.mcl({0, 0, 0, 0, 0, 0}, 40000);
  mcl->setPose({1, -2, 3}, kCovariance);
  const Moments found(mcl->samples());
  // Sigma of the mean and, for a normal distribution, of entry (a, b) of the covariance.
  for (std::size_t a = 0; a < 3; ++a) {
    const double variance = kCovariance[4 * a];
    EXPECT_NEAR(found.mean[a], (std::array{1.0, -2.0, 3.0}[a]), 4 * std::sqrt(variance / 40000));
    for (std::size_t b = 0; b < 3; ++b) {
      const double c = kCovariance[3 * a + b];
      const double sigma = std::sqrt((variance * kCovariance[4 * b] + c * c) / 40000);
      EXPECT_NEAR(found.covariance[3 * a + b], c, 4 * sigma) << a << " " << b;
    }
  }
}

TEST(SetPose, TakesSingularCovariances) {
  const MovingRobot robot;
  const auto mcl = robot.mcl();
  mcl->setPose({1, 2, 3}, {});
  EXPECT_EQ(mcl->samples().x, std::vector<float>(600, 1.0F));
  EXPECT_EQ(mcl->samples().theta, std::vector<float>(600, 3.0F));
  // Known to be on the line y = 2 x, with its heading.
  mcl->setPose({0, 0, 0}, {1, 2, 0, 2, 4, 0, 0, 0, 0});
  for (std::size_t i = 0; i < 600; ++i)
    EXPECT_NEAR(mcl->samples().y[i], 2 * mcl->samples().x[i], 1e-5);
  EXPECT_NEAR(Moments(mcl->samples()).covariance[0], 1.0, 0.25);
  // As the program prints it: six digits of a matrix that is singular.
  mcl->setPose({0, 0, 0}, {0.0123457, 0.0370370, 0, 0.0370370, 0.111111, 0, 0, 0, 0.01});
}

TEST(SetPose, SaysWhatIsNoCovarianceAndKeepsItsBelief) {
  const MovingRobot robot;
  const auto mcl = robot.mcl();
  mcl->startAt({4, 5, 0}, 0.1, 0.1);
  const std::vector<float> before = mcl->samples().x;
  const auto error = [&](const PoseCovariance& c) {
    return messageOf<std::invalid_argument>([&] { mcl->setPose({1, 2, 3}, c); });
  };
  const double nan = std::nan("");
  EXPECT_EQ(error({1, 0, nan, 0, 1, 0, nan, 0, 1}),
            "covariance (x, theta) is nan, expected a finite number");
  EXPECT_EQ(error({1, 0, 0, 0, HUGE_VAL, 0, 0, 0, 1}),
            "covariance (y, y) is inf, expected a finite number");
  EXPECT_EQ(error({1, 0, 0, 0, 1, 0, 0, 0, -0.5}),
            "covariance (theta, theta) is -0.5, expected at least 0");
  EXPECT_EQ(error({1, 0.1, 0, 0.2, 1, 0, 0, 0, 1}),
            "covariance (x, y) is 0.1, but (y, x) is 0.2, expected a symmetric matrix");
  EXPECT_EQ(error({0, 0.1, 0, 0.1, 1, 0, 0, 0, 1}),
            "covariance (x, y) is 0.1, expected 0: one of the two is known without error");
  EXPECT_EQ(error({1, 2, 0, 2, 1, 0, 0, 0, 1}),
            "covariance is not positive semi-definite: its correlations have the eigenvalue -1, "
            "expected at least 0");
  // Each two of them may be so, but not all three: the determinant is -0.5.
  EXPECT_NE(error({1, 0.5, 0.5, 0.5, 1, -1, 0.5, -1, 1}).find("positive semi-definite"),
            std::string::npos);
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { mcl->setPose({1, nan, 3}, kCovariance); }),
            "pose is (1, nan, 3), expected finite numbers");
  EXPECT_EQ(mcl->samples().x, before);
}

/// A robot that has nothing but odometry: 0.1 m and 0.1 s a step, ahead.
struct BlindRobot {
  BlindRobot() { container.add(std::make_unique<OdometryData>(id)); }
  void drive(Mcl& mcl, int step) {
    const Pose2 place{7.0 + 0.1 * step, 3, 0};
    container.set({at(step), id, OdometryData::encode({place, 1.0, 0.0, {}})});
    EXPECT_FALSE(mcl.update(container)) << "nothing can be weighed";
  }
  static Timestamp at(int step) { return 100'000 * step; }
  const SensorId id{"base", "odometry", "pose"};
  SensorContainer container;
};

// At once, and from where odometry was then, though nothing is weighed.
TEST(SetPose, IsCarriedOnByOdometryBeforeAnythingIsWeighed) {
  BlindRobot robot;
  const auto mcl = MovingRobot().mcl();
  mcl->startGlobal();
  for (int i = 0; i <= 10; ++i) robot.drive(*mcl, i);
  EXPECT_FALSE(mcl->estimate(robot.at(10))) << "it waits for a reading";
  mcl->setPose({5, 5, kPi / 2}, {});
  ASSERT_TRUE(mcl->estimate(robot.at(10)));
  EXPECT_NEAR(mcl->estimate(robot.at(10))->pose.y, 5.0, 1e-3);
  for (int i = 11; i <= 30; ++i) {
    robot.drive(*mcl, i);
    EXPECT_NEAR(mcl->estimate(robot.at(i))->pose.y, 5.0 + 0.1 * (i - 10), 0.002) << i;
  }
  EXPECT_NEAR(mcl->estimate(robot.at(30))->pose.x, 5.0, 0.002);
}

// So does a start before the first reading that weighs.
TEST(StartAt, IsCarriedOnByOdometryBeforeAnythingIsWeighed) {
  BlindRobot robot;
  const auto mcl = MovingRobot().mcl();
  mcl->startAt({1, 0, 0}, 0.0, 0.0);
  for (int i = 0; i <= 20; ++i) {
    robot.drive(*mcl, i);
    EXPECT_NEAR(mcl->estimate(robot.at(i))->pose.x, 1.0 + 0.1 * i, 0.002) << i;
  }
}

TEST(SetPose, IsSharpenedByWhatWasReadJustBefore) {
  FakeRun run;
  const auto mcl = trackingAfter(5, run);
  const Pose2 near = run.truth * Pose2{0.2, -0.2, 0.1};
  mcl->setPose(near, {0.09, 0, 0, 0, 0.09, 0, 0, 0, 0.03});
  ASSERT_TRUE(mcl->update(run.container)) << "the reading of this moment counts again";
  EXPECT_EQ(mcl->estimate().stamp, run.stamp);
  EXPECT_LT(distance(mcl->estimate().pose, run.truth), 0.1);
  EXPECT_FALSE(mcl->update(run.container)) << "once";
}

TEST(Relocalize, NothingBoundsTheErrorUntilAPlaceIsFound) {
  FakeRun run;
  const auto mcl = trackingAfter(5, run);
  ASSERT_LT(mcl->estimate().protection.metres, 0.5);
  EXPECT_LT(distance(mcl->estimate().pose, run.truth), mcl->estimate().protection.metres);
  mcl->relocalize();
  EXPECT_TRUE(std::isinf(mcl->estimate().protection.metres));
  EXPECT_TRUE(std::isinf(mcl->estimate().protection.radians));
}

TEST(Relocalize, FindsACarriedRobotByThePresentReading) {
  FakeRun run;
  const auto mcl = trackingAfter(5, run);
  run.truth = FakeRun::onCircle(-2, -0.5, 2);
  run.drive();
  mcl->update(run.container);
  EXPECT_GT(distance(mcl->estimate().pose, run.truth), 1.0) << "not by itself, so soon";
  mcl->relocalize();
  EXPECT_FALSE(mcl->estimate(run.stamp)) << "it may be anywhere";
  EXPECT_FALSE(mcl->belief());
  EXPECT_EQ(mcl->estimate().status, TrackStatus::kLost);
  EXPECT_EQ(mcl->estimate().reason, TrackReason::kSearching) << "nor is the one before right";
  int updates = 1;
  while (!mcl->update(run.container) && updates < 20) ++updates;
  EXPECT_LT(updates, 20) << "without a new reading";
  EXPECT_EQ(mcl->estimate().stamp, run.stamp);
  EXPECT_NE(mcl->estimate().reason, TrackReason::kSearching);
  EXPECT_LT(distance(mcl->estimate().pose, run.truth), 0.1);
  EXPECT_TRUE(mcl->hasOdometry());
  // Odometry is not begun anew: from here on it leads.
  const Pose2 before = run.truth;
  run.drive();
  mcl->followOdometry(run.container);
  const auto then = mcl->estimate(run.stamp);
  ASSERT_TRUE(then);
  EXPECT_LT(distance(then->pose, run.truth), 0.1);
  EXPECT_GT(distance(before, run.truth), 0.04);
}

TEST(Belief, HasABoundThatFilesCannotExceed) {
  Belief belief;
  belief.samples.resize(5'000'000);
  EXPECT_NO_THROW(belief.check());
  belief.samples.resize(5'000'001);
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { belief.check(); }),
            "the belief has 5000001 samples, expected 1 to 5000000");
}

TEST(Belief, IsThatOfTheNewestOdometry) {
  MovingRobot robot;
  const auto mcl = robot.mcl();
  EXPECT_FALSE(mcl->belief()) << "nothing was started";
  mcl->startAt({1, 2, kPi / 2}, 0.0, 0.0);
  robot.odometry(0.0, {{0, 0, 0}, 0.0, 0.0, {}});
  robot.feature("early", 0.0);
  ASSERT_TRUE(mcl->update(robot.container));
  robot.odometry(1.0, {{0.08, 0, 0.05}, 0.08, 0.0, {}});  // too little to move samples for
  ASSERT_FALSE(mcl->update(robot.container));
  ASSERT_NEAR(mcl->samples().y.front(), 2.0F, 1e-6);
  const auto belief = mcl->belief();
  ASSERT_TRUE(belief);
  EXPECT_EQ(belief->stamp, fromSeconds(1));
  EXPECT_NEAR(belief->samples.x.front(), 1.0, 1e-5);
  EXPECT_NEAR(belief->samples.y.front(), 2.08, 1e-5);
  EXPECT_NEAR(belief->samples.theta.front(), kPi / 2 + 0.05, 1e-4);
}

TEST(Belief, GoesOnInAnotherFilterWhoseOdometryBeginsAnew) {
  FakeRun run;
  const auto first = trackingAfter(10, run);
  const auto belief = first->belief();
  ASSERT_TRUE(belief);
  MclConfig small = run.config();
  small.maxSamples = small.minSamples = 100;
  for (const MclConfig& config : {run.config(), small}) {
    FakeRun again;
    const auto second = again.mcl(config);
    second->restore(*belief);
    EXPECT_EQ(second->samples().size(), std::min(belief->samples.size(), config.maxSamples));
    ASSERT_TRUE(second->estimate(0));
    EXPECT_LT(distance(second->estimate(0)->pose, run.truth), 0.1);
    again.begin(run.truth, 4);
    for (int i = 0; i < 10; ++i) {
      again.drive();
      second->update(again.container);
      EXPECT_LT(distance(second->estimate().pose, again.truth), 0.15) << i;
    }
  }
}

TEST(Belief, ThatCantBeIsRefusedAndTheOldOneStays) {
  const MovingRobot robot;
  const auto mcl = robot.mcl();
  mcl->startAt({4, 5, 0}, 0.1, 0.1);
  const std::vector<float> before = mcl->samples().x;
  const Belief good{0, {{1, 2}, {1, 2}, {0, 9}, {0, -3}}};
  good.check();
  const auto refused = [&](auto change, const std::string& part) {
    Belief bad = good;
    change(bad.samples);
    const std::string error = messageOf<std::invalid_argument>([&] { mcl->restore(bad); });
    EXPECT_NE(error.find(part), std::string::npos) << error;
    EXPECT_EQ(mcl->samples().x, before);
  };
  const float nan = std::nanf("");
  const float infinite = std::numeric_limits<float>::infinity();
  refused([&](SampleSet& s) { s.x[1] = nan; }, "sample 1 of the belief is at (nan, 2, 9)");
  refused([&](SampleSet& s) { s.y[0] = 2e6F; }, "expected numbers within 1e+06 m");
  refused([&](SampleSet& s) { s.theta[0] = -infinite; }, "sample 0 of the belief");
  refused([&](SampleSet& s) { s.logWeight[1] = nan; }, "logarithmic weight nan");
  refused([&](SampleSet& s) { s.logWeight[1] = infinite; }, "logarithmic weight inf");
  refused([&](SampleSet& s) { s.logWeight = {-infinite, -infinite}; }, "have the weight 0");
  refused([&](SampleSet& s) { s.y.pop_back(); }, "has 2 x and 1 of another kind");
  refused([&](SampleSet& s) { s = {}; }, "has 0 samples, expected 1 to 5000000");
  Belief half = good;
  half.samples.logWeight[0] = -infinite;
  mcl->restore(half);
  EXPECT_NEAR(mcl->estimate(0)->pose.x, 2.0, 1e-6) << "a weight of 0 is one";
}

}  // namespace
}  // namespace ortung
