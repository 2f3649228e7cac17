// A pose estimate carried on by odometry, against the propagation of errors done by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "CarriedOn.hpp"
#include "ortung/base/InstructionSet.hpp"

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

/// Motion that errs in all directions, in correlated ways, and keeps where it has led to.
class Kept : public MotionModel {
 public:
  explicit Kept(double error) : error_(error) {}
  void sampleMotion(const MovableSamples& samples, const Pose2& change, std::uint64_t,
                    std::uint64_t, std::uint64_t) const override {
    poses.clear();
    for (std::size_t i = 0; i < samples.x.size(); ++i) {
      const auto k = static_cast<double>(i);
      const double a = error_ * std::sin(k);
      const double b = error_ * std::cos(1.7 * k);
      samples.x[i] = static_cast<float>(change.x + a + 0.3 * error_);
      samples.y[i] = static_cast<float>(change.y + 0.5 * a - b);
      samples.theta[i] = static_cast<float>(wrapAngle(change.theta + a + b));
      poses.push_back({static_cast<double>(samples.x[i]), static_cast<double>(samples.y[i]),
                       static_cast<double>(samples.theta[i])});
    }
  }
  mutable std::vector<Pose2> poses;

 private:
  double error_;
};

// By the formulas in two passes.
TEST(CarriedOn, AChangeHasTheMeanAndCovarianceOfItsSamplesWithAnyInstructionSet) {
  const Pose2 odometry{0.05, -0.01, std::numbers::pi - 0.003};
  const Kept motion(0.01);
  std::optional<MotionChange> first;
  for (const InstructionSet set :
       {InstructionSet::kPortable, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    if (!hasInstructionSet(set)) continue;
    useInstructionSet(set);
    const MotionChange change = changeOf(motion, odometry, 1, 2);
    useInstructionSet(std::nullopt);
    if (!first) first = change;
    EXPECT_EQ(change.mean.x, first->mean.x);
    EXPECT_EQ(change.covariance, first->covariance);
  }
  ASSERT_TRUE(first.has_value());
  const auto n = static_cast<double>(motion.poses.size());
  std::array<double, 3> mean{};
  const auto offOf = [&](const Pose2& pose) {
    return std::array{pose.x - odometry.x, pose.y - odometry.y,
                      wrapAngle(pose.theta - odometry.theta)};
  };
  for (const Pose2& pose : motion.poses)
    for (std::size_t k = 0; k < 3; ++k) mean[k] += offOf(pose)[k] / n;
  EXPECT_NEAR(first->mean.x, odometry.x + mean[0], 1e-12);
  EXPECT_NEAR(first->mean.y, odometry.y + mean[1], 1e-12);
  EXPECT_NEAR(wrapAngle(first->mean.theta - odometry.theta - mean[2]), 0.0, 1e-12);
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      double covariance = 0.0;
      for (const Pose2& pose : motion.poses)
        covariance += (offOf(pose)[row] - mean[row]) * (offOf(pose)[column] - mean[column]) / n;
      EXPECT_NEAR(first->covariance[3 * row + column], covariance, 1e-14);
    }
  }
}

/// Knows what its samples would be, and has none.
class Known : public MotionModel, public MotionMoments {
 public:
  void sampleMotion(const MovableSamples&, const Pose2&, std::uint64_t, std::uint64_t,
                    std::uint64_t) const override {
    ADD_FAILURE() << "it is sampled";
  }
  std::optional<MotionChange> moments(const Pose2& change) const override {
    return MotionChange{{2.0 * change.x, 0.5, 0.25}, independent(1e-3, 2e-3, 3e-3)};
  }
};

TEST(CarriedOn, AMotionThatKnowsItsMomentsIsNotSampled) {
  const MotionChange change = changeOf(Known(), {0.3, 0, 0}, 1, 2);
  EXPECT_EQ(change.mean.x, 2.0 * 0.3);
  EXPECT_EQ(change.mean.y, 0.5);
  EXPECT_EQ(change.mean.theta, 0.25);
  EXPECT_EQ(change.covariance, independent(1e-3, 2e-3, 3e-3));
}

TEST(CarriedOn, AChangeWithoutNoiseHasNoNegativeVariance) {
  for (const double x : {0.1, 0.37, 1.3}) {
    const MotionChange change = changeOf(Kept(0.0), {x, 0.3 * x, 0.1}, 1, 2);
    for (const std::size_t k : {0u, 4u, 8u}) {
      EXPECT_GE(change.covariance[k], 0.0);
      EXPECT_LT(change.covariance[k], 1e-20);
    }
  }
}

}  // namespace
}  // namespace ortung
