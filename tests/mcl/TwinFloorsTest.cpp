// A robot in a building of two floors that look the same, whose readings are a formula of its place
// on a floor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "FloorShares.hpp"
#include "Told.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/mcl/Mcl.hpp"
#include "ortung/motion/OdometryMotion.hpp"

namespace ortung {
namespace {

constexpr double kApart = 40.0;        ///< from one floor to the other [m]
constexpr double kNearlyAll = 0.9;     ///< share of a floor that settles where the robot is
constexpr std::size_t kSamples = 200;  ///< on both floors together, at first

FieldRegion twoFloors() {
  FieldRegion region;
  region.grid = {0.0, 0.0, 1.0, 50, 10};
  region.open.assign(region.grid.size(), 1);
  region.standable.assign(region.grid.size(), 1);
  region.building.floors = {{"a", 0.0, -5.0, 25.0}, {"b", kApart, 25.0, 60.0}};
  region.check();
  return region;
}

/// Goes round on floor a, with samples on both.
class TwinRun {
 public:
  explicit TwinRun(std::uint64_t seed)
      : mcl_(configOf(seed), twoFloors(), std::make_unique<OdometryMotion>()) {
    container_.add(std::make_unique<OdometryData>(SensorId{"base", "odometry", "pose"}));
    container_.add(std::make_unique<test::Told>(
        "place", [this](const SampleView& poses, std::size_t i) { return tell(poses, i); }));
    Random random(seed, 3);
    Belief belief;
    belief.samples.resize(kSamples);
    for (std::size_t i = 0; i < kSamples; ++i) {
      const double floor = i < kSamples / 2 ? 0.0 : kApart;
      belief.samples.x[i] = static_cast<float>(robot_.x + floor + 0.05 * random.gaussian());
      belief.samples.y[i] = static_cast<float>(robot_.y + 0.05 * random.gaussian());
      belief.samples.theta[i] = static_cast<float>(robot_.theta + 0.02 * random.gaussian());
    }
    mcl_.restore(belief);
  }

  void drive() {
    const Pose2 change{0.05, 0.0, 0.035};
    robot_ = robot_ * change;
    odometry_ = odometry_ * change;
    stamp_ += fromSeconds(0.1);
    container_.set(
        {stamp_, {"base", "odometry", "pose"}, OdometryData::encode({odometry_, 0, 0, {}})});
    container_.set({stamp_, {"told", "test", "place"}, {}});
    EXPECT_TRUE(mcl_.update(container_));
  }
  const Mcl& mcl() const { return mcl_; }

 private:
  static MclConfig configOf(std::uint64_t seed) {
    MclConfig config;
    config.minSamples = 100;
    config.maxSamples = 300;
    config.seed = seed;
    return config;
  }
  /// Sharper than samples are spread, so that their weights differ by chance.
  float tell(const SampleView& poses, std::size_t i) const {
    const double x = static_cast<double>(poses.x[i]);
    const Pose2 onFloor{x < 25.0 ? x : x - kApart, static_cast<double>(poses.y[i]), 0.0};
    const double turned = wrapAngle(static_cast<double>(poses.theta[i]) - robot_.theta);
    return static_cast<float>(std::max(
        -20.0,
        -0.5 * (std::pow(distance(onFloor, robot_) / 0.01, 2) + std::pow(turned / 0.005, 2))));
  }

  Mcl mcl_;
  SensorContainer container_;
  Pose2 robot_{4.5, 3.6, 0.0};
  Pose2 odometry_;
  Timestamp stamp_ = 0;
};

// Chance alone decides on which of both the samples are after a while.
TEST(TwinFloors, StayOpenWhenSamplesHaveLeftOneByChance) {
  const Building building = twoFloors().building;
  int runsThatLeft = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    TwinRun run(seed);
    double ofSamples = 0.0;
    for (int i = 0; i < 200; ++i) {
      run.drive();
      const auto samples = floorShares(building, run.mcl().samples());
      ofSamples = std::max({ofSamples, samples[0], samples[1]});
      const auto shares = run.mcl().floorShares();
      ASSERT_LT(std::max(shares[0], shares[1]), kNearlyAll) << "update " << i << " of run " << seed;
      ASSERT_NEAR(shares[0] + shares[1], 1.0, 1e-9);
    }
    if (ofSamples > kNearlyAll) ++runsThatLeft;
  }
  EXPECT_GE(runsThatLeft, 2) << "or nothing was shown";
}

}  // namespace
}  // namespace ortung
