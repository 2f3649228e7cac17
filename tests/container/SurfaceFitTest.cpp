// How far what is known of surfaces blurs the pose that a scan fits to them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <random>
#include <vector>

#include "FakeRoom.hpp"
#include "SurfaceFit.hpp"
#include "SurfaceRay.hpp"
#include "ortung/base/InstructionSet.hpp"

namespace ortung {
namespace {

constexpr double kSigma = 0.015;  // of the surfaces [m]
constexpr int kBeams = 181;       // of a scan

constexpr double kCell = 0.05;  // of their field [m]

/// The surfaces of a room of 4 x 4 m. @param mark marks the ends of beams in a field
template <class Mark>
std::shared_ptr<const SurfaceField> surfacesOf(double surfaceSigma, const Mark& mark) {
  FieldRegion region = test::Room{4, 4}.region(0.1, 0.2);
  region.surfaceSigma = surfaceSigma;
  auto field = std::make_shared<SurfaceField>();
  field->start(region, kCell, 0.1);
  mark(*field);
  field->finish();
  return field;
}

/// Walls at some x.
std::shared_ptr<const SurfaceField> walls(double surfaceSigma, std::initializer_list<double> all) {
  return surfacesOf(surfaceSigma, [&](SurfaceField& field) {
    for (double y = -1.9; y <= 1.9; y += 0.003)
      for (const double x : all) field.mark(x, y);
  });
}

/// The wall x = 1, of which the world says no more than to 15 mm.
std::shared_ptr<const SurfaceField> wall() { return walls(kSigma, {1.0}); }

/// A scan of the wall x = 1 from the origin.
void addScan(SurfaceFit& fit, double sigma, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, sigma);
  for (int k = 0; k < kBeams; ++k) {
    const double bearing = (k - kBeams / 2) * 0.008;
    fit.add(1.0 / std::cos(bearing) + noise(random), bearing);
  }
}

/// The x at which steps from @p x on end, for a robot that looks along x.
double settled(const SurfaceFit& fit, double x) {
  for (int step = 0; step < 20; ++step) {
    const Slope slope = fit.slopeAt({x, 0.0, 0.0});
    EXPECT_GT(slope.information[0], 0.0);
    x += slope.pull[0] / slope.information[0];
  }
  return x;
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
  const auto field = surfacesOf(0.0, [](SurfaceField& spot) {
    for (double angle = 0.0; angle < 6.28; angle += 0.05)
      spot.mark(kX + 0.01 * std::cos(angle), kY + 0.01 * std::sin(angle));
  });
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
  constexpr double kNoise = 0.04;
  constexpr double kRobotsMap = 0.025;  // of cells of 0.05 m, and 0.02 m by which it is off [m]
  for (const double surfaceSigma : {0.0, kRobotsMap}) {
    std::mt19937 random(4);
    SurfaceFit fit(walls(surfaceSigma, {1.0, 1.15}), Pose2{}, SensorModel{.sigma = kNoise});
    addScan(fit, kNoise, random);
    for (const double start : {0.0, 0.07, 0.15, -0.15})
      EXPECT_NEAR(settled(fit, start), 0.0, 4.0 * kNoise / std::sqrt(kBeams))
          << "from " << start << " with surfaces of " << surfaceSigma;
  }
}

/// A wall as robots' maps have it, each cell of it in one of the two rows around x = 1.
std::shared_ptr<const SurfaceField> roughWall(std::mt19937& random) {
  std::uniform_int_distribution<int> row(0, 1);
  return surfacesOf(0.025, [&](SurfaceField& field) {
    for (double y = -1.9; y <= 1.9; y += kCell) {
      const double x = 1.0 + (row(random) - 0.5) * kCell;
      for (double side = 0.0; side < kCell; side += 0.003) field.mark(x, y + side);
    }
  });
}

// The wall is as probably in the row behind as in the one before. If beams showed the first row
// that they cross, poses would be too far from the wall, here by 6 mm.
TEST(SurfaceFit, AWallInTwoRowsOfCellsIsBetweenThem) {
  constexpr int kWalls = 40;
  std::mt19937 random(7);
  double sum = 0.0;
  for (int wall = 0; wall < kWalls; ++wall) {
    SurfaceFit fit(roughWall(random), Pose2{}, SensorModel{.sigma = 0.05});
    addScan(fit, 0.02, random);
    sum += settled(fit, 0.0);
  }
  EXPECT_NEAR(sum / kWalls, 0.0, 0.004);
}

struct Residual {
  double off;  ///< [m]
  double sigma;
  Pose2 by;      ///< derivatives of the expectation
  bool follows;  ///< that of the beam before
};

/// What residuals say of the pose, by the formulas in double precision.
Slope naiveSlopeOf(const std::vector<Residual>& residuals, double outliers) {
  const auto share = [&](const Residual& r, double variance) {
    const double sigmas = r.off / r.sigma / std::sqrt(variance);
    const double inlier = (1.0 - outliers) * std::exp(-0.5 * sigmas * sigmas);
    return inlier / (inlier + outliers);
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
    slope.add(r.off, {r.by.x, r.by.y, r.by.theta},
              share(r, variance) / (r.sigma * r.sigma * variance));
    if (!r.follows) continue;
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

struct SeenBeam {
  double range;
  double bearing;
};

/// The surface that a beam from @p at shows: walked back from its end, the first one that it
/// crosses well before those behind it, else that at its end.
const Surface* naivelyShown(const SurfaceField& field, const Pose2& at, double range) {
  const double cell = field.grid().cell;
  const double c = std::cos(at.theta);
  const double s = std::sin(at.theta);
  const Surface* shown = field.near(at.x + range * c, at.y + range * s);
  if (shown == nullptr) return nullptr;
  for (const double back : {2 * cell, 4 * cell, 6 * cell}) {
    if (range <= back) break;
    const Surface* other = field.near(at.x + (range - back) * c, at.y + (range - back) * s);
    if (other == nullptr) break;
    const double nx = static_cast<double>(other->normalX);
    const double ny = static_cast<double>(other->normalY);
    const double slant = nx * c + ny * s;
    if (other->along >= 0.0F || std::abs(slant) < 0.2) continue;
    const double dx = static_cast<double>(other->x) - at.x;
    const double dy = static_cast<double>(other->y) - at.y;
    const double crossed = (nx * dx + ny * dy) / slant;
    const double behind = nx * static_cast<double>(shown->x - other->x) +
                          ny * static_cast<double>(shown->y - other->y);
    const bool isApart = std::copysign(behind, behind * slant) >
                         2.5 * static_cast<double>(std::hypot(shown->across, other->across));
    if (isApart && crossed < range && std::hypot(crossed * c - dx, crossed * s - dy) < cell)
      shown = other;
  }
  return shown;
}

/// The residuals of beams from @p robot, on which the sensor is mounted, one beam after another.
std::vector<Residual> naiveResiduals(const SurfaceField& field, const std::vector<SeenBeam>& beams,
                                     const Pose2& mount, const SensorModel& model,
                                     const Pose2& robot) {
  std::vector<Residual> residuals;
  const Pose2 sensor = robot * mount;
  bool follows = false;
  for (const auto& [range, bearing] : beams) {
    const double angle = sensor.theta + bearing;
    const Surface* surface = naivelyShown(field, {sensor.x, sensor.y, angle}, range);
    if (surface == nullptr) {
      follows = false;
      continue;
    }
    const double dx = sensor.x + range * std::cos(angle) - robot.x;
    const double dy = sensor.y + range * std::sin(angle) - robot.y;
    const double offX = static_cast<double>(surface->x) - robot.x - dx;
    const double offY = static_cast<double>(surface->y) - robot.y - dy;
    const auto add = [&](double nx, double ny, double sigma, double ofEnd, bool isNext) {
      residuals.push_back(
          {nx * offX + ny * offY, std::hypot(sigma, ofEnd), {nx, ny, ny * dx - nx * dy}, isNext});
    };
    const auto nx = static_cast<double>(surface->normalX);
    const auto ny = static_cast<double>(surface->normalY);
    const auto across = static_cast<double>(surface->across);
    const double sigma = model.sigmaAt(range);
    const bool isLine = surface->along < 0.0F;
    const double slant = std::max(0.15, std::abs(nx * std::cos(angle) + ny * std::sin(angle)));
    add(nx, ny, isLine ? sigma * slant : sigma, across, isLine && follows);
    if (!isLine) add(-ny, nx, sigma, static_cast<double>(surface->along), false);
    follows = isLine;
  }
  return residuals;
}

/// @returns the slope by any instruction set, all of which give the same bits
Slope slopeByAll(const SurfaceFit& fit, const Pose2& robot) {
  std::optional<Slope> first;
  for (const InstructionSet set : {InstructionSet::kPortable, InstructionSet::kAvx2,
                                   InstructionSet::kAvx512, InstructionSet::kNeon}) {
    if (!hasInstructionSet(set)) continue;
    useInstructionSet(set);
    const Slope slope = fit.slopeAt(robot);
    useInstructionSet(std::nullopt);
    if (!first) first = slope;
    EXPECT_EQ(slope.information, first->information);
    EXPECT_EQ(slope.pull, first->pull);
  }
  return *first;
}

/// Shares of inliers are in single precision. @param reach greatest distance of an end [m]
void expectNear(const Slope& slope, const Slope& naive, double reach) {
  const std::array<double, 3> unit = {1.0, 1.0, reach};
  const double information = 1e-4 * std::max(naive.information[0], naive.information[4]);
  for (std::size_t row = 0; row < 3; ++row) {
    EXPECT_NEAR(slope.pull[row], naive.pull[row], 0.03 * information * unit[row]) << row;
    for (std::size_t column = 0; column < 3; ++column)
      EXPECT_NEAR(slope.information[3 * row + column], naive.information[3 * row + column],
                  information * unit[row] * unit[column])
          << row << ", " << column;
  }
}

/// A hall with a thin wall in it, and posts that are no lines.
std::shared_ptr<const SurfaceField> hall() {
  auto field = std::make_shared<SurfaceField>();
  field->start(test::Room{12, 8}.region(0.1, 0.2), 0.05, 0.1);
  for (double y = -4.0; y <= 4.0; y += 0.003)
    for (const double x : {-6.0, 6.0}) field->mark(x, y);
  for (double x = -6.0; x <= 6.0; x += 0.003)
    for (const double y : {-4.0, 4.0}) field->mark(x, y);
  for (double y = -4.0; y <= 1.0; y += 0.003)
    for (const double x : {1.0, 1.15}) field->mark(x, y);
  for (double angle = 0.0; angle < 6.28; angle += 0.05)
    for (const double x : {-3.525, 3.525})
      field->mark(x + 0.02 * std::cos(angle), 0.525 + 0.02 * std::sin(angle));
  field->finish();
  return field;
}

// Beams end at surfaces, before them, and where nothing is; there are more of them than one loop
// does at a time, and none or nearly none, too.
TEST(SurfaceFit, IsThatOfTheFormulasBeamByBeam) {
  const SensorModel model{.sigma = 0.03, .sigmaPerMetre = 0.01, .outliers = 0.1};
  const Pose2 mount{0.1, -0.05, 0.2};
  const auto field = hall();
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::size_t crossed = 0;
  std::size_t spots = 0;
  for (const int count : {0, 1, 7, 64, 65, 130, 361}) {
    for (int repeat = 0; repeat < 8; ++repeat) {
      const Pose2 robot{3.0 * any(random), 2.0 * any(random), 3.0 * any(random)};
      const Pose2 sensor = robot * mount;
      SurfaceFit fit(field, mount, model);
      std::vector<SeenBeam> beams;
      for (int k = 0; k < count; ++k) {
        const double bearing = 6.28 * k / count - 3.14;
        const double met = rangeAlong(*field, sensor * Pose2{0.0, 0.0, bearing}, 20.0);
        const double range = std::max(0.0, k % 17 == 5 ? 0.5 * met : met + 0.15 * any(random));
        beams.push_back({range, bearing});
        fit.add(range, bearing);
        const Pose2 beam{sensor.x, sensor.y, sensor.theta + bearing};
        const Surface* shown = naivelyShown(*field, beam, range);
        const Surface* atEnd = field->near(sensor.x + range * std::cos(beam.theta),
                                           sensor.y + range * std::sin(beam.theta));
        crossed += shown != atEnd;
        spots += shown != nullptr && shown->along >= 0.0F;
      }
      const Pose2 near{robot.x + 0.05 * any(random), robot.y + 0.05 * any(random),
                       robot.theta + 0.02 * any(random)};
      const auto residuals = naiveResiduals(*field, beams, mount, model, near);
      SCOPED_TRACE(testing::Message() << count << " beams, " << residuals.size() << " residuals");
      expectNear(slopeByAll(fit, near), naiveSlopeOf(residuals, model.outliers), 15.0);
    }
  }
  EXPECT_GT(crossed, 100u);
  EXPECT_GT(spots, 30u);
}

TEST(SurfaceFit, OfNothingSaysNothing) {
  EXPECT_EQ(SurfaceFit(wall(), Pose2{}, SensorModel{}).slopeAt({}).blurMetres, 0.0);
}

}  // namespace
}  // namespace ortung
