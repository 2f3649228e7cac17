// A pose estimate carried on by odometry, against the propagation of errors done by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "CarriedOn.hpp"

namespace ortung {
namespace {

/// Motion as odometry says, and a turn that is off by the same amount to either side.
class Tossed : public MotionModel {
 public:
  explicit Tossed(double turn) : turn_(turn) {}
  void sampleMotion(const MovableSamples& samples, const Pose2& change, std::uint64_t,
                    std::uint64_t, std::uint64_t) const override {
    for (std::size_t i = 0; i < samples.x.size(); ++i) {
      const Pose2 moved = Pose2{samples.x[i], samples.y[i], samples.theta[i]} * change *
                          Pose2{0, 0, i % 2 == 0 ? turn_ : -turn_};
      samples.x[i] = static_cast<float>(moved.x);
      samples.y[i] = static_cast<float>(moved.y);
      samples.theta[i] = static_cast<float>(moved.theta);
    }
  }

 private:
  double turn_;
};

// The new place is a function of the old pose, whose derivatives are differences of it.
TEST(CarriedOn, CovarianceIsThatOfTheNewPoseToFirstOrder) {
  PoseEstimate old;
  old.pose = {1.0, -2.0, 0.7};
  old.covariance = {0.04, 0.01, -0.004, 0.01, 0.09, 0.006, -0.004, 0.006, 0.02};
  const Pose2 change{0.8, -0.3, 0.4};
  const PoseEstimate then = carriedOn(old, Tossed(0.0), change, 1, 2);
  const Pose2 exact = old.pose * change;
  EXPECT_NEAR(then.pose.x, exact.x, 1e-6);
  EXPECT_NEAR(then.pose.y, exact.y, 1e-6);
  EXPECT_NEAR(then.pose.theta, exact.theta, 1e-6);
  constexpr double kStep = 1e-5;
  std::array<std::array<double, 3>, 3> f{};
  for (std::size_t k = 0; k < 3; ++k) {
    Pose2 off = old.pose;
    (k == 0 ? off.x : k == 1 ? off.y : off.theta) += kStep;
    const Pose2 moved = off * change;
    f[0][k] = (moved.x - exact.x) / kStep;
    f[1][k] = (moved.y - exact.y) / kStep;
    f[2][k] = wrapAngle(moved.theta - exact.theta) / kStep;
  }
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      double expected = 0.0;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
          expected += f[row][i] * old.covariance[3 * i + k] * f[column][k];
      EXPECT_NEAR(then.covariance[3 * row + column], expected, 1e-5) << row << ", " << column;
    }
  }
}

TEST(CarriedOn, ATurnThatIsUncertainAroundHalfATurnIsNoWholeOne) {
  PoseEstimate old;
  old.pose = {0.0, 0.0, 1.0};
  const double sigma = 0.05;
  const PoseEstimate then = carriedOn(old, Tossed(sigma), {0, 0, std::numbers::pi - 0.01}, 1, 2);
  EXPECT_NEAR(then.covariance[8], sigma * sigma, 1e-5);
  EXPECT_NEAR(wrapAngle(then.pose.theta - (1.0 + std::numbers::pi - 0.01)), 0.0, 1e-5);
}

}  // namespace
}  // namespace ortung
