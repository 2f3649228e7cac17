// Bounds beside those that are known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ortung/base/Random.hpp"
#include "ortung/study/PoseBound.hpp"

namespace ortung {
namespace {

std::array<double, 9> diagonal(double x, double y, double theta) {
  return {x, 0, 0, 0, y, 0, 0, 0, theta};
}

// A robot that stands: n readings with sigma each leave sigma / sqrt(n).
TEST(PoseBound, ReadingsOfARobotThatStandsAddUp) {
  std::vector<BoundStep> steps;
  for (int i = 0; i < 50; ++i)
    steps.push_back({100'000 * i, {1, 2, 0.5}, {}, diagonal(1 / 0.01, 1 / 0.04, 1 / 0.0001)});
  const std::vector<PoseBound> bounds = poseBound(steps, 1e3);
  ASSERT_EQ(bounds.size(), 50U);
  for (const int n : {1, 10, 50}) {
    const auto& c = bounds[static_cast<std::size_t>(n) - 1].covariance;
    EXPECT_NEAR(c[0], 0.01 / n, 1e-8) << n;
    EXPECT_NEAR(c[4], 0.04 / n, 1e-7) << n;
    EXPECT_NEAR(c[8], 0.0001 / n, 1e-9) << n;
  }
}

// Straight ahead along y with odometry that is off by a random walk along the way: the filter's
// steady state is the fixed point of c = (c + q) r / (c + q + r), known since Kalman.
TEST(PoseBound, OfARandomWalkItIsKalmansSteadyState) {
  constexpr double kQ = 1e-4;
  constexpr double kR = 0.01;
  Random random(5);
  std::vector<BoundStep> steps;
  double odometry = 0.0;
  for (int i = 0; i < 20'000; ++i) {
    if (i > 0) odometry += 0.1 + std::sqrt(kQ) * random.gaussian();
    steps.push_back(
        {100'000 * i, {0, 0.1 * i, M_PI / 2}, {odometry, 0, 0}, diagonal(1e4, 1 / kR, 1e6)});
  }
  const double steady = 0.5 * (-kQ + std::sqrt(kQ * kQ + 4 * kQ * kR));
  const auto bound = poseBound(steps);
  const auto& c = bound.back().covariance;
  EXPECT_NEAR(c[4], steady, 0.04 * steady);  // q is fitted to 2,000 pieces: to 3 %
}

// A range to one landmark straight ahead says nothing aside, until the way turns heading into it:
// F carries what is known of the heading to the place.
TEST(PoseBound, HeadingBecomesPlaceAlongTheWay) {
  std::vector<BoundStep> steps;
  for (int i = 0; i <= 10; ++i)
    steps.push_back({100'000 * i, {0.5 * i, 0, 0}, {0.5 * i, 0, 0}, {}});
  steps.front().information = diagonal(1e6, 1e6, 1 / 0.0004);
  const auto bound = poseBound(steps);
  const auto& c = bound.back().covariance;
  EXPECT_NEAR(c[4], 1e-6 + 25 * 0.0004, 1e-5);  // 5 m with 0.02 rad
  EXPECT_NEAR(c[5], 5 * 0.0004, 1e-5);
}

/// A drive around the corners of a square of 5 m, whose odometry errs at random along the way and
/// in the heading alone, as a wheeled robot's does; then straight on without readings.
std::vector<BoundStep> driveWithErrors(int sides, double sigmaWay, double sigmaTurn) {
  Random random(7);
  std::vector<BoundStep> steps;
  Pose2 truth;
  Pose2 odometry;
  const auto go = [&](double way, double turn) {
    const double itsWay = way + sigmaWay * std::sqrt(way) * random.gaussian();
    const double itsTurn = turn + sigmaTurn * std::sqrt(way) * random.gaussian();
    truth = truth * Pose2{way * std::cos(turn / 2), way * std::sin(turn / 2), turn};
    odometry =
        odometry * Pose2{itsWay * std::cos(itsTurn / 2), itsWay * std::sin(itsTurn / 2), itsTurn};
    steps.push_back({100'000 * static_cast<Timestamp>(steps.size()), truth, odometry,
                     diagonal(1e10, 1e10, 1e10)});
  };
  for (int side = 0; side < sides; ++side) {
    for (int i = 0; i < 50; ++i) go(0.1, 0.0);
    for (int i = 0; i < 10; ++i) go(0.02, M_PI / 20);
  }
  for (int i = 0; i < 30; ++i) {
    go(0.1, 0.0);
    steps.back().information = {};
  }
  return steps;
}

// Noise of the heading alone: aside it grows with the third power of the way, sigma^2 L^3 / 3. If
// that were taken for noise of the place, too, it would be counted twice.
TEST(PoseBound, ErrorsOfTheHeadingAreNotCountedAsThoseOfThePlaceTheyLeadTo) {
  constexpr double kWay = 0.02;
  constexpr double kTurn = 0.0175;
  const std::vector<BoundStep> steps = driveWithErrors(200, kWay, kTurn);
  const PoseBound bound = poseBound(steps).back();
  const double heading = steps.back().truth.theta;
  const double c = std::cos(heading);
  const double s = std::sin(heading);
  const auto& p = bound.covariance;
  const double ahead = c * c * p[0] + 2 * c * s * p[1] + s * s * p[4];
  const double aside = s * s * p[0] - 2 * c * s * p[1] + c * c * p[4];
  EXPECT_NEAR(ahead, kWay * kWay * 3.0, 0.1 * kWay * kWay * 3.0);  // variances to 3 % of 2,000
  EXPECT_NEAR(aside, kTurn * kTurn * 9.0, 0.1 * kTurn * kTurn * 9.0);
  EXPECT_NEAR(p[8], kTurn * kTurn * 3.0, 0.1 * kTurn * kTurn * 3.0);
}

// Of a round normal distribution the median distance is sigma sqrt(2 ln 2), the RMS sigma sqrt 2.
TEST(PoseBound, FiguresAreThoseOfRayleigh) {
  std::vector<PoseBound> bounds;
  for (int i = 0; i < 5000; ++i) bounds.push_back({i, diagonal(0.0004, 0.0004, 0.01)});
  const BoundFigures figures = figuresOf(bounds, 1000);
  EXPECT_NEAR(figures.positionRmse, 0.02 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(figures.positionMedian, 0.02 * std::sqrt(2 * std::log(2.0)), 4e-4);
  EXPECT_NEAR(figures.headingRmse, 0.1, 1e-9);
  EXPECT_TRUE(std::isnan(figuresOf(bounds, 5000).positionRmse));
}

}  // namespace
}  // namespace ortung
