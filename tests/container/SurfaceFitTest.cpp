// How far what is known of surfaces blurs the pose that a scan fits to them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "FakeRoom.hpp"
#include "SurfaceFit.hpp"
#include "ortung/base/InstructionSet.hpp"

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

/// What the ends of beams from @p robot say of the wall, by the formulas in double precision.
Slope naiveSlopeOf(const std::vector<std::pair<double, double>>& beams, const Pose2& robot,
                   const SensorModel& model) {
  struct Residual {
    double off, sigma, lever;
  };
  std::vector<Residual> residuals;
  for (const auto& [range, bearing] : beams) {
    const double dx = range * std::cos(robot.theta + bearing);
    const double dy = range * std::sin(robot.theta + bearing);
    const double slant = std::max(0.15, std::abs(dx) / range);
    const double across = std::hypot(0.0005, kSigma);
    residuals.push_back(
        {1.0 - robot.x - dx, std::hypot(model.sigmaAt(range) * slant, across), -dy});
  }
  const auto share = [&](const Residual& r, double variance) {
    const double sigmas = r.off / r.sigma / std::sqrt(variance);
    const double inlier = (1.0 - model.outliers) * std::exp(-0.5 * sigmas * sigmas);
    return inlier / (inlier + model.outliers);
  };
  double variance = 1.0;
  for (int k = 0; k < 4; ++k) {
    double count = 10.0;
    double squares = 10.0 * variance;
    for (const Residual& r : residuals) {
      count += share(r, variance);
      squares += share(r, variance) * std::pow(r.off / r.sigma, 2);
    }
    variance = std::clamp(squares / count, 0.01, 1.0);
  }
  Slope slope;
  double products = 0.0;
  double pairs = 1e-9;
  for (std::size_t k = 0; k < residuals.size(); ++k) {
    const Residual& r = residuals[k];
    slope.add(r.off, {1.0, 0.0, r.lever}, share(r, variance) / (r.sigma * r.sigma * variance));
    if (k == 0) continue;
    const Residual& before = residuals[k - 1];
    const double both = std::min(share(r, variance), share(before, variance));
    const double a = r.off / r.sigma;
    const double b = before.off / before.sigma;
    products += both * a * b;
    pairs += 0.5 * both * (a * a + b * b);
  }
  const double alike = std::clamp(products / pairs, 0.0, 0.95);
  Slope worth;
  worth.add(slope, (1.0 - alike) / (1.0 + alike));
  return worth;
}

TEST(SurfaceFit, WeighsResidualsByTheFormulasWithAnyInstructionSet) {
  const SensorModel model{.sigma = 0.03, .sigmaPerMetre = 0.01, .outliers = 0.1};
  const auto field = wall();
  SurfaceFit fit(field, Pose2{}, model);
  std::vector<std::pair<double, double>> beams;
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 0.03);
  for (int k = -50; k <= 50; ++k) {
    const double bearing = 0.02 * k;
    const double outlier = k % 10 == 3 ? 0.15 : 0.0;
    beams.emplace_back(1.0 / std::cos(bearing) + noise(random) + outlier, bearing);
    fit.add(beams.back().first, bearing);
  }
  const Pose2 robot{-0.02, 0.01, 0.01};
  const Slope naive = naiveSlopeOf(beams, robot, model);
  std::optional<Slope> first;
  for (const InstructionSet set :
       {InstructionSet::kPortable, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    if (!hasInstructionSet(set)) continue;
    useInstructionSet(set);
    const Slope slope = fit.slopeAt(robot);
    useInstructionSet(std::nullopt);
    // Its shares of inliers are in single precision.
    for (std::size_t k = 0; k < 9; ++k)
      EXPECT_NEAR(slope.information[k], naive.information[k], 1e-4 * naive.information[0]) << k;
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(slope.pull[k], naive.pull[k], 1e-4 * std::abs(naive.pull[0])) << k;
    if (!first) first = slope;
    EXPECT_EQ(slope.information, first->information);
    EXPECT_EQ(slope.pull, first->pull);
  }
}

TEST(SurfaceFit, OfNothingSaysNothing) {
  EXPECT_EQ(SurfaceFit(wall(), Pose2{}, SensorModel{}).slopeAt({}).blurMetres, 0.0);
}

}  // namespace
}  // namespace ortung
