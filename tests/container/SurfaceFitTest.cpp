// How far what is known of surfaces blurs the pose that a scan fits to them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "FakeRoom.hpp"
#include "SurfaceFit.hpp"

namespace ortung {
namespace {

constexpr double kSigma = 0.015;  // of the surfaces [m]

/// The wall x = 1, of which the world says no more than to 15 mm.
std::shared_ptr<const SurfaceField> wall() {
  FieldRegion region = test::Room{4, 4}.region(0.1, 0.2);
  region.surfaceSigma = kSigma;
  auto field = std::make_shared<SurfaceField>();
  field->start(region, 0.05, 0.1);
  for (double y = -1.9; y <= 1.9; y += 0.003) field->mark(1.0, y);
  field->finish();
  return field;
}

/// A scan from the origin of two places of the wall, @p off to the left and to the right.
SurfaceFit seen(double off) {
  SurfaceFit fit(wall(), Pose2{}, SensorModel{.sigma = 0.02});
  for (const double y : {-off, off}) fit.add(std::hypot(1.0, y), std::atan2(y, 1.0));
  return fit;
}

// A turn by t moves what is seen of a wall by t times how far to the side it is.
TEST(SurfaceFit, IsBlurredByTheWallAtTheEndOfItsLever) {
  for (const double off : {1.5, 1.0, 0.5, 0.1}) {
    const Slope slope = seen(off).slopeAt({});
    EXPECT_EQ(slope.blurMetres, kSigma);
    EXPECT_NEAR(slope.blurRadians, kSigma / off, 0.02 * kSigma / off) << off;
  }
  EXPECT_EQ(seen(0.001).slopeAt({}).blurRadians, 1.0) << "straight ahead it tells no heading";
}

// A spot is as sharp in all directions, so it tells of both coordinates alike, and of a turn by its
// distance.
TEST(SurfaceFit, OfASpotTellsBothCoordinatesAndTheHeading) {
  constexpr double kX = 1.025, kY = 0.325;  // in the middle of a cell
  const FieldRegion region = test::Room{4, 4}.region(0.1, 0.2);
  auto field = std::make_shared<SurfaceField>();
  field->start(region, 0.05, 0.1);
  for (double angle = 0.0; angle < 6.28; angle += 0.05)
    field->mark(kX + 0.01 * std::cos(angle), kY + 0.01 * std::sin(angle));
  field->finish();
  SurfaceFit fit(field, Pose2{}, SensorModel{.sigma = 0.02});
  fit.add(std::hypot(kX, kY), std::atan2(kY, kX));
  const auto i = fit.slopeAt({}).information;
  ASSERT_GT(i[0], 0.0);
  EXPECT_NEAR(i[4] / i[0], 1.0, 0.02);
  EXPECT_NEAR(i[1] / i[0], 0.0, 0.02);
  EXPECT_NEAR(i[8] / i[0], kX * kX + kY * kY, 0.02);
}

TEST(SurfaceFit, SaysNothingOfAHeadingWhereNoSurfaceIsNear) {
  const Slope slope = seen(1.0).slopeAt({-1.0, 0.0, 0.0});
  EXPECT_EQ(slope.blurRadians, 0.0);
  for (const double value : slope.information) EXPECT_EQ(value, 0.0);
}

// Noise moves ends to the far side of a thin wall, and a pose that is off by its thickness moves
// all of them there. No beam gets there, so the wall's near side is what they show.
TEST(SurfaceFit, NoBeamShowsTheFarSideOfAWall) {
  constexpr double kNear = 1.0, kFar = 1.15, kNoise = 0.04;
  const FieldRegion region = test::Room{4, 4}.region(0.1, 0.2);
  auto field = std::make_shared<SurfaceField>();
  field->start(region, 0.05, 0.1);
  for (double y = -1.9; y <= 1.9; y += 0.003)
    for (const double x : {kNear, kFar}) field->mark(x, y);
  field->finish();
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0.0, kNoise);
  SurfaceFit fit(field, Pose2{}, SensorModel{.sigma = kNoise});
  constexpr int kBeams = 181;
  for (int k = 0; k < kBeams; ++k) {
    const double bearing = (k - kBeams / 2) * 0.008;
    fit.add(kNear / std::cos(bearing) + noise(random), bearing);
  }
  for (const double start : {0.0, 0.07, 0.15, -0.15}) {
    double x = start;
    for (int step = 0; step < 20; ++step) {
      const Slope slope = fit.slopeAt({x, 0.0, 0.0});
      ASSERT_GT(slope.information[0], 0.0);
      x += slope.pull[0] / slope.information[0];
    }
    EXPECT_NEAR(x, 0.0, 4.0 * kNoise / std::sqrt(kBeams)) << "from " << start;
  }
}

TEST(SurfaceFit, OfNothingSaysNothing) {
  EXPECT_EQ(SurfaceFit(wall(), Pose2{}, SensorModel{}).slopeAt({}).blurMetres, 0.0);
}

}  // namespace
}  // namespace ortung
