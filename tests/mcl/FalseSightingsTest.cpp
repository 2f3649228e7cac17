// Landmarks of which half are others, anywhere: the place holds, and its error hardly grows.
#include <gtest/gtest.h>

#include <cmath>

#include "FakeRun.hpp"

namespace ortung {
namespace {

using test::kPi;

constexpr double kPeriod = 0.1;  // [s]
constexpr double kSpeed = 0.4;   // [m/s]
constexpr double kTurn = 0.3;    // [rad/s]
constexpr int kPeriods = 120;

const std::vector<test::Point> kPoints = {{1, 3.5, 2.0},  {2, -3.0, -2.2}, {3, -3.6, 1.8},
                                          {4, 3.2, -2.1}, {5, 0.2, 2.3},   {6, -0.4, -2.3}};

/// Squares of the errors of position of one drive, summed up; infinite: it was off by 0.5 m.
double squaredErrors(SensorContainer& container, const FieldRegion& region, double falseShare,
                     std::uint64_t seed) {
  MclConfig config;
  config.maxSamples = 2000;
  config.seed = seed;
  Mcl mcl(config, region, std::make_unique<OdometryMotion>());
  Random random(seed);
  Pose2 truth{0.0, -1.33, 0.0};
  Pose2 odometry;
  mcl.startAt(truth, 0.05, 0.05);
  double sum = 0.0;
  for (int i = 1; i <= kPeriods; ++i) {
    const Timestamp stamp = fromSeconds(100.0 * static_cast<double>(seed) + kPeriod * i);
    truth = truth * Pose2{kSpeed * kPeriod, 0, kTurn * kPeriod};
    odometry = odometry * Pose2{kSpeed * kPeriod * (1 + 0.02 * random.gaussian()), 0,
                                kTurn * kPeriod + 0.004 * random.gaussian()};
    LandmarksData::Reading reading;
    for (const test::Point& p : kPoints) {
      const double noise[2] = {0.05 * random.gaussian(), 0.02 * random.gaussian()};
      const double anywhere[3] = {random.uniform(), random.uniform(0, 8),
                                  random.uniform(-kPi, kPi)};
      const bool isFalse = random.uniform() < falseShare;
      if (isFalse)
        reading.push_back(
            {static_cast<std::uint32_t>(1 + 6 * anywhere[0]), anywhere[1], anywhere[2]});
      else
        reading.push_back({p.identity, std::hypot(p.x - truth.x, p.y - truth.y) + noise[0],
                           test::bearingTo(truth, p.x, p.y) + noise[1]});
    }
    container.set({stamp, {"b", "odometry", "pose"}, OdometryData::encode({odometry, 0, 0, {}})});
    container.set({stamp, {"cam", "camera", "posts"}, LandmarksData::encode(reading)});
    mcl.update(container);
    const Pose2 found = mcl.estimate(stamp)->pose;
    const double error = std::hypot(found.x - truth.x, found.y - truth.y);
    if (!(error < 0.5)) return INFINITY;
    sum += error * error;
  }
  return sum;
}

TEST(FalseSightings, ThatAreHalfOfAllCostLessThanHalfOfTheAccuracyAndNoRun) {
  const test::Room room{8, 5};
  const FieldRegion region = room.region(0.1, 0.2);
  SensorContainer container;
  container.add(std::make_unique<OdometryData>(SensorId{"b", "odometry", "pose"}));
  LandmarksData::Config config{
      .identities = {1, 2, 3, 4, 5, 6}, .range = {.sigma = 0.05}, .bearing = {.sigma = 0.02}};
  SensorData& posts = container.add(
      std::make_unique<LandmarksData>(SensorId{"cam", "camera", "posts"}, Pose2{}, config));
  test::learnEverywhere(posts, region, kPi,
                        [&](const Pose2& s) { return landmarkWords(kPoints, s, 20.0); });
  double without = 0.0;
  double with = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    without += squaredErrors(container, region, 0.0, 2 * seed);
    const double sum = squaredErrors(container, region, 0.5, 2 * seed + 1);
    EXPECT_TRUE(std::isfinite(sum)) << "lost with seed " << seed;
    with += sum;
  }
  EXPECT_LT(std::sqrt(without / (20 * kPeriods)), 0.015);
  EXPECT_LT(std::sqrt(with / (20 * kPeriods)), 0.03);
  EXPECT_LT(std::sqrt(with / without), 2.0);
}

}  // namespace
}  // namespace ortung
