// How a log becomes examples for a motion network, against motions in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "MotionGrid.hpp"

namespace ortung::app {
namespace {

constexpr double kStep = 0.1;

/// A log with the truth every 0.1 s, and commands in force from some times on.
CommandLog logOf(const std::function<Pose2(double)>& poseAt, double seconds,
                 const std::vector<std::pair<double, Velocities>>& commands) {
  CommandLog log;
  for (int i = 0; 0.1 * i < seconds + 1e-9; ++i)
    log.truth.add(fromSeconds(0.1 * i), poseAt(0.1 * i), 0.0, 0.0);
  for (const auto& [time, velocities] : commands)
    log.commands.emplace_back(fromSeconds(time), velocities);
  return log;
}

/// On a straight line with an acceleration of 1 m/s^2.
Pose2 accelerated(double t) { return {t * t / 2, 0.0, 0.0}; }

TEST(MotionGrid, StepsLieWhereTruthAndCommandsAreBothKnown) {
  // From the first command, at 0.5 s, to the last one, at 2.5 s.
  const CommandLog log = logOf(accelerated, 3.0, {{0.5, {1, 10}}, {1.25, {2, 20}}, {2.5, {3, 30}}});
  const auto grids = gridsOf(log, kStep, 0.0, 1.0);
  ASSERT_EQ(grids.size(), 1u);
  const MotionGrid& grid = grids[0];
  ASSERT_EQ(grid.truth.size(), 21u);
  for (std::size_t k = 0; k < 21; ++k) {
    const double t = 0.5 + 0.1 * static_cast<double>(k);
    EXPECT_NEAR(grid.truth[k].x, t * t / 2, 1e-9) << k;
    // That of 1.25 s is in force at 1.3 s, that of 2.5 s at its own time.
    const double command = k < 8 ? 1.0 : k < 20 ? 2.0 : 3.0;
    EXPECT_EQ(grid.command[k].translational, command) << k;
    EXPECT_EQ(grid.command[k].rotational, 10 * command) << k;
  }
}

TEST(MotionGrid, VelocitiesAreMeansOfTheLastFifthOfASecond) {
  const CommandLog log = logOf(accelerated, 3.0, {{0.5, {}}, {2.5, {}}});
  const MotionGrid grid = gridsOf(log, kStep, 0.0, 1.0).at(0);
  EXPECT_EQ(grid.velocity[0].translational, 0.0) << "not known yet";
  EXPECT_NEAR(grid.velocity[1].translational, 0.55, 1e-9) << "the mean of 0.5 and 0.6 m/s";
  for (std::size_t k = 2; k < 21; ++k)
    EXPECT_NEAR(grid.velocity[k].translational, 0.4 + 0.1 * static_cast<double>(k), 1e-9) << k;
}

// Of a step of 0.5 s, a fifth of a second is less than one, so the window is that one step.
TEST(MotionGrid, LongStepsHaveAWindowOfOneStep) {
  const CommandLog log = logOf(accelerated, 10.0, {{0.0, {}}, {10.0, {}}});
  const MotionGrid grid = gridsOf(log, 0.5, 0.0, 1.0).at(0);
  ASSERT_EQ(grid.truth.size(), 21u);
  EXPECT_NEAR(grid.velocity[4].translational, 1.75, 1e-9) << "the mean of 1.5 and 2 m/s";
}

// On a circle of 2 m with 0.5 rad/s; the chord of 0.1 rad is 4 sin(0.05) m.
TEST(MotionGrid, VelocitiesInCurvesAreThoseAlongTheChord) {
  const auto onCircle = [](double t) {
    return Pose2{2 * std::sin(0.5 * t), 2 - 2 * std::cos(0.5 * t), wrapAngle(0.5 * t)};
  };
  const MotionGrid grid =
      gridsOf(logOf(onCircle, 20.0, {{0.0, {}}, {20.0, {}}}), kStep, 0.0, 1.0).at(0);
  for (const std::size_t k : {2U, 50U, 150U}) {
    EXPECT_NEAR(grid.velocity[k].translational, 4 * std::sin(0.05) / 0.2, 1e-6);
    EXPECT_NEAR(grid.velocity[k].rotational, 0.5, 1e-6);
  }
}

TEST(MotionGrid, PartsOfALogAreSharesOfItsTime) {
  const CommandLog log = logOf(accelerated, 4.0, {{0.0, {}}, {4.0, {}}});
  const auto expectPart = [&](double from, double to, double begin, std::size_t steps) {
    const auto grids = gridsOf(log, kStep, from, to);
    ASSERT_EQ(grids.size(), 1u);
    EXPECT_EQ(grids[0].truth.size(), steps) << from;
    EXPECT_NEAR(grids[0].truth[0].x, begin * begin / 2, 1e-9) << from;
  };
  expectPart(0.0, 0.5, 0.0, 21);
  expectPart(0.5, 1.0, 2.0, 21);
  expectPart(0.25, 0.5, 1.0, 11);
  EXPECT_TRUE(gridsOf(log, kStep, 0.0, 0.2).empty()) << "nine steps are too few";
  EXPECT_EQ(gridsOf(log, kStep, 0.0, 0.225).size(), 1u) << "ten are enough";
}

TEST(MotionGrid, AGapOfTheTruthBeginsANewOne) {
  const auto withGap = [](double from, double to) {
    CommandLog log = logOf(accelerated, 2.0, {{0.0, {}}, {6.0, {}}});
    log.truth.clear();
    for (int i = 0; i <= 60; ++i)
      if (0.1 * i < from + 1e-9 || 0.1 * i > to - 1e-9)
        log.truth.add(fromSeconds(0.1 * i), accelerated(0.1 * i), 0.0, 0.0);
    return gridsOf(log, kStep, 0.0, 1.0);
  };
  ASSERT_EQ(withGap(2.0, 2.5).size(), 1u) << "half a second is interpolated";
  EXPECT_EQ(withGap(2.0, 2.5)[0].truth.size(), 61u);
  const auto two = withGap(2.0, 2.6);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_NEAR(two[1].truth[0].x, 2.6 * 2.6 / 2, 1e-9);
  EXPECT_EQ(two[1].truth.size(), 35u);
  EXPECT_EQ(two[1].velocity.size(), 35u);
  EXPECT_EQ(two[1].velocity[0].translational, 0.0) << "what was before the gap does not count";
  EXPECT_EQ(withGap(0.7, 1.5).size(), 1u) << "the part before it is too short";
}

TEST(MotionGrid, WithoutTruthOrCommandsThereIsNone) {
  CommandLog log = logOf(accelerated, 3.0, {});
  EXPECT_TRUE(gridsOf(log, kStep, 0.0, 1.0).empty());
  log.commands.emplace_back(0, Velocities{});
  log.truth.clear();
  EXPECT_TRUE(gridsOf(log, kStep, 0.0, 1.0).empty());
}

/// Steps with numbers that are all different.
MotionGrid numbered(std::size_t steps) {
  MotionGrid grid;
  for (std::size_t k = 0; k < steps; ++k) {
    const auto n = static_cast<double>(k);
    grid.truth.push_back({n * n, 0.0, 0.0});
    grid.velocity.push_back({0.1 * n, 0.01 * n * n});
    grid.command.push_back({1.0 + n, -1.0 - n});
  }
  return grid;
}

MotionNetwork networkOf(std::size_t commands) {
  MotionNetwork network;
  network.step = kStep;
  network.commands = commands;
  network.limit = {10.0, 10.0};
  return network;
}

TEST(MotionExamples, HaveStateAndNewestCommandsFirstAndTheDifferencesFromKeepingOn) {
  const auto examples = examplesOf(networkOf(2), {numbered(6)});
  // Two steps make the velocity, and the last step has no successor: steps 2, 3 and 4.
  ASSERT_EQ(examples.size(), 3u);
  const std::vector<double> input = {0.2, 0.04, 3, -3, 2, -2};
  const std::vector<double> output = {9 - 4 - 0.2 * kStep, 0.0, -0.04 * kStep, 0.1, 0.05};
  ASSERT_EQ(examples[0].input.size(), input.size());
  ASSERT_EQ(examples[0].output.size(), output.size());
  for (std::size_t i = 0; i < input.size(); ++i)
    EXPECT_NEAR(examples[0].input[i], input[i], 1e-12) << i;
  for (std::size_t i = 0; i < output.size(); ++i)
    EXPECT_NEAR(examples[0].output[i], output[i], 1e-12) << i;
  EXPECT_EQ(examples[2].input[2], 5.0);
}

TEST(MotionExamples, ChangesAreInTheRobotsOwnFrame) {
  MotionGrid grid = numbered(4);
  for (Velocities& velocity : grid.velocity) velocity = {};
  grid.truth[2] = {1.0, 2.0, M_PI / 2};
  grid.truth[3] = {0.7, 2.5, M_PI / 2 + 0.2};
  const MotionExample example = examplesOf(networkOf(1), {grid}).at(0);
  EXPECT_NEAR(example.output[0], 0.5, 1e-12);
  EXPECT_NEAR(example.output[1], 0.3, 1e-12);
  EXPECT_NEAR(example.output[2], 0.2, 1e-12);
}

TEST(MotionExamples, BeginWhereAllCommandsAreKnownAndLeaveOutJumps) {
  EXPECT_EQ(examplesOf(networkOf(1), {numbered(10)}).size(), 7u);
  EXPECT_EQ(examplesOf(networkOf(6), {numbered(10)}).size(), 4u);
  EXPECT_EQ(examplesOf(networkOf(6), {numbered(10), numbered(7)}).size(), 5u);
  EXPECT_EQ(examplesOf(networkOf(6), {numbered(6)}).size(), 0u);
  MotionGrid grid = numbered(10);
  grid.velocity[5].translational = -10.5;  // neither from it nor to it
  EXPECT_EQ(examplesOf(networkOf(1), {grid}).size(), 5u);
  grid.velocity[5] = {10.0, 10.5};
  EXPECT_EQ(examplesOf(networkOf(1), {grid}).size(), 5u);
  grid.velocity[5] = {10.0, -10.0};
  EXPECT_EQ(examplesOf(networkOf(1), {grid}).size(), 7u);
}

TEST(MotionLimit, IsThirtyPercentAboveTheGreatestCommand) {
  MotionGrid grid;
  grid.command = {{0.5, -2.0}, {-1.0, 1.0}};
  grid.velocity = {{0.1, 0.2}, {0.3, 0.4}};
  const Velocities limit = limitOf({grid});
  EXPECT_NEAR(limit.translational, 1.3, 1e-12);
  EXPECT_NEAR(limit.rotational, 2.6, 1e-12);
}

// Of 1000 velocities 0.5 % may be faster: jumps of the truth. At 99.5 % of 999 is number 994.
TEST(MotionLimit, IsAboveAlmostAllTrueVelocities) {
  MotionGrid grid;
  grid.command = {{0.1, 0.1}};
  for (int i = 0; i < 1000; ++i) grid.velocity.push_back({-0.01 * i, 0.002 * i});
  for (std::size_t i = 996; i < 1000; ++i) grid.velocity[i] = {50.0, -50.0};
  const Velocities limit = limitOf({grid});
  EXPECT_NEAR(limit.translational, 1.3 * 9.94, 1e-9);
  EXPECT_NEAR(limit.rotational, 1.3 * 1.988, 1e-9);
}

TEST(MotionLimit, IsNeitherZeroNorEndless) {
  EXPECT_EQ(limitOf({}).translational, 0.01);
  MotionGrid grid;
  grid.command = {{0.0, 1e6}};
  EXPECT_EQ(limitOf({grid}).translational, 0.01);
  EXPECT_EQ(limitOf({grid}).rotational, 100.0);
}

Pose2 standsStill(const MotionGrid&, std::size_t, std::size_t) { return {}; }

TEST(PredictionErrors, AreDistancesFromTheTrueChangeOverAllSteps) {
  MotionGrid grid;
  for (const double x : {0.0, 1.0, 3.0, 6.0, 10.0, 15.0}) grid.truth.push_back({x, 0.0, 0.1 * x});
  grid.velocity.resize(6);
  grid.command.resize(6);
  // Over two steps, from the second step on: 5, 7 and 9 m along the heading at their beginning.
  const PredictionErrors errors = errorsOf(standsStill, {grid}, 2, 1, {1.0, 1.0});
  EXPECT_EQ(errors.count, 3u);
  EXPECT_NEAR(errors.positionMedian, 7.0, 1e-12);
  EXPECT_NEAR(errors.positionRmse, std::sqrt((25.0 + 49.0 + 81.0) / 3), 1e-12);
  EXPECT_NEAR(errors.headingMedian, 0.7, 1e-12);
  EXPECT_NEAR(errors.headingRmse, std::sqrt((0.25 + 0.49 + 0.81) / 3), 1e-12);
}

TEST(PredictionErrors, PredictorsAreAskedForEachStepAndJudgedInItsFrame) {
  MotionGrid grid;
  for (int k = 0; k < 5; ++k) grid.truth.push_back({0.0, 1.0 * k, M_PI / 2});
  grid.velocity.resize(5);
  grid.command.resize(5);
  std::vector<std::size_t> asked;
  const auto ahead = [&](const MotionGrid&, std::size_t at, std::size_t steps) {
    asked.push_back(at);
    return Pose2{static_cast<double>(steps), 0.0, 0.0};
  };
  const PredictionErrors errors = errorsOf(ahead, {grid, grid}, 3, 0, {1.0, 1.0});
  EXPECT_EQ(asked, (std::vector<std::size_t>{0, 1, 0, 1}));
  EXPECT_NEAR(errors.positionRmse, 0.0, 1e-12);
  EXPECT_NEAR(errors.headingRmse, 0.0, 1e-12);
}

TEST(PredictionErrors, PiecesInWhichTheTruthJumpsDoNotCount) {
  MotionGrid grid;
  grid.truth.resize(8);
  grid.velocity.resize(8);
  grid.command.resize(8);
  EXPECT_EQ(errorsOf(standsStill, {grid}, 2, 0, {1.0, 1.0}).count, 6u);
  grid.velocity[4].rotational = -1.5;  // within the pieces from 2, 3 and 4 on
  EXPECT_EQ(errorsOf(standsStill, {grid}, 2, 0, {1.0, 1.0}).count, 3u);
  EXPECT_EQ(errorsOf(standsStill, {grid}, 2, 5, {1.0, 1.0}).count, 1u);
  const PredictionErrors none = errorsOf(standsStill, {grid}, 8, 0, {1.0, 1.0});
  EXPECT_EQ(none.count, 0u);
  EXPECT_EQ(none.positionRmse, 0.0);
}

}  // namespace
}  // namespace ortung::app
