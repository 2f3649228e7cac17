// The heaviest place, polished: against Kalman's filter in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "FakeRun.hpp"
#include "Polish.hpp"
#include "ortung/motion/OdometryMotion.hpp"

namespace ortung {
namespace {

using test::FakeRun;

/// Reads the pose itself, with independent noise.
class PoseReading final : public Weigher, public Polishable {
 public:
  PoseReading(const Pose2& read, double sigma, double blur)
      : read_(read), sigma_(sigma), blur_(blur) {}
  Slope slopeAt(const Pose2& pose) const override {
    Slope slope;
    slope.blurMetres = blur_;
    const double weight = 1.0 / (sigma_ * sigma_);
    slope.add(read_.x - pose.x, {1, 0, 0}, weight);
    slope.add(read_.y - pose.y, {0, 1, 0}, weight);
    slope.add(wrapAngle(read_.theta - pose.theta), {0, 0, 1}, weight);
    return slope;
  }

 private:
  void weigh(const SampleView&, std::span<float>) const override {}
  Pose2 read_;
  double sigma_;
  double blur_;
};

/// Leads half of the way to where it reads the pose, and counts how often it is asked.
class HalfwayReading final : public Weigher, public Polishable {
 public:
  HalfwayReading(const Pose2& read, double sigma, int& asked)
      : read_(read), sigma_(sigma), asked_(asked) {}
  Slope slopeAt(const Pose2& pose) const override {
    ++asked_;
    const Pose2 half{0.5 * (read_.x + pose.x), 0.5 * (read_.y + pose.y), read_.theta};
    return PoseReading(half, sigma_, 0.0).slopeAt(pose);
  }

