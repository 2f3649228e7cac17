// Whether odometry is believed; and where a robot may be while it is not.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "Drift.hpp"
#include "OdometryTrust.hpp"
#include "Resampling.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

OdometryTrust lost() {
  OdometryTrust trust;
  trust.lose();
  return trust;
}

/// Readings until trust is back, each of so many nats after so much way; 1000: never.
int readingsUntilRegained(OdometryTrust trust, double nats, double way) {
  for (int i = 0; i < 1000; ++i) {
    if (!trust.isLost()) return i;
    trust.compare(nats, way);
  }
  return 1000;
}

TEST(OdometryTrust, IsThereUntilItIsLost) {
  OdometryTrust trust;
  EXPECT_FALSE(trust.isLost());
  trust.compare(-1000.0, 1.0);
  EXPECT_FALSE(trust.isLost()) << "only rivals take it";
  trust.lose();
  EXPECT_TRUE(trust.isLost());
  trust.forget();
  EXPECT_FALSE(trust.isLost());
}

// 8 nats, of which one reading gives 4 at most after 0.1 m of way.
TEST(OdometryTrust, IsRegainedByReadingsOnAWay) {
  EXPECT_EQ(readingsUntilRegained(lost(), 1000.0, 0.1), 2);
  EXPECT_EQ(readingsUntilRegained(lost(), 1000.0, 5.0), 2);
  EXPECT_EQ(readingsUntilRegained(lost(), 1000.0, 0.05), 4);
  EXPECT_EQ(readingsUntilRegained(lost(), 1.0, 0.1), 8);
  EXPECT_EQ(readingsUntilRegained(lost(), -1.0, 0.1), 1000);
}

TEST(OdometryTrust, IsNotRegainedByOdometryThatStands) {
  EXPECT_EQ(readingsUntilRegained(lost(), 1000.0, 0.0), 1000);
}

TEST(OdometryTrust, ForgetsWhatIsLongPast) {
  OdometryTrust trust = lost();
  for (int i = 0; i < 100; ++i) trust.compare(-4.0, 1.0);
  EXPECT_EQ(readingsUntilRegained(trust, 4.0, 1.0), 4) << "from -8 to 8 nats";
  trust = lost();
  trust.compare(4.0, 1.0);
  trust.lose();
  EXPECT_EQ(readingsUntilRegained(trust, 4.0, 1.0), 2) << "lost anew: counted anew";
}

SampleSet at(const Pose2& pose, std::size_t n) {
  SampleSet set;
  set.resize(n);
  std::fill(set.x.begin(), set.x.end(), static_cast<float>(pose.x));
  std::fill(set.y.begin(), set.y.end(), static_cast<float>(pose.y));
  std::fill(set.theta.begin(), set.theta.end(), static_cast<float>(pose.theta));
  return set;
}

