// Bounds beside those that are known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ortung/base/Random.hpp"
#include "ortung/mcl/PoseBound.hpp"

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
