#include <gtest/gtest.h>

#include <cmath>

#include "ortung/base/Random.hpp"
#include "ortung/motion/OdometryMotion.hpp"
#include "ortung/study/MotionLearner.hpp"

namespace ortung {
namespace {

/// A drive with changing velocities whose truth is @p delay behind odometry.
MotionLog drive(double delay, double seconds, std::uint64_t seed) {
  Random random(seed);
  MotionLog log;
  Pose2 pose;
  double v = 0.0;
  double w = 0.0;
  for (double t = 0.0; t < seconds; t += 0.05) {
    log.odometry.add(fromSeconds(t), pose, v, w);
    log.truth.emplace_back(fromSeconds(t + delay), pose);
    if (random.uniform() < 0.1) {
      v = random.uniform(0.0, 0.5);
      w = random.uniform(-1.0, 1.0);
    }
    const double turn = w * 0.05 + 0.005 * random.gaussian();
    pose = pose * Pose2{v * 0.05, 0.0, turn};
  }
  return log;
}

std::unique_ptr<MotionModel> odometryMotion() { return std::make_unique<OdometryMotion>(); }

TEST(MotionLearner, FindsTheDelayOfOdometry) {
  for (const double delay : {0.0, 0.2, -0.1, 0.5}) {
    std::vector<MotionLog> logs;
    logs.push_back(drive(delay, 200.0, 1));
    std::unique_ptr<MotionModel> model;
    const LearnedMotion learned = learnMotion(logs, {}, odometryMotion, model);
    EXPECT_NEAR(learned.delay, delay, 0.021);
    ASSERT_TRUE(model);
    EXPECT_GE(learned.logLikelihood, learned.undelayed);
    EXPECT_GT(learned.pairs, 300U);
  }
}

TEST(MotionLearner, TriesEveryDelayFromTheEarliestToTheLatest) {
  std::vector<MotionLog> logs;
  logs.push_back(drive(0.2, 200.0, 6));
  MotionLearning options;
  // Steps of 0.02 s; the right one is the only one, the first or the last.
  for (const auto& [earliest, latest] : {std::pair{0.2, 0.2}, {0.2, 0.3}, {0.1, 0.2}}) {
    options.earliestDelay = earliest;
    options.latestDelay = latest;
    std::unique_ptr<MotionModel> model;
    EXPECT_NEAR(learnMotion(logs, options, odometryMotion, model).delay, 0.2, 1e-9);
    EXPECT_TRUE(model);
  }
}

TEST(MotionLearner, PairsAreChangesOfPoseOverTheSameTime) {
  const MotionLog log = drive(0.2, 20.0, 2);
  const auto drives = motionPairs(log, {}, 0.2);
  ASSERT_EQ(drives.size(), 1U);
  for (const MotionPair& pair : drives[0]) {
    EXPECT_GE(pair.end - pair.begin, 500000);
    EXPECT_NEAR(pair.odometry.x, pair.truth.x, 1e-6);
    EXPECT_NEAR(pair.odometry.y, pair.truth.y, 1e-6);
    EXPECT_NEAR(wrapAngle(pair.odometry.theta - pair.truth.theta), 0.0, 1e-6);
  }
}

TEST(MotionLearner, GapsOfTruthEndADrive) {
  MotionLog log = drive(0.0, 60.0, 3);
  std::erase_if(log.truth, [](const auto& t) { return t.first > 20000000 && t.first < 30000000; });
  const auto drives = motionPairs(log, {}, 0.0);
  ASSERT_EQ(drives.size(), 2U);
  for (const auto& one : drives) {
    for (const MotionPair& pair : one) EXPECT_LT(pair.end - pair.begin, 1000000);
  }
}

TEST(MotionLearner, SaysWhenThereIsTooLittle) {
  std::vector<MotionLog> logs;
  logs.push_back(drive(0.0, 5.0, 4));
  std::unique_ptr<MotionModel> model;
  EXPECT_THROW(learnMotion(logs, {}, odometryMotion, model), std::runtime_error);
  EXPECT_THROW(learnMotion({}, {}, odometryMotion, model), std::runtime_error);
  EXPECT_TRUE(motionPairs(MotionLog(), {}, 0.0).empty());
}

TEST(MotionLearner, StopsWhenAsked) {
  std::vector<MotionLog> logs;
  logs.push_back(drive(0.0, 60.0, 5));
  std::unique_ptr<MotionModel> model;
  learnMotion(logs, {}, odometryMotion, model, [](double) { return false; });
  EXPECT_FALSE(model);
}

// What some delays give is no result: the best one may be among the others.
TEST(MotionLearner, GivesNoModelWhereverItIsStopped) {
  std::vector<MotionLog> logs;
  logs.push_back(drive(0.0, 60.0, 5));
  MotionLearning options;
  options.earliestDelay = 0.0;
  options.latestDelay = 0.08;  // five delays
  for (int most = 0; most <= 5; ++most) {
    int asked = 0;
    std::vector<double> shares;
    std::unique_ptr<MotionModel> model = odometryMotion();  // of something else, before
    learnMotion(logs, options, odometryMotion, model, [&](double share) {
      shares.push_back(share);
      return asked++ < most;
    });
    EXPECT_EQ(model != nullptr, most == 5) << "after " << most << " delays";
    for (std::size_t i = 0; i < shares.size(); ++i)
      EXPECT_NEAR(shares[i], static_cast<double>(i) / 5.0, 1e-9);
  }
}

}  // namespace
}  // namespace ortung
