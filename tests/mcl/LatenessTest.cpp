// Readings whose stamps are late: what it takes until that is known, and what becomes of the
// belief.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "ExactMotion.hpp"
#include "FakeRun.hpp"
#include "Lateness.hpp"
#include "Resampling.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

using test::FakeRun;

constexpr double kFloor = -30.0;    ///< ln p of readings that fit nowhere
constexpr double kDoubtful = -5.0;  ///< where they fit badly

struct Velocity {
  double way = 0.0;   ///< [m/s]
  double turn = 0.0;  ///< [rad/s]
};
using Course = std::function<Velocity(double)>;

Velocity straight(double) { return {1.0, 0.0}; }
/// 2 s ahead, 2 s of a turn, as people drive in rooms.
Velocity roundCorners(double t) {
  return std::fmod(t, 4.0) < 2.0 ? Velocity{0.8, 0.0} : Velocity{0.1, 1.0};
}

/// A robot whose belief is where the readings are, four times a second; odometry tells its course
/// ten times as often.
struct Robot {
  explicit Robot(Course c) : course(std::move(c)), told(course) {
    for (int i = 0; i < 50; ++i) {
      recovery.follow(0.9);
      recovery.followBest(0.95);
    }
  }

  /// Drives, and reads at the end unless it is blind.
  void drive(bool reads = true) {
    for (int i = 0; i < 10; ++i) {
      step(truths.back(), course, truths);
      step(odometry.back(), told, odometry);
      motion.follow(now(), {odometry.back(), 0.0, 0.0, {}});
      lateness.hear(now());
    }
    if (reads) read();
  }
  void driveFor(double seconds) {
    for (int i = 0; i < static_cast<int>(4 * seconds); ++i) drive();
  }

  Timestamp now() const { return fromSeconds(kStep * static_cast<double>(truths.size() - 1)); }
  Lateness::Suspicion suspicion() const { return lateness.suspicion(now()); }
  bool isSuspected() const { return suspicion() != Lateness::Suspicion::kNone; }

  void read() {
    const auto steps = static_cast<std::size_t>(std::lround(late / kStep));
    const Pose2 there = truths[truths.size() - 1 - std::min(truths.size() - 1, steps)];
    Evidence reading;
    reading.weigh = [&](const SampleSet& set, std::vector<float>& out) {
      out.resize(set.size());
      for (std::size_t i = 0; i < set.size(); ++i) out[i] = logProbability(set, i, there);
    };
    reading.fit = [&](const SampleSet& set) {
      const std::vector<double> weights = normalized(set.logWeight);
      double sum = 0.0;
      for (std::size_t i = 0; i < set.size(); ++i)
        sum += weights[i] * (1.0 - static_cast<double>(logProbability(set, i, there)) / kFloor);
      return sum;
    };
    ++readings;
    const double evidence = isElsewhere ? kFloor : expected(there);
    PoseEstimate seen;
    seen.pose = there;
    seen.covariance = {kSigma * kSigma, 0, 0, 0, kSigma * kSigma, 0, 0, 0, kTurn * kTurn};
    const auto change =
        lateness.follow({now(), evidence, evidence < kDoubtful, seen, readings}, recovery, reading);
    if (change) {
      ++changes;
      changed = change->samples;
    }
    SampleSet belief;
    belief.resize(200);
    Random random(readings);
    for (std::size_t i = 0; i < belief.size(); ++i) {
      belief.x[i] = static_cast<float>(there.x + kSigma * random.gaussian());
      belief.y[i] = static_cast<float>(there.y + kSigma * random.gaussian());
      belief.theta[i] = static_cast<float>(there.theta + kTurn * random.gaussian());
    }
    lateness.keep(belief, normalized(belief.logWeight), seen, now());
    believed = there;
    odometryThen = *lateness.odometryAt(now());
  }

  static constexpr double kStep = 0.025;  ///< [s]
  static constexpr double kSigma = 0.02;  ///< of the belief [m]
  static constexpr double kTurn = 0.01;   ///< [rad]
  Course course;
  Course told;  ///< by odometry
  double late = 0.0;
  bool isElsewhere = false;  ///< the belief, so that no reading fits it
  std::vector<Pose2> truths{Pose2{}};
  std::vector<Pose2> odometry{Pose2{}};
  MclConfig config;
  test::ExactMotion motion;
  Recovery recovery{config};
  Lateness lateness{config, motion};
  Pose2 believed;  ///< at the last reading
  Pose2 odometryThen;
  std::uint64_t readings = 0;
  int changes = 0;
  std::optional<SampleSet> changed;

