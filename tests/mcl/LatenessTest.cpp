// Readings whose stamps are late: what it takes until that is known, and what becomes of the
// belief.
#include <gtest/gtest.h>

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
    }
    if (reads) read();
  }
  void driveFor(double seconds) {
    for (int i = 0; i < static_cast<int>(4 * seconds); ++i) drive();
  }

  Timestamp now() const { return fromSeconds(kStep * static_cast<double>(truths.size() - 1)); }

  void read() {
    const auto steps = static_cast<std::size_t>(std::lround(late / kStep));
    const Pose2 there = truths[truths.size() - 1 - std::min(truths.size() - 1, steps)];
    const PoseSearch::Weigh weigh = [&](const SampleSet& set, std::vector<float>& out) {
      out.resize(set.size());
      for (std::size_t i = 0; i < set.size(); ++i) out[i] = logProbability(set, i, there);
    };
    const Lateness::Fit fit = [&](const SampleSet& set) {
      const std::vector<double> weights = normalized(set.logWeight);
      double sum = 0.0;
      for (std::size_t i = 0; i < set.size(); ++i)
        sum += weights[i] * (1.0 - static_cast<double>(logProbability(set, i, there)) / kFloor);
      return sum;
    };
    ++readings;
    const double evidence = isElsewhere ? kFloor : expected(there);
    const auto change = lateness.follow({now(), evidence, evidence < kDoubtful, there, readings},
                                        recovery, weigh, fit);
    if (change) {
      ++changes;
      changed = change->samples;
    }
    SampleSet belief;
    belief.resize(200);
    Random random(readings);
    for (std::size_t i = 0; i < belief.size(); ++i) {
      belief.x[i] = static_cast<float>(there.x + 0.02 * random.gaussian());
      belief.y[i] = static_cast<float>(there.y + 0.02 * random.gaussian());
      belief.theta[i] = static_cast<float>(there.theta + 0.01 * random.gaussian());
    }
    lateness.keep(belief, normalized(belief.logWeight), there, now());
    believed = there;
    odometryThen = *lateness.odometryAt(now());
  }

  static constexpr double kStep = 0.025;  ///< [s]
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
    EXPECT_EQ(robot.lateness.lead(), 0.0);
    Robot delayed(roundCorners);
    delayed.late = late;
    delayed.driveFor(5);
    EXPECT_EQ(delayed.changes, 0) << late << ": two events at most";
    EXPECT_GE(delayed.lateness.lead(), 8.0) << late;
    delayed.driveFor(32);
    EXPECT_NEAR(delayed.lateness.seconds(), late, 0.3);
    EXPECT_FALSE(delayed.changed) << late << ": the belief stays";
  }
}

TEST(Lateness, CannotBeKnownOnAStraightWay) {
  Robot robot(straight);
  robot.late = 2.0;
  robot.driveFor(10);  // of the first seconds, in which it set off, it has heard
  const double before = robot.lateness.lead();
  robot.driveFor(60);
  EXPECT_LE(robot.lateness.lead(), before);
  EXPECT_EQ(robot.lateness.seconds(), 0.0);
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
    EXPECT_EQ(robot.lateness.isSuspected(), hasGap);
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
  robot.lateness.forgetBelief();
  EXPECT_NEAR(robot.lateness.seconds(), 1.0, 0.25) << "that is of the devices";
  EXPECT_EQ(robot.lateness.lead(), 0.0);
  robot.lateness.forget();
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

}  // namespace
}  // namespace ortung