 private:
  void weigh(const SampleView&, std::span<float>) const override {}
  Pose2 read_;
  double sigma_;
  int& asked_;
};

class OtherReading final : public Weigher {
  void weigh(const SampleView&, std::span<float>) const override {}
};

std::vector<NewReading> reading(const Pose2& read, double sigma, double blur = 0.0) {
  return {{nullptr, 1, std::make_shared<PoseReading>(read, sigma, blur)}};
}

PoseEstimate cluster(const Pose2& pose, double sigma) {
  PoseEstimate e;
  e.pose = pose;
  e.covariance = {sigma * sigma, 0, 0, 0, sigma * sigma, 0, 0, 0, sigma * sigma};
  return e;
}

TEST(Polish, IsTheMeanOfWhatWasKnownAndWhatIsRead) {
  Polish polish;
  PoseEstimate before = cluster({0, 0, 0.5}, 0.04);
  polish.follow(reading({9, 9, 0}, 0.01),
                before);  // far away: of the cluster alone something is known
  PoseEstimate estimate = cluster({0.02, 0, 0.5}, 0.05);
  polish.follow(reading({0.03, -0.01, 0.5}, 0.01), estimate);
  // A cluster's mean is known to 3 cm at best, so what was known has a sigma of 5 cm.
  const double known = 1.0 / (0.05 * 0.05);
  const double read = 1.0 / (0.01 * 0.01);
  EXPECT_NEAR(estimate.pose.x, 0.03 * read / (known + read), 1e-9);
  EXPECT_NEAR(estimate.pose.y, -0.01 * read / (known + read), 1e-9);
}

TEST(Polish, EndsOnceItsStepsAreSmallBesideTheSigma) {
  Polish polish(false);
  int asked = 0;
  PoseEstimate estimate = cluster({0, 0, 0.5}, 0.05);
  polish.follow({{nullptr, 1, std::make_shared<HalfwayReading>(Pose2{0.03, 0, 0.5}, 0.01, asked)}},
                estimate);
  // Steps of 15, 7, 3.4, 1.7, 0.8 and 0.4 mm: the last is less than 5 % of the sigma of 9.9 mm.
  EXPECT_EQ(asked, 6);
  EXPECT_NEAR(estimate.pose.x, 0.0283, 0.0005);
}

TEST(Polish, FollowsLikeAKalmanFilterWhereReadingsKeepTheirPromises) {
  Polish polish;
  Random random(1);
  const Pose2 truth{1, 2, 0.3};
  double squares = 0.0;
  double claimed = 0.0;
  for (int i = 0; i < 400; ++i) {
    PoseEstimate estimate = cluster(truth, 0.1);
    const auto noisy = [&](double v) { return v + 0.01 * random.gaussian(); };
    polish.follow(reading({noisy(truth.x), noisy(truth.y), noisy(truth.theta)}, 0.01), estimate);
    if (i < 200) continue;
    squares += std::pow(estimate.pose.x - truth.x, 2);
    claimed += estimate.covariance[0];
  }
  // The mean of hundreds of readings, not the last one: 0.01 / sqrt(200) and better.
  EXPECT_LT(std::sqrt(squares / 200), 0.003);
  EXPECT_GT(claimed, 0.2 * squares);
  EXPECT_LT(claimed, 100.0 * squares);
}

TEST(Polish, BelievesReadingsLessThatSurpriseIt) {
  // Readings promise 1 mm and scatter by 2 cm.
  Polish polish;
  Random random(2);
  const Pose2 truth{1, 2, 0.3};
  double nees = 0.0;
  for (int i = 0; i < 400; ++i) {
    PoseEstimate estimate = cluster(truth, 0.05);
    const auto noisy = [&](double v) { return v + 0.02 * random.gaussian(); };
    polish.follow(reading({noisy(truth.x), noisy(truth.y), noisy(truth.theta)}, 0.001), estimate);
    if (i >= 100) nees += std::pow(estimate.pose.x - truth.x, 2) / estimate.covariance[0] / 300;
  }
  EXPECT_GT(nees, 0.03);
  EXPECT_LT(nees, 3.0);
}

TEST(Polish, MixesWhatMapsLeaveOpenAndNeverAveragesItOut) {
  // Two sensors in turn: what the first compares with is off by the same 2 cm in all of a run.
  constexpr double kNoise = 0.01;
  constexpr double kMap = 0.02;
  constexpr int kRuns = 300;
  Random random(3);
  const Pose2 truth{1, 2, 0.3};
  double nees = 0.0;
  double claimed = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    Polish polish;
    const double off = kMap * random.gaussian();
    PoseEstimate estimate;
    const auto noisy = [&](double v) { return v + kNoise * random.gaussian(); };
    const auto read = [&](double mapOff, double blur) {
      estimate = cluster(truth, 0.05);
      polish.follow(
          reading({noisy(truth.x) + mapOff, noisy(truth.y), noisy(truth.theta)}, kNoise, blur),
          estimate);
    };
    for (int i = 0; i < 100; ++i) {
      read(off, kMap);
      read(0.0, 0.0);
    }
    nees += std::pow(estimate.pose.x - truth.x, 2) / estimate.covariance[0] / kRuns;
    claimed += std::sqrt(estimate.covariance[0]) / kRuns;
  }
  // Each has half of the say. That they contradict each other widens the covariance a little more.
  EXPECT_GT(nees, 0.3);
  EXPECT_LT(nees, 1.2);
  EXPECT_GT(claimed, 0.5 * kMap);
  EXPECT_LT(claimed, 0.9 * kMap);
}

TEST(Polish, ForgetsAPlaceThatIsNotThatOfTheSamples) {
  Polish polish;
  PoseEstimate estimate = cluster({0, 0, 0}, 0.05);
  polish.follow(reading({0.5, 0, 0}, 0.001), estimate);
  EXPECT_EQ(estimate.pose.x, 0.0);  // half a metre away is another place
  polish.follow(reading({0.02, 0, 0}, 0.001), estimate);
  EXPECT_NEAR(estimate.pose.x, 0.02, 1e-3);
  PoseEstimate elsewhere = cluster({3, 0, 0}, 0.05);
  polish.apply(elsewhere);
  EXPECT_EQ(elsewhere.pose.x, 3.0);
  PoseEstimate here = cluster({0.05, 0, 0}, 0.05);
  polish.apply(here);
  EXPECT_NEAR(here.pose.x, 0.02, 1e-3);
}

TEST(Polish, LeavesTheEstimateToSamplesThatKnowMore) {
  Polish polish;
  PoseEstimate estimate = cluster({0, 0, 0}, 0.002);
  std::vector<NewReading> both = reading({0.02, 0, 0}, 0.1);
  both.push_back({nullptr, 1, std::make_shared<OtherReading>()});
  polish.follow(both, estimate);
  EXPECT_EQ(estimate.pose.x, 0.0);
  EXPECT_EQ(estimate.covariance[0], 0.002 * 0.002);
}

TEST(Polish, MovesByOdometry) {
  Polish polish;
  PoseEstimate estimate = cluster({1, 1, 0}, 0.05);
  polish.follow(reading({1, 1, 0}, 0.001), estimate);
  polish.move(changeOf(OdometryMotion(), {0.5, 0, 0.1}, 1, 1));
  PoseEstimate later = cluster({1.5, 1, 0.1}, 0.05);
  polish.apply(later);
  EXPECT_NEAR(later.pose.x, 1.5, 1e-3);
  EXPECT_NEAR(later.pose.theta, 0.1, 1e-3);
}

TEST(Polish, MakesScansFinerThanCells) {
  // Cells of 0.1 m, noise of 2 cm: what the ranges know is 3 mm.
  FakeRun run(false);
  double squares = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    MclConfig config = run.config();
    config.seed = seed;
    const auto mcl = run.mcl(config);
    run.begin(FakeRun::onCircle(0.5, 0.2, static_cast<double>(seed)), seed);
    mcl->startAt(run.truth, 0.1, 0.05);
    for (int i = 0; i < 100; ++i) {
      run.drive();
      if (!mcl->update(run.container) || i < 20) continue;
      const Pose2& pose = mcl->estimate().pose;
      squares += std::pow(pose.x - run.truth.x, 2) + std::pow(pose.y - run.truth.y, 2);
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 0.008);
}

}  // namespace
}  // namespace ortung