 private:
  static void step(Pose2 from, const Course& course, std::vector<Pose2>& poses) {
    const Velocity v = course(kStep * static_cast<double>(poses.size() - 1));
    poses.push_back(from * Pose2{v.way * kStep, 0, v.turn * kStep});
  }
  /// ln p of readings where odometry leads from the last one.
  double expected(const Pose2& there) {
    SampleSet set;
    set.resize(1);
    const Pose2 predicted = believed * (inverse(odometryThen) * *lateness.odometryAt(now()));
    set.x[0] = static_cast<float>(predicted.x);
    set.y[0] = static_cast<float>(predicted.y);
    set.theta[0] = static_cast<float>(predicted.theta);
    return static_cast<double>(logProbability(set, 0, there));
  }
  static float logProbability(const SampleSet& set, std::size_t i, const Pose2& there) {
    const double way = std::hypot(static_cast<double>(set.x[i]) - there.x,
                                  static_cast<double>(set.y[i]) - there.y);
    const double turn = wrapAngle(static_cast<double>(set.theta[i]) - there.theta);
    const double off = (way * way + turn * turn) / 0.01;
    return static_cast<float>(std::max(-0.5 * off, kFloor));
  }
};

TEST(Lateness, IsFoundWhereTheRobotTurns) {
  for (const double late : {0.5, 1.0, 1.6, 2.0, 3.0}) {
    Robot robot(roundCorners);
    robot.driveFor(8);
    EXPECT_EQ(robot.lateness.seconds(), 0.0);
    EXPECT_GT(robot.lateness.probability(0), 0.999);
    EXPECT_FALSE(robot.isSuspected());
    Robot delayed(roundCorners);
    delayed.late = late;
    delayed.driveFor(12);
    EXPECT_NEAR(delayed.lateness.seconds(), late, 0.3);
    delayed.driveFor(30);
    EXPECT_NEAR(delayed.lateness.seconds(), late, 0.3);
    EXPECT_FALSE(delayed.changed) << late << ": the belief stays";
    EXPECT_EQ(delayed.suspicion(), Lateness::Suspicion::kTold) << "its end may go unseen";
  }
}

// Nothing but the start tells it: afterwards the way is straight, and the speed is the same.
TEST(Lateness, IsFoundWhereTheRobotSetsOffOnce) {
  const auto setsOff = [](double t) { return Velocity{t < 5.0 ? 0.0 : 1.5, 0.0}; };
  for (const double late : {0.0, 0.5, 1.0, 2.0, 3.0}) {
    Robot robot(setsOff);
    robot.late = late;
    robot.driveFor(5);
    EXPECT_FALSE(robot.isSuspected()) << "it stands";
    for (int i = 0; i < 40; ++i) {
      robot.drive();
      const Pose2 there = robot.truths[robot.truths.size() - 1];
      const Pose2 told = robot.believed * inverse(robot.odometryThen) * robot.odometry.back();
      if (distance(there, told) > 1.0) {
        EXPECT_TRUE(robot.isSuspected());
      }
    }
    if (late == 0.0 || late >= 2.0) {
      EXPECT_EQ(robot.lateness.seconds(), late);
    }
    EXPECT_EQ(robot.isSuspected(), late > 0.0);
  }
}

TEST(Lateness, CannotBeKnownOnAStraightWay) {
  Robot robot(straight);
  robot.driveFor(5);
  const double before = robot.lateness.probability(8);
  robot.driveFor(60);
  EXPECT_NEAR(robot.lateness.probability(8), before, 1e-4);
  EXPECT_EQ(robot.lateness.seconds(), 0.0);
  EXPECT_EQ(robot.suspicion(), Lateness::Suspicion::kPossible)
      << "the robot may be 2 m ahead, but nothing says so";
  // Estimates are so much wider, along the way alone.
  double squares = 0.0;
  for (std::size_t i = 0; i < Delays::kCount; ++i) {
    const double ahead = Delays::secondsOf(i);  // [m], at 1 m/s
    const double step = i > 0 ? Delays::kStep : 0.0;
    squares += robot.lateness.probability(i) * (ahead * ahead + step * step / 4.0);
  }
  PoseEstimate e;
  e.pose = robot.truths.back();
  const PoseEstimate wide = robot.lateness.widened(e, robot.now());
  EXPECT_EQ(wide.pose.x, e.pose.x) << "as long as none is in force";
  EXPECT_NEAR(wide.covariance[0], squares, 1e-6);
  EXPECT_NEAR(wide.covariance[4], 0.0, 1e-9);
  EXPECT_NEAR(wide.covariance[8], 0.0, 1e-9);
}