double meanOf(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// About the means of both.
double productOf(const std::vector<float>& a, const std::vector<float>& b) {
  const double meanA = meanOf(a);
  const double meanB = meanOf(b);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += (static_cast<double>(a[i]) - meanA) * (static_cast<double>(b[i]) - meanB);
  return sum / static_cast<double>(a.size());
}

void driftAll(SampleSet& set, double seconds, std::uint64_t stream) {
  drift(MclConfig{}, {set.x, set.y, set.theta}, {}, seconds, stream, 0);
}

// Sigmas after 1 s are 0.5 m along each axis, and 30 degrees; variances grow with time.
TEST(DriftSeconds, AreNoneIfTheClockWasSetBack) {
  EXPECT_EQ(driftSeconds(1'000'000, 3'500'000), 2.5);
  EXPECT_EQ(driftSeconds(3'500'000, 1'000'000), 0.0) << "of which a root is drawn";
}

TEST(Drift, HasTheVariancesOfARandomWalk) {
  for (const double seconds : {0.01, 1.0, 4.0}) {
    SampleSet set = at({3, -2, 1}, 5000);
    driftAll(set, seconds, 5);
    const double sigma = 0.5 * std::sqrt(seconds);
    const double turn = 0.5236 * std::sqrt(seconds);
    EXPECT_NEAR(meanOf(set.x), 3.0, 0.05 * sigma);
    EXPECT_NEAR(meanOf(set.y), -2.0, 0.05 * sigma);
    EXPECT_NEAR(meanOf(set.theta), 1.0, 0.05 * turn);
    EXPECT_NEAR(productOf(set.x, set.x), sigma * sigma, 0.08 * sigma * sigma);
    EXPECT_NEAR(productOf(set.y, set.y), sigma * sigma, 0.08 * sigma * sigma);
    EXPECT_NEAR(productOf(set.theta, set.theta), turn * turn, 0.08 * turn * turn);
    EXPECT_NEAR(productOf(set.x, set.y), 0.0, 0.06 * sigma * sigma);
    EXPECT_NEAR(productOf(set.x, set.theta), 0.0, 0.06 * sigma * turn);
  }
  SampleSet still = at({3, -2, 1}, 100);
  driftAll(still, 0.0, 5);
  EXPECT_EQ(still.x, at({3, -2, 1}, 100).x);
}

TEST(Drift, OfPartsIsThatOfTheWhole) {
  SampleSet whole = at({}, 1000);
  driftAll(whole, 1.0, 5);
  SampleSet parts = at({}, 1000);
  for (const auto& [first, count] : {std::pair<std::size_t, std::size_t>{0, 300}, {300, 700}})
    drift(MclConfig{},
          {std::span(parts.x).subspan(first, count), std::span(parts.y).subspan(first, count),
           std::span(parts.theta).subspan(first, count)},
          {}, 1.0, 5, first);
  EXPECT_EQ(parts.x, whole.x);
  EXPECT_EQ(parts.theta, whole.theta);
}

TEST(Spread, IsHalfWhereOdometryLedAndHalfAnywhereNearWhereTheRobotWas) {
  SampleSet moved = at({5, 0, 0}, 800);
  // Half of the belief's weight is in a quarter of its samples.
  for (std::size_t i = 0; i < 200; ++i) {
    moved.x[i] = 6.0F;
    moved.logWeight[i] = static_cast<float>(std::log(3.0));
  }
  const Spread both = spread(MclConfig{}, moved, at({1, 2, 3}, 500), {}, 1.0, 4000, 7);
  ASSERT_EQ(both.drifted, 4000u);
  ASSERT_EQ(both.samples.size(), 8000u);
  const auto weights = normalized(both.samples.logWeight);
  EXPECT_NEAR(std::accumulate(weights.begin(), weights.begin() + 4000, 0.0), 0.5, 1e-4);
  int ahead = 0;
  for (std::size_t i = 0; i < 4000; ++i) {
    ASSERT_TRUE(both.samples.x[i] == 5.0F || both.samples.x[i] == 6.0F);
    ahead += both.samples.x[i] == 6.0F ? 1 : 0;
  }
  EXPECT_NEAR(ahead, 2000, 2);
  const SampleSet near = both.samples.from(both.drifted);
  EXPECT_NEAR(meanOf(near.x), 1.0, 0.04);
  EXPECT_NEAR(meanOf(near.y), 2.0, 0.04);
  EXPECT_NEAR(meanOf(near.theta), 3.0, 0.04);
  EXPECT_NEAR(productOf(near.x, near.x), 0.25, 0.02);
  EXPECT_NEAR(productOf(near.theta, near.theta), 0.5236 * 0.5236, 0.022);
}

TEST(Spread, HasAsManySamplesAsTheBeliefButNoMoreThanAreAllowed) {
  MclConfig config;
  const auto halfOf = [&](std::size_t samples, std::size_t least) {
    const Spread both = spread(config, at({}, samples), at({}, 300), {}, 0.1, least, 1);
    EXPECT_EQ(both.samples.size(), 2 * both.drifted);
    return both.drifted;
  };
  EXPECT_EQ(halfOf(900, 400), 900u);
  EXPECT_EQ(halfOf(300, 400), 400u);
  config.maxSamples = 350;
  EXPECT_EQ(halfOf(900, 400), 350u);
}

}  // namespace
}  // namespace ortung
