// How far estimates are from where odometry has led to.
#include <gtest/gtest.h>

#include <cmath>

#include "Separation.hpp"

namespace ortung {
namespace {

constexpr double kSigma = 0.01;  // of estimates and of each step of odometry [m], [rad]

PoseEstimate at(double x, double y = 0.0, double theta = 0.0) {
  PoseEstimate estimate;
  estimate.pose = {x, y, theta};
  estimate.covariance = independent(kSigma * kSigma, kSigma * kSigma, kSigma * kSigma);
  return estimate;
}

MotionChange ahead(double metres) {
  MotionChange change;
  change.mean = {metres, 0.0, 0.0};
  change.covariance = independent(kSigma * kSigma, kSigma * kSigma, kSigma * kSigma);
  return change;
}

/// An estimate at the origin, a step of odometry, and the next estimate.
Separation stepped(const PoseEstimate& then) {
  Separation separation;
  separation.follow(at(0.0));
  separation.move(ahead(0.5));
  separation.follow(then);
  return separation;
}

TEST(Separation, IsNothingWhereCovariancesExplainIt) {
  // The sigma along the way is 0.01 sqrt(2), and 4 sigma are explained.
  EXPECT_EQ(stepped(at(0.5)).after(1.0).metres, 0.0);
  EXPECT_EQ(stepped(at(0.5 + 0.055)).after(1.0).metres, 0.0);
  EXPECT_NEAR(stepped(at(0.5 + 0.058)).after(0.0).metres, 0.058, 1e-9);
}

TEST(Separation, ReachesToWhereOdometryHasLed) {
  const Separation separation = stepped(at(0.2, 0.4, 0.3));
  EXPECT_NEAR(separation.after(0.0).metres, 0.5, 1e-9);
  EXPECT_NEAR(separation.after(0.0).radians, 0.3, 1e-9);
}

// What errs once may err again: until the next readings come, it grows with the way.
TEST(Separation, GrowsWithTheWaySinceTheNewestReadings) {
  const Separation separation = stepped(at(0.4, 0.0, 0.1));
  EXPECT_NEAR(separation.after(1.0).metres, 0.1 + 0.2, 1e-9);
  EXPECT_NEAR(separation.after(1.0).radians, 0.1 + 0.2, 1e-9);
  // No odometry errs by more than all of its way.
  EXPECT_NEAR(stepped(at(3.5)).after(1.0).metres, 3.0 + 1.0, 1e-9);
}

// A wrong estimate agrees with the next one, which begins from it.
TEST(Separation, CountsForSomeUpdates) {
  Separation separation = stepped(at(0.3));
  const auto agrees = [&](int updates) {
    for (int i = 0; i < updates; ++i) {
      separation.move(ahead(0.0));
      separation.follow(at(0.3));
    }
    return separation.after(0.0).metres;
  };
  EXPECT_NEAR(agrees(5), 0.2 * std::pow(0.9, 5), 1e-9);
  EXPECT_NEAR(agrees(5), 0.2 * std::pow(0.9, 10), 1e-9);
  EXPECT_LT(agrees(80), 1e-4);
}

TEST(Separation, AGreaterOneTakesThePlaceOfASmallerOne) {
  Separation separation = stepped(at(0.3));
  separation.move(ahead(0.5));
  separation.follow(at(1.8));
  EXPECT_NEAR(separation.after(0.0).metres, 1.0, 1e-9);
  separation.move(ahead(0.5));
  separation.follow(at(2.3 + 0.1));
  EXPECT_NEAR(separation.after(0.0).metres, 0.9, 1e-9);
}

TEST(Separation, IsForgottenWithTheBelief) {
  Separation separation = stepped(at(3.0));
  separation.forget();
  EXPECT_EQ(separation.after(1.0).metres, 0.0);
  separation.move(ahead(0.5));
  separation.follow(at(-20.0));  // the first estimate of another belief
  EXPECT_EQ(separation.after(1.0).metres, 0.0);
}

}  // namespace
}  // namespace ortung