// What is not known of the delay is known of the estimate, whatever the direction.
TEST(Lateness, InForceWidensByHalfAStep) {
  Robot robot([](double t) { return t < 20.0 ? roundCorners(t) : Velocity{1.5, 0.0}; });
  robot.late = 2.0;
  robot.driveFor(40);
  ASSERT_NEAR(robot.lateness.seconds(), 2.0, 0.25);
  PoseEstimate e;
  e.pose = {0, 0, robot.truths.back().theta};
  const PoseEstimate wide = robot.lateness.widened(e, robot.now());
  const double along = wide.covariance[0] + wide.covariance[4];
  EXPECT_GE(std::sqrt(along), 0.5 * Delays::kStep * 1.5);
  EXPECT_LE(std::sqrt(along), 2.0 * Delays::kStep * 1.5);
  const double c = std::cos(e.pose.theta);
  const double s = std::sin(e.pose.theta);
  const double across =
      s * s * wide.covariance[0] - 2.0 * s * c * wide.covariance[1] + c * c * wide.covariance[4];
  EXPECT_LT(across, 0.01 * along);
}

// What odometry gets wrong speaks for a delay when it begins, and against it when it is over.
TEST(Lateness, IsNotFoundInOdometryThatLies) {
  const auto isWrong = [](double t) { return std::fmod(t, 13.0) > 9.0; };
  const std::vector<Course> lies = {
      [&](double t) { return isWrong(t) ? Velocity{} : roundCorners(t); },  // wheels stand
      [&](double t) {                                                       // they count backwards
        const Velocity v = roundCorners(t);
        return isWrong(t) ? Velocity{-v.way, v.turn} : v;
      },
      [](double t) {  // all is too long
        const Velocity v = roundCorners(t);
        return Velocity{1.2 * v.way, 1.2 * v.turn};
      }};
  for (std::size_t i = 0; i < lies.size(); ++i) {
    Robot robot(roundCorners);
    robot.told = lies[i];
    robot.driveFor(200);
    EXPECT_EQ(robot.changes, 0) << i;
  }
}

// The place changes with the delay, on a straight way, too, if readings have left a gap.
TEST(Lateness, IsFoundWhereItBegins) {
  for (const bool hasGap : {true, false}) {
    Robot robot(straight);
    robot.driveFor(10);
    for (int i = 0; hasGap && i < 8; ++i) robot.drive(false);
    robot.late = 2.0;
    robot.isElsewhere = true;  // the belief is expected 2 m farther on
    for (int i = 0; i < 3; ++i) robot.drive();
    EXPECT_EQ(robot.changes, 0);
    EXPECT_TRUE(robot.isSuspected()) << "so far nothing has told of it";
    robot.drive();
    EXPECT_EQ(robot.changes, hasGap ? 1 : 0);
    EXPECT_NEAR(robot.lateness.seconds(), hasGap ? 2.0 : 0.0, 0.25);
    if (!robot.changed) continue;
    const Pose2 then = robot.truths[robot.truths.size() - 1 - 80];
    for (const float x : robot.changed->x) EXPECT_NEAR(static_cast<double>(x), then.x, 0.5);
  }
}

TEST(Lateness, EndsWithinThreeReadings) {
  Robot robot(roundCorners);
  robot.late = 2.0;
  robot.driveFor(40);
  ASSERT_NEAR(robot.lateness.seconds(), 2.0, 0.25);
  robot.late = 0.0;
  robot.isElsewhere = true;
  const int changes = robot.changes;
  for (int i = 0; i < 3; ++i) robot.drive();
  EXPECT_EQ(robot.lateness.seconds(), 0.0);
  EXPECT_EQ(robot.changes, changes + 1);
  // Without a jump to be seen, it is found as it was found.
  robot.isElsewhere = false;
  robot.late = 1.0;
  robot.driveFor(40);
  EXPECT_NEAR(robot.lateness.seconds(), 1.0, 0.25);
  robot.lateness.forget();
  EXPECT_NEAR(robot.lateness.seconds(), 1.0, 0.25) << "that is of the devices";
  robot.lateness.forgetAll();
  EXPECT_EQ(robot.lateness.seconds(), 0.0);
}

// The whole filter: the estimate is of now, though all readings are of 1.5 s ago.
TEST(LateReadings, DoNotKeepTheEstimateBehind) {
  FakeRun run;
  run.begin({-1, 0, 0}, 3);
  const auto mcl = run.mcl(run.config());
  mcl->startAt(run.truth, 0.1, 0.05);
  double worst = 0.0;
  for (int i = 0; i < 900; ++i) {
    run.late = i < 600 ? 15 : 0;
    // To and fro with turns between, so that it stays in the room.
    const double phase = std::fmod(0.1 * i, 6.0);
    run.drive(phase < 3.0 ? 0.5 : 0.0, phase < 3.0 ? 0.0 : 1.15);
    const bool isWeighed = mcl->update(run.container);
    const PoseEstimate now = *mcl->estimate(run.stamp);
    if (isWeighed) {
      EXPECT_EQ(mcl->estimate().stamp, run.stamp) << "whatever the delay";
    }
    const double error = distance(now.pose, run.truth);
    const bool isSettled = (i > 300 && i < 600) || i > 630;
    if (isSettled) worst = std::max(worst, error);
    if (i > 300 && i < 600) {
      EXPECT_EQ(now.status, TrackStatus::kUncertain) << i;
      EXPECT_EQ(now.reason, TrackReason::kLate) << i;
    }
  }
  EXPECT_LT(worst, 0.3);
  EXPECT_EQ(mcl->estimate(run.stamp)->status, TrackStatus::kTracking);
}

