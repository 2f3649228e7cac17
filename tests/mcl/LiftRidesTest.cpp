// Samples that stand in a lift come to its stops at random.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "LiftRides.hpp"
#include "MotionTuning.hpp"

namespace ortung {
namespace {

constexpr double kSeconds = tuning::lifts::kSeconds;

struct Poses {
  std::vector<float> x, y, theta;
  Poses(std::size_t n, const Pose2& pose)
      : x(n, static_cast<float>(pose.x)),
        y(n, static_cast<float>(pose.y)),
        theta(n, static_cast<float>(pose.theta)) {}
  MovableSamples movable() { return {x, y, theta}; }
  std::size_t onFloor(const Building& building, std::size_t floor) const {
    std::size_t n = 0;
    for (const float at : x) n += building.floorAt(static_cast<double>(at)) == floor ? 1 : 0;
    return n;
  }
};

/// Four floors of 10 m by 10 m, 20 m apart, of which only half of the last can be stood on.
FieldRegion fourFloors() {
  FieldRegion region;
  region.grid = {0.0, 0.0, 1.0, 70, 10};
  region.open.assign(region.grid.size(), 1);
  region.standable.assign(region.grid.size(), 1);
  for (std::size_t i = 0; i < region.grid.size(); ++i)
    if (region.grid.centreX(i) > 60.0 && region.grid.centreY(i) > 5.0) region.standable[i] = 0;
  for (int i = 0; i < 4; ++i)
    region.building.floors.push_back(
        {"f" + std::to_string(i), 20.0 * i, 20.0 * i - 5.0, 20.0 * i + 15.0});
  return region;
}

/// The same with a lift that stops at the first three; it is turned on the third.
FieldRegion withLift() {
  FieldRegion region = fourFloors();
  region.building.lifts = {{"A", 1.0, {{0, {3, 3, 0}}, {1, {23, 3, 0}}, {2, {48, 8, 1.5}}}}};
  region.check();
  return region;
}

TEST(LiftRides, ComeToAllStopsAlike) {
  const FieldRegion region = withLift();
  constexpr std::size_t kMany = 30'000;
  Poses poses(kMany, {3.5, 3.0, 0.2});
  EXPECT_TRUE(LiftRides(region).ride(poses.movable(), 100.0 * kSeconds, Random(1, 2)));
  for (std::size_t floor = 0; floor < 3; ++floor)
    EXPECT_NEAR(static_cast<double>(poses.onFloor(region.building, floor)), kMany / 3.0, 400.0)
        << floor;
  EXPECT_EQ(poses.onFloor(region.building, 3), 0u);
}

TEST(LiftRides, AreAsProbableAsTheRobotHasStoodLong) {
  const FieldRegion region = withLift();
  constexpr std::size_t kMany = 30'000;
  // In one go or in many steps: the shares are those of a jump process.
  for (const int steps : {1, 10}) {
    Poses poses(kMany, {3, 3, 0});
    for (int i = 0; i < steps; ++i)
      LiftRides(region).ride(poses.movable(), 0.5 * kSeconds / steps,
                             Random(1, static_cast<std::uint64_t>(i)));
    const double stays = 1.0 / 3.0 + 2.0 / 3.0 * std::exp(-0.5);
    EXPECT_NEAR(static_cast<double>(poses.onFloor(region.building, 0)) / kMany, stays, 0.01);
  }
}

TEST(LiftRides, KeepThePlaceInTheCabin) {
  const FieldRegion region = withLift();
  Poses poses(100, {3.5, 3.0, 0.2});
  LiftRides(region).ride(poses.movable(), 100.0 * kSeconds, Random(1, 2));
  bool isAny = false;
  for (std::size_t i = 0; i < 100; ++i) {
    if (region.building.floorAt(static_cast<double>(poses.x[i])) != 2) continue;
    isAny = true;
    EXPECT_NEAR(poses.x[i], 48.0 + 0.5 * std::cos(1.5), 1e-4);
    EXPECT_NEAR(poses.y[i], 8.0 + 0.5 * std::sin(1.5), 1e-4);
    EXPECT_NEAR(poses.theta[i], 1.7, 1e-5);
  }
  EXPECT_TRUE(isAny);
}

TEST(LiftRides, NobodyRidesOutsideOfALiftOrInNoTime) {
  const FieldRegion region = withLift();
  const LiftRides rides(region);
  Poses outside(1000, {5.0, 3.0, 0.0});
  EXPECT_FALSE(rides.isInLift(5.0, 3.0));
  EXPECT_FALSE(rides.ride(outside.movable(), 1e9, Random(1, 2)));
  EXPECT_EQ(outside.onFloor(region.building, 0), 1000u);
  Poses inside(1000, {3.0, 3.9, 0.0});
  EXPECT_TRUE(rides.isInLift(3.0, 3.9));
  EXPECT_FALSE(rides.ride(inside.movable(), 0.0, Random(1, 2)));
}

TEST(LiftRides, MayBeAnywhereIfNobodyHasToldOfLifts) {
  const FieldRegion region = fourFloors();
  const LiftRides rides(region);
  EXPECT_TRUE(rides.isInLift(5.0, 3.0));
  constexpr std::size_t kMany = 10'000;
  Poses poses(kMany, {5.5, 3.5, 0.2});
  EXPECT_TRUE(rides.ride(poses.movable(), 100.0 * kSeconds, Random(1, 2)));
  for (std::size_t floor = 0; floor < 4; ++floor)
    EXPECT_NEAR(static_cast<double>(poses.onFloor(region.building, floor)), kMany / 4.0, 250.0)
        << floor;
  for (std::size_t i = 0; i < kMany; ++i) {
    EXPECT_NEAR(std::fmod(poses.x[i], 20.0F), 5.5F, 1e-4);
    EXPECT_EQ(poses.y[i], 3.5F);
  }
  Poses where(kMany, {5.5, 7.5, 0.2});
  rides.ride(where.movable(), 100.0 * kSeconds, Random(1, 2));
  EXPECT_EQ(where.onFloor(region.building, 3), 0u) << "there is no room on the last floor";
}

TEST(LiftRides, AFieldOfOneFloorHasNone) {
  FieldRegion region = fourFloors();
  EXPECT_FALSE(LiftRides(region).isEmpty());
  region.building.floors.resize(1);
  EXPECT_TRUE(LiftRides(region).isEmpty());
  region.building = {};
  EXPECT_TRUE(LiftRides(region).isEmpty());
}

}  // namespace
}  // namespace ortung
