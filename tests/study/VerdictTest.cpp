#include <gtest/gtest.h>

#include <vector>

#include "ortung/study/Verdict.hpp"

namespace ortung::test {
namespace {

constexpr Timestamp kTenth = 100'000;
constexpr Timestamp kEnd = 1'000'000'000;
using State = Verdict::State;

/// A robot that goes 1 m a second, looked at ten times a second, with errors as given.
std::vector<EvaluationPoint> pointsWith(const std::vector<double>& errors) {
  std::vector<EvaluationPoint> points;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EvaluationPoint point;
    point.stamp = static_cast<Timestamp>(i) * kTenth;
    point.truth = {0.1 * static_cast<double>(i), 0, 0};
    point.positionError = errors[i];
    points.push_back(point);
  }
  return points;
}

std::vector<double> errors(const std::vector<std::pair<double, int>>& pieces) {
  std::vector<double> all;
  for (const auto& [error, count] : pieces)
    all.insert(all.end(), static_cast<std::size_t>(count), error);
  return all;
}

TEST(Verdict, IsRightFromTheFirstPointOnThatStaysSoForLongEnough) {
  const auto points = pointsWith(errors({{2.0, 30}, {0.1, 20}, {2.0, 10}, {0.1, 51}}));
  const Verdict verdict = judge(points, 0, kEnd, {});
  EXPECT_EQ(verdict.state, State::kRight);
  EXPECT_EQ(verdict.stamp, 60 * kTenth);
  EXPECT_DOUBLE_EQ(verdict.seconds, 6.0);
  EXPECT_NEAR(verdict.travelled, 6.0, 1e-9);
  const std::vector<EvaluationPoint> some(points.begin(), points.end() - 1);
  EXPECT_EQ(judge(some, 0, kEnd, {}).state, State::kOpen);
}

TEST(Verdict, LooksAtWhatLiesBetweenItsTimesAlone) {
  const auto points = pointsWith(errors({{0.1, 60}, {2.0, 20}, {0.1, 60}}));
  const Verdict after = judge(points, 70 * kTenth, kEnd, {});
  EXPECT_EQ(after.state, State::kRight);
  EXPECT_DOUBLE_EQ(after.seconds, 1.0);
  EXPECT_NEAR(after.travelled, 1.0, 1e-9);
  EXPECT_EQ(judge(points, 70 * kTenth, 130 * kTenth, {}).state, State::kOpen);
  EXPECT_EQ(judge({}, 0, kEnd, {}).state, State::kOpen);
}

TEST(Verdict, HeadingCountsAsPositionDoes) {
  auto points = pointsWith(errors({{0.1, 100}}));
  for (std::size_t i = 0; i < 20; ++i) points[i].headingError = 0.3;
  EXPECT_EQ(judge(points, 0, kEnd, {}).stamp, 20 * kTenth);
  EXPECT_EQ(judge(points, 0, kEnd, {.metres = 0.45, .radians = 4.0}).stamp, 0);
}

TEST(Verdict, IsWrongOnceTheWayIsUsedUp) {
  const RightRule rule{.mostTravelled = 2.0};
  EXPECT_EQ(judge(pointsWith(errors({{2.0, 20}})), 0, kEnd, rule).state, State::kOpen);
  EXPECT_EQ(judge(pointsWith(errors({{2.0, 25}, {0.1, 100}})), 0, kEnd, rule).state, State::kWrong);
  // What was right within the way may show that later.
  EXPECT_EQ(judge(pointsWith(errors({{2.0, 15}, {0.1, 40}})), 0, kEnd, rule).state, State::kOpen);
  EXPECT_EQ(judge(pointsWith(errors({{2.0, 15}, {0.1, 60}})), 0, kEnd, rule).state, State::kRight);
  EXPECT_EQ(judge(pointsWith(errors({{2.0, 15}, {0.1, 40}, {2.0, 1}})), 0, kEnd, rule).state,
            State::kWrong);
}

// Truth trembles by a centimetre or two; a robot that stands goes no way.
TEST(DistanceMeter, DoesNotCountTrembling) {
  DistanceMeter meter;
  double way = 0.0;
  for (int i = 0; i < 1000; ++i) way = meter.add({1.0 + (i % 2 == 0 ? 0.02 : -0.02), 0, 0});
  EXPECT_EQ(way, 0.0);
  for (int i = 0; i <= 100; ++i) way = meter.add({1.02 + 0.03 * i, 0, 0});
  EXPECT_NEAR(way, 3.0, 0.05);
}

}  // namespace
}  // namespace ortung::test