/// A robot somewhere: by delay d it is d/2 m farther along x than by none.
Delays::Predicted ahead(double variance) {
  Delays::Predicted predicted;
  for (std::size_t i = 0; i < Delays::kCount; ++i) {
    predicted[i].pose = {2.0 + 0.5 * Delays::secondsOf(i), -1.0, 3.1};
    predicted[i].covariance = {variance, 0, 0, 0, variance, 0, 0, 0, 0.01};
  }
  return predicted;
}

// Against Bayes' rule by hand: sharp readings are at a point.
TEST(LatenessDelays, FollowBayesRule) {
  Delays delays;
  PoseEstimate seen;
  seen.pose = {2.1, -1.0, 3.1};
  seen.covariance = {};
  const double variance = 0.1;
  const std::array before = {delays.probability(0), delays.probability(1)};
  delays.follow(ahead(variance), 0, seen, 1e-9);
  const auto normal = [&](double off) {
    return std::exp(-0.5 * off * off / (variance + 0.05 * 0.05)) + std::exp(-4.0);
  };
  const double odds = before[0] * normal(0.1) / (before[1] * normal(0.025));
  EXPECT_NEAR(delays.probability(0) / delays.probability(1), odds, 1e-3 * odds);
}

// In a corridor the belief is where odometry has put it, by the delay that is in force.
TEST(LatenessDelays, LearnNothingFromReadingsThatTellNothing) {
  for (const std::size_t inForce : {0, 6}) {
    Delays delays;
    const Delays::Predicted predicted = ahead(0.1);
    PoseEstimate seen = predicted[inForce];
    seen.covariance[0] += 0.0024;  // as wide as it was expected
    seen.covariance[4] = 1e-4;     // across, they do
    const double before = delays.probability(0);
    for (int i = 0; i < 20; ++i) delays.follow(predicted, inForce, seen, 1e-9);
    EXPECT_NEAR(delays.probability(0), before, 0.005) << inForce;
  }
}

// Where readings are vague the belief lies between them and the motion in force: 4 nats, no more.
TEST(LatenessDelays, CountOneSecondOnceHoweverFarTheReadingsAre) {
  for (const double x : {1.0, 2.4, 3.2, 4.0}) {
    Delays delays;
    std::array<double, Delays::kCount> before{};
    for (std::size_t i = 0; i < Delays::kCount; ++i) before[i] = delays.probability(i);
    PoseEstimate seen;
    seen.pose = {x, -1.0, 3.1};
    seen.covariance = {0.009, 0, 0, 0, 0.009, 0, 0, 0, 0.009};
    delays.follow(ahead(0.01), 0, seen, 1e-9);
    for (std::size_t i = 1; i < Delays::kCount; ++i) {
      const double nats =
          std::log(delays.probability(i) / delays.probability(0)) - std::log(before[i] / before[0]);
      EXPECT_LT(std::abs(nats), 4.1) << x << ", delay " << i;
    }
  }
}

TEST(LatenessDelays, LearnNothingWhereNoDelayLeadsToTheReadings) {
  Delays delays;
  PoseEstimate seen;
  seen.pose = {-3.0, -1.0, 3.1};
  seen.covariance = {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-4};
  const double before = delays.probability(0);
  for (int i = 0; i < 20; ++i) delays.follow(ahead(0.1), 0, seen, 1e-9);
  EXPECT_NEAR(delays.probability(0), before, 1e-3);
}

TEST(LatenessDelays, CanAlwaysBeginAndEnd) {
  Delays delays;
  const Delays::Predicted predicted = ahead(0.01);
  const auto readFor = [&](std::size_t delay, int seconds) {
    PoseEstimate seen = predicted[delay];
    seen.covariance = {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-4};
    for (int i = 0; i < seconds; ++i) delays.follow(predicted, 0, seen, 1.0);
  };
  readFor(0, 1000);
  EXPECT_GT(delays.probability(0), 0.9999);
  readFor(8, 3);
  EXPECT_EQ(delays.mostProbable(), 0U) << "so long odometry may be wrong";
  readFor(8, 1000);
  EXPECT_EQ(delays.mostProbable(), 8U);
  readFor(0, 4);
  EXPECT_EQ(delays.mostProbable(), 0U) << "to have none is the rule";
}

}  // namespace
}  // namespace ortung
