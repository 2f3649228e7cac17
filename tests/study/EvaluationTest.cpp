#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ortung/base/Random.hpp"
#include "ortung/study/Evaluation.hpp"

namespace ortung {
namespace {

constexpr double kPi = std::numbers::pi;

EvaluationStep step(double seconds, const Pose2& pose, double ms = 1.0) {
  EvaluationStep s;
  s.estimate.stamp = fromSeconds(seconds);
  s.estimate.pose = pose;
  s.estimate.samples = 100;
  s.estimate.covariance = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  s.updateMilliseconds = ms;
  s.spentMilliseconds = 2.0 * ms;
  return s;
}

/// The estimate of an update that is also the one of a moment.
void addBoth(Evaluation& evaluation, const EvaluationStep& s) {
  evaluation.addStep(s);
  evaluation.addMoment(s.estimate);
}

/// Truth stands at the origin for 100 s; the estimate at second t is off by error(t).
template <class Error>
EvaluationResult resultOf(const Error& error, double from = 0.0, double to = 100.0) {
  Evaluation evaluation;
  for (int t = 0; t <= 100; ++t) {
    evaluation.addTime(fromSeconds(t));
    evaluation.addTruth(fromSeconds(t), {});
    if (t >= from && t <= to) addBoth(evaluation, step(t, error(t)));
  }
  return evaluation.result("test:x");
}

TEST(Interpolate, GoesStraightAndTheShortWayRound) {
  const std::vector<std::pair<Timestamp, Pose2>> truth = {{0, {0, 0, kPi - 0.1}},
                                                          {1000000, {1, 2, -kPi + 0.3}}};
  const auto middle = interpolate(truth, 250000, 1.0);
  ASSERT_TRUE(middle.has_value());
  EXPECT_NEAR(middle->x, 0.25, 1e-12);
  EXPECT_NEAR(middle->y, 0.5, 1e-12);
  EXPECT_NEAR(middle->theta, kPi, 1e-12);
  EXPECT_EQ(interpolate(truth, 1000000, 1.0)->x, 1.0);
  EXPECT_EQ(interpolate(truth, 0, 1.0)->x, 0.0);
  EXPECT_FALSE(interpolate(truth, -1, 1.0).has_value());
  EXPECT_FALSE(interpolate(truth, 1000001, 1.0).has_value());
  EXPECT_FALSE(interpolate(truth, 500000, 0.9).has_value()) << "the gap is too long";
  EXPECT_FALSE(interpolate({}, 0, 1.0).has_value());
}

TEST(Evaluation, ConvergesWhenTheErrorStaysSmallForFiveSeconds) {
  // Small at 3..5 s (too short), then from 10 s on.
  const auto result =
      resultOf([](int t) { return Pose2{(t >= 3 && t <= 5) || t >= 10 ? 0.1 : 2.0, 0, 0}; });
  ASSERT_TRUE(result.convergedAfter.has_value());
  EXPECT_DOUBLE_EQ(*result.convergedAfter, 10.0);
  EXPECT_NEAR(result.overTime.positionRmse, 0.1, 1e-12) << "over the time after convergence only";
  EXPECT_EQ(result.overTime.lostShare, 0.0);
}

TEST(Evaluation, HeadingCountsForConvergence) {
  const auto result = resultOf([](int t) { return Pose2{0, 0, t < 20 ? kPi : 0.2}; });
  ASSERT_TRUE(result.convergedAfter.has_value());
  EXPECT_DOUBLE_EQ(*result.convergedAfter, 20.0);
  EXPECT_NEAR(result.overTime.headingRmse, 0.2, 1e-12);
}

TEST(Evaluation, NeverConvergedHasNoErrors) {
  const auto result = resultOf([](int) { return Pose2{3, 0, 0}; });
  EXPECT_FALSE(result.convergedAfter.has_value());
  for (const double figure :
       {result.overTime.positionRmse, result.overTime.positionMedian, result.overTime.positionP95,
        result.overTime.headingRmse, result.overTime.lostShare, result.overTime.neesMean}) {
    EXPECT_TRUE(std::isnan(figure));
  }
  EXPECT_EQ(result.points.size(), 101u);
}

// Errors 0.00, 0.01, ..., 1.00 m in mixed order after 6 s of no error: known quantiles.
TEST(Evaluation, GivesMedianP95RmseAndLostShare) {
  Evaluation evaluation;
  std::vector<double> errors(101);
  for (std::size_t i = 0; i <= 100; ++i) errors[i] = 0.01 * static_cast<double>((37 * i) % 101);
  for (int t = 0; t < 20; ++t) errors.push_back(3.0);
  // The quiet beginning lasts 6 s at 100 Hz less one: it weighs nothing beside its count.
  for (std::size_t i = 0; i < errors.size() + 6; ++i) {
    const auto t = static_cast<double>(i);
    evaluation.addTime(fromSeconds(t));
    evaluation.addTruth(fromSeconds(t), {});
    addBoth(evaluation, step(t, {i < 6 ? 0.0 : errors[i - 6], 0, 0}));
  }
  const auto result = evaluation.result("x");
  ASSERT_EQ(result.convergedAfter, 0.0);
  // 127 sorted values: seven times 0 (six and the list's own), 0.01 ... 1.00, twenty times 3.
  EXPECT_NEAR(result.overTime.positionMedian, 0.57, 1e-12);  // number 63: 63 - 6 = 57
  EXPECT_NEAR(result.overTime.positionP95, 3.0, 1e-12);      // number 119.7
  EXPECT_NEAR(result.overTime.positionP99, 3.0, 1e-12);
  EXPECT_EQ(result.overTime.positionMax, 3.0);
  double squares = 20 * 9.0;
  for (int i = 0; i <= 100; ++i) squares += 1e-4 * i * i;
  EXPECT_NEAR(result.overTime.positionRmse, std::sqrt(squares / 127), 1e-12);
  EXPECT_NEAR(result.overTime.lostShare, 20.0 / 127, 1e-12);
}

// The covariance is that of one metre, so NEES is the square of the error: above 16.266 from 4.0332
// m on.
TEST(Evaluation, CountsWhatTheFilterHoldsToBeAllButImpossible) {
  const auto result = resultOf([](int t) {
    return Pose2{t < 91 ? 0.1 : t < 96 ? 4.03 : 4.04, 0, 0};
  });
  EXPECT_NEAR(result.overTime.neesAboveShare, 5.0 / 101, 1e-12);
}

// Truth stands at the origin; the levels are 0.1 m and 0.2 rad.
TEST(Evaluation, CountsErrorsBeyondTheProtectionLevelByStatus) {
  Evaluation evaluation;
  const auto moment = [](int t) {
    PoseEstimate e = step(t, {0.05, 0.0, 0.0}).estimate;
    e.status = t < 80   ? TrackStatus::kTracking
               : t < 90 ? TrackStatus::kUncertain
                        : TrackStatus::kLost;
    e.protection = {0.1, 0.2};
    if (t == 10 || t == 95) e.pose.x = 0.11;
    if (t == 20) e.pose.theta = -0.21;
    if (t >= 80 && t < 84) e.pose.y = -0.3;
    if (t == 84) e.protection = kUnbounded;
    return e;
  };
  for (int t = 0; t < 100; ++t) {
    evaluation.addTruth(fromSeconds(t), {});
    evaluation.addMoment(moment(t));
  }
  const EvaluationResult r = evaluation.result("test:x");
  EXPECT_NEAR(r.beyondProtectionShare, 2.0 / 80.0, 1e-12);
  EXPECT_NEAR(r.beyondProtectionUncertainShare, 4.0 / 10.0, 1e-12);
  EXPECT_NEAR(r.protectionMedian, 0.1, 1e-12);
  EXPECT_NEAR(r.protectionRatio, 2.0, 1e-9);
}

TEST(Evaluation, OfNoTimeThatIsTrackedThereAreNoProtectionLevels) {
  const EvaluationResult r = resultOf([](int) { return Pose2{}; });  // lost all the time
  EXPECT_TRUE(std::isnan(r.beyondProtectionShare));
  EXPECT_TRUE(std::isnan(r.protectionMedian));
  EXPECT_TRUE(std::isnan(r.protectionRatio));
}

TEST(Evaluation, TellsTheWayUntilItConvergedAndTheLongestUpdate) {
  Evaluation evaluation;
  for (int t = 0; t <= 40; ++t) {
    const Pose2 truth{0.5 * t, 0, 0};
    evaluation.addTime(fromSeconds(t));
    evaluation.addTruth(fromSeconds(t), truth);
    addBoth(evaluation, step(t, {truth.x + (t < 12 ? 2.0 : 0.1), 0, 0}, t == 7 ? 30.0 : 1.0));
  }
  const auto result = evaluation.result("x");
  EXPECT_EQ(result.convergedAfter, 12.0);
  EXPECT_NEAR(result.convergedDistance, 6.0, 1e-9);
  EXPECT_EQ(result.updateMsMax, 30.0);
  EXPECT_TRUE(std::isnan(resultOf([](int) { return Pose2{3, 0, 0}; }).convergedDistance));
}

TEST(Evaluation, QuantilesLieBetweenOrderStatistics) {
  Evaluation evaluation;
  for (int t = 0; t < 11; ++t) {
    evaluation.addTime(fromSeconds(t));
    evaluation.addTruth(fromSeconds(t), {});
    addBoth(evaluation, step(t, {0.01 * t, 0, 0}, 10.0 - t));
  }
  const auto result = evaluation.result("x");
  EXPECT_NEAR(result.overTime.positionP95, 0.095, 1e-12);
  EXPECT_NEAR(result.updateMsP50, 5.0, 1e-12);
  EXPECT_NEAR(result.updateMsP99, 9.9, 1e-12);
  EXPECT_NEAR(result.realtimeFactor, 10.0 / 0.110, 1e-9) << "of all time, not the longest updates";
  EXPECT_NEAR(result.particlesMean, 100.0, 1e-9);
  EXPECT_EQ(result.duration, 10.0);
}

TEST(Evaluation, StepsWithoutTruthAreNotCompared) {
  Evaluation evaluation;
  for (int t = 0; t <= 100; ++t) {
    evaluation.addTime(fromSeconds(t));
    if (t < 40 || t > 60) evaluation.addTruth(fromSeconds(t), {});
    // Within the gap the estimate is far off, which nobody can know.
    addBoth(evaluation, step(t, {t >= 40 && t <= 60 ? 9.0 : 0.0, 0, 0}));
  }
  const auto result = evaluation.result("x");
  EXPECT_EQ(result.steps, 101u);
  EXPECT_EQ(result.atCorrections.compared, 80u);
  EXPECT_EQ(result.overTime.positionRmse, 0.0);
}

TEST(Evaluation, ErrorsOfAConsistentFilterHaveANeesOfThree) {
  Random random(1);
  Evaluation evaluation;
  const double sx = 0.02;
  const double sy = 0.05;
  const double st = 0.03;
  const double r = 0.7;  // correlation of x and y
  for (int i = 0; i < 20000; ++i) {
    const double t = 0.01 * i;
    const double a = random.gaussian();
    const double b = r * a + std::sqrt(1 - r * r) * random.gaussian();
    EvaluationStep s =
        step(t, Pose2{3 + sx * a, -1 + sy * b, wrapAngle(kPi + st * random.gaussian())});
    s.estimate.covariance = {sx * sx, r * sx * sy, 0, r * sx * sy, sy * sy, 0, 0, 0, st * st};
    evaluation.addTime(fromSeconds(t));
    evaluation.addTruth(fromSeconds(t), {3, -1, kPi});
    addBoth(evaluation, s);
  }
  // The sum of three squares of normal numbers: mean 3, variance 6.
  EXPECT_NEAR(evaluation.result("x").overTime.neesMean, 3.0, 5 * std::sqrt(6.0 / 20000));
}

TEST(Evaluation, CovarianceThatCannotBeInvertedIsLeftOut) {
  Evaluation evaluation;
  for (int t = 0; t <= 10; ++t) {
    EvaluationStep s = step(t, {0.1, 0, 0});
    s.estimate.covariance = {};
    if (t == 10) s.estimate.covariance = {0.01, 0, 0, 0, 1, 0, 0, 0, 1};
    evaluation.addTime(fromSeconds(t));
    evaluation.addTruth(fromSeconds(t), {});
    addBoth(evaluation, s);
  }
  EXPECT_NEAR(evaluation.result("x").overTime.neesMean, 1.0, 1e-9)
      << "only the last: (0.1 / 0.1)^2";
}

TEST(Evaluation, RefusesTimeThatRunsBackwards) {
  Evaluation evaluation;
  evaluation.addTruth(5, {});
  evaluation.addTruth(5, {});
  EXPECT_THROW(evaluation.addTruth(4, {}), std::invalid_argument);
  evaluation.addStep(step(1, {}));
  EXPECT_THROW(evaluation.addStep(step(0.5, {})), std::invalid_argument);
  evaluation.addMoment(step(1, {}).estimate);
  EXPECT_THROW(evaluation.addMoment(step(0.5, {}).estimate), std::invalid_argument);
  evaluation.due(fromSeconds(3));
  EXPECT_THROW(evaluation.due(fromSeconds(2)), std::invalid_argument);
}

TEST(Evaluation, OfNothingIsEmpty) {
  const auto result = Evaluation().result("x");
  EXPECT_EQ(result.steps, 0u);
  EXPECT_EQ(result.duration, 0.0);
  EXPECT_FALSE(result.convergedAfter.has_value());
}

TEST(Evaluation, WithoutReadingTimesCountsFromTheFirstStep) {
  Evaluation evaluation;
  for (int t = 50; t <= 60; ++t) {
    evaluation.addTruth(fromSeconds(t), {});
    addBoth(evaluation, step(t, {}));
  }
  EXPECT_EQ(evaluation.result("x").convergedAfter, 0.0);
}

std::vector<double> secondsOf(const std::vector<Timestamp>& stamps) {
  std::vector<double> seconds;
  for (const Timestamp stamp : stamps) seconds.push_back(toSeconds(stamp));
  return seconds;
}

TEST(Evaluation, WantsEstimatesAtEvenTimesBeforeItGoesOn) {
  Evaluation evaluation;
  EXPECT_TRUE(evaluation.due(fromSeconds(5.0)).empty()) << "nothing was seen before";
  EXPECT_EQ(secondsOf(evaluation.due(fromSeconds(5.25))), (std::vector{5.0, 5.1, 5.2}));
  EXPECT_EQ(secondsOf(evaluation.due(fromSeconds(5.25))), (std::vector<double>{}));
  EXPECT_EQ(secondsOf(evaluation.due(fromSeconds(5.3))), (std::vector<double>{}));
  EXPECT_EQ(secondsOf(evaluation.due(fromSeconds(5.31))), (std::vector{5.3}))
      << "once the readings of 5.3 s are known";
  EXPECT_EQ(secondsOf(evaluation.due(fromSeconds(5.4))), (std::vector<double>{}));
  EXPECT_EQ(secondsOf(evaluation.due(fromSeconds(1e9))), (std::vector{5.4}))
      << "not ten thousand million: of a gap nobody knows the truth";
  EXPECT_EQ(secondsOf(evaluation.due(fromSeconds(1e9 + 0.05))), (std::vector{1e9}));
  Evaluation slower({.period = 0.5});
  slower.due(0);
  EXPECT_EQ(secondsOf(slower.due(fromSeconds(1.0))), (std::vector{0.0, 0.5}));
  EXPECT_EQ(slower.result("x").period, 0.5);
  for (const double bad : {0.0, -1.0, std::nan("")})
    EXPECT_THROW(Evaluation({.period = bad}), std::invalid_argument) << bad;
}

TEST(Evaluation, RareTruthIsComparedAtItsOwnTime) {
  Evaluation evaluation;
  for (int i = 0; i <= 1000; ++i) {  // readings at 0.7 s, 0.77 s ..., truth every 7 s
    const Timestamp stamp = 700000 + 70000 * i;
    const bool hasTruth = i % 100 == 50;
    for (const Timestamp time : evaluation.due(stamp, hasTruth))
      evaluation.addMoment(step(toSeconds(time), {0.25, 0, 0}).estimate);
    evaluation.addTime(stamp);
    if (hasTruth) evaluation.addTruth(stamp, {});
  }
  const auto result = evaluation.result("x");
  EXPECT_EQ(result.overTime.compared, 10u);
  EXPECT_NEAR(result.overTime.positionRmse, 0.25, 1e-12);
  EXPECT_TRUE(result.points[1].followsGap);
  // Asked for after its own moment, not before.
  Evaluation one;
  one.due(0);
  EXPECT_EQ(secondsOf(one.due(fromSeconds(0.05), true)), (std::vector{0.0}));
  one.addTruth(fromSeconds(0.05), {});
  EXPECT_EQ(secondsOf(one.due(fromSeconds(0.05))), (std::vector<double>{}))
      << "there may be more readings of that time";
  EXPECT_EQ(secondsOf(one.due(fromSeconds(0.11))), (std::vector{0.05, 0.1}));
}

// A filter that is right whenever it sees something, every 10 s, and runs away at 1 cm/s between.
TEST(Evaluation, ErrorsAreOverTimeAndThoseAtUpdatesStandBeside) {
  Evaluation evaluation;
  for (int i = 0; i <= 1000; ++i) {
    const double t = 0.1 * i;
    const double error = 0.001 * (i % 100);
    evaluation.addTime(fromSeconds(t));
    evaluation.addTruth(fromSeconds(t), {});
    if (i % 100 == 0) evaluation.addStep(step(t, {0, 0, 0}));
    evaluation.addMoment(step(t, {error, 0, 0}).estimate);
  }
  const auto result = evaluation.result("x");
  EXPECT_EQ(result.steps, 11u);
  EXPECT_EQ(result.atCorrections.compared, 11u);
  EXPECT_EQ(result.atCorrections.positionRmse, 0.0);
  EXPECT_EQ(result.overTime.compared, 1001u);
  // Mean of (0.001 k)^2 over k = 0 ... 99 is 1e-6 * 99 * 199 / 6; the last moment adds a zero.
  EXPECT_NEAR(result.overTime.positionRmse, std::sqrt(1e-6 * 99 * 199 / 6 * 1000 / 1001), 1e-12);
  EXPECT_NEAR(result.overTime.positionMedian, 0.049, 0.0011);
  EXPECT_NEAR(result.overTime.neesMean, 1e-6 * 99 * 199 / 6 * 1000 / 1001, 1e-9);
}

TEST(Evaluation, UpdatesBeforeConvergenceDoNotCountEither) {
  Evaluation evaluation;
  for (int t = 0; t <= 30; ++t) {
    evaluation.addTruth(fromSeconds(t), {});
    addBoth(evaluation, step(t, {t < 10 ? 3.0 : 0.25, 0, 0}));
  }
  const auto result = evaluation.result("x");
  EXPECT_NEAR(result.atCorrections.positionRmse, 0.25, 1e-12);
  EXPECT_NEAR(result.atCorrections.positionP95, 0.25, 1e-12);
  EXPECT_EQ(result.atCorrections.lostShare, 0.0);
}

TEST(Evaluation, LimitsAreOptions) {
  const auto evaluate = [](const Evaluation::Options& options) {
    Evaluation evaluation(options);
    for (int t = 0; t <= 20; ++t) {
      evaluation.addTruth(fromSeconds(t), {});
      addBoth(evaluation, step(t, {0.3, 0, t < 3 ? 1.0 : 0.2}));
    }
    return evaluation.result("x");
  };
  EXPECT_EQ(evaluate({}).convergedAfter, 3.0);
  EXPECT_EQ(evaluate({}).overTime.lostShare, 0.0);
  EXPECT_FALSE(evaluate({.convergedMetres = 0.25}).convergedAfter);
  EXPECT_FALSE(evaluate({.convergedRadians = 0.1}).convergedAfter);
  EXPECT_EQ(evaluate({.convergedRadians = 1.5}).convergedAfter, 0.0);
  EXPECT_FALSE(evaluate({.convergedSeconds = 18.0}).convergedAfter);
  EXPECT_EQ(evaluate({.lostMetres = 0.25}).overTime.lostShare, 1.0);
  EXPECT_EQ(evaluate({.longestGap = 0.5}).points.size(), 21u) << "at truth's own times";
}

TEST(Evaluation, PointsTellWhereNothingIsKnown) {
  Evaluation evaluation;
  for (int i = 0; i <= 100; ++i) {
    const double t = 0.1 * i;
    if (t < 3.95 || t > 6.05) evaluation.addTruth(fromSeconds(t), {});
    evaluation.addMoment(step(t, {0, 0, 0}).estimate);
  }
  const auto points = evaluation.result("x").points;
  std::vector<double> behindGaps;
  for (const EvaluationPoint& p : points)
    if (p.followsGap) behindGaps.push_back(toSeconds(p.stamp));
  EXPECT_EQ(behindGaps, (std::vector{6.1}));
  EXPECT_EQ(points.front().covariance[0], 1.0);
}

}  // namespace
}  // namespace ortung
