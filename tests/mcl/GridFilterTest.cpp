// The grid filter beside the belief by quadrature, and by itself.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "VagueRoom.hpp"
#include "ortung/mcl/GridFilter.hpp"

namespace ortung {
namespace {

using test::kPi;
using test::McLocalizer;
using test::Quadrature;
using test::Reading;
using test::VagueDrive;
using test::VagueRobot;

/// The filter in the room of two posts.
struct Grid {
  explicit Grid(const GridConfig& config = {.cell = 0.05, .headingStep = 5.0 * kPi / 180.0})
      : filter(VagueRobot::config(), config, robot.region,
               std::make_unique<OdometryMotion>(test::kNoise)) {}
  void step(double way, const Reading& reading) {
    robot.read(way, reading);
    ASSERT_TRUE(filter.update(robot.container));
  }
  VagueRobot robot;
  GridFilter filter;
};

// The same cells; what is different is the motion: here by mean and covariance of samples, there
// the whole integral.
TEST(GridFilter, AgreesWithQuadrature) {
  Quadrature quadrature;
  Grid grid;
  VagueDrive drive;
  for (const double way : {0.0, 0.5, 0.4, 0.3}) {
    const Reading reading = drive.after(way);
    if (way > 0.0) quadrature.predict(way);
    quadrature.correct(reading);
    grid.step(way, reading);
    const PoseEstimate expected = quadrature.moments();
    const PoseEstimate& found = grid.filter.estimate();
    const double sigma[3] = {std::sqrt(expected.covariance[0]), std::sqrt(expected.covariance[4]),
                             std::sqrt(expected.covariance[8])};
    EXPECT_NEAR(found.pose.x, expected.pose.x, 0.05 * sigma[0]) << "way " << way;
    EXPECT_NEAR(found.pose.y, expected.pose.y, 0.05 * sigma[1]) << "way " << way;
    EXPECT_NEAR(wrapAngle(found.pose.theta - expected.pose.theta), 0.0, 0.05 * sigma[2]) << way;
    for (std::size_t i = 0; i < 9; ++i)
      EXPECT_NEAR(found.covariance[i], expected.covariance[i], 0.06 * sigma[i / 3] * sigma[i % 3])
          << "way " << way << ", entry " << i;
    EXPECT_LT(quadrature.divergenceOf(grid.filter.cells()), 0.02) << "way " << way;
  }
}

TEST(GridFilter, IsComeNearerByMclWithMoreSamples) {
  Grid grid;
  McLocalizer few(500);
  McLocalizer many(10000);
  VagueDrive drive;
  for (const double way : {0.0, 0.5, 0.4}) {
    const Reading reading = drive.after(way);
    grid.step(way, reading);
    few.step(way, reading);
    many.step(way, reading);
    const double ofFew = grid.filter.divergenceOf(few.mcl->samples());
    const double ofMany = grid.filter.divergenceOf(many.mcl->samples());
    RecordProperty("way " + std::to_string(way),
                   std::to_string(ofFew) + " " + std::to_string(ofMany));
    EXPECT_LT(ofMany, 0.3 * ofFew) << way;
    EXPECT_LT(ofMany, 0.25) << way;  // some hundred bins of 0.25 m and 10 degrees
  }
  EXPECT_NEAR(grid.filter.divergenceOf(grid.filter.cells()), 0.0, 0.05);  // cells are no bins
}

// A turn of 90 degrees, then 1 m: with no noise to speak of the belief goes there and stays as
// narrow as it was, in however many pieces.
TEST(GridFilter, MovesWithoutBlurring) {
  const FieldRegion region = test::kRoom.region(0.025, 0.0);
  SensorContainer container;  // nothing is seen
  container.add(std::make_unique<OdometryData>(SensorId{"base", "odometry", "pose"}));
  Timestamp stamp = 0;
  const OdometryNoise none{.turnPerTurn = 0.0,
                           .turnPerMetre = 0.0,
                           .wayPerMetre = 0.0,
                           .wayPerTurn = 0.0,
                           .floorMetres = 1e-6,
                           .floorRadians = 1e-6};
  GridFilter filter(VagueRobot::config(), {.cell = 0.1}, region,
                    std::make_unique<OdometryMotion>(none));
  filter.startAt({-0.5, 0.2, 0.0}, 0.1, 0.05);
  const auto tell = [&](const Pose2& odometry) {
    stamp += 100'000;
    container.set(
        Message{stamp, {"base", "odometry", "pose"}, OdometryData::encode({odometry, 0, 0, {}})});
    EXPECT_FALSE(filter.update(container));
  };
  const auto spread = [&] {
    double x = 0.0, y = 0.0, xx = 0.0, yy = 0.0;
    const SampleSet cells = filter.cells();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const double p = std::exp(static_cast<double>(cells.logWeight[i]));
      x += p * static_cast<double>(cells.x[i]);
      y += p * static_cast<double>(cells.y[i]);
      xx += p * std::pow(static_cast<double>(cells.x[i]), 2);
      yy += p * std::pow(static_cast<double>(cells.y[i]), 2);
    }
    return std::array<double, 4>{x, y, xx - x * x, yy - y * y};
  };
  tell({});
  const auto before = spread();
  for (int i = 1; i <= 15; ++i) tell({0, 0, i * kPi / 30});
  for (int i = 1; i <= 5; ++i) tell({0, i / 5.0, kPi / 2});
  const auto after = spread();
  EXPECT_NEAR(before[0], -0.5, 1e-3);
  EXPECT_NEAR(after[0], -0.5, 0.01);
  EXPECT_NEAR(after[1], 1.2, 0.01);
  EXPECT_NEAR(after[3], before[3], 0.1 * before[3]);                // along the way
  EXPECT_NEAR(after[2], before[2] + 0.05 * 0.05, 0.1 * before[2]);  // heading's sigma after 1 m
}

// Odometry that jumps off the map by kilometres, with noise to match, leaves no belief there; what
// comes then is taken as well as can be, and ends.
TEST(GridFilter, SurvivesOdometryThatLeavesTheMap) {
  Grid grid({.cell = 0.2, .headingStep = 0.3});
  VagueDrive drive;
  grid.step(0.0, drive.after(0.0));
  grid.step(4e6, drive.after(0.0));
  EXPECT_EQ(grid.filter.cells().size(), 0U);
  EXPECT_TRUE(isFinite(grid.filter.estimate().pose));
  EXPECT_EQ(grid.filter.estimate().status, TrackStatus::kLost);
  grid.step(-4e6, drive.after(0.0));
  EXPECT_TRUE(grid.filter.estimate(grid.robot.stamp).has_value());
  EXPECT_GT(grid.filter.divergenceOf(McLocalizer(100).mcl->samples()), 0.0);
  grid.filter.startGlobal();
  grid.step(0.1, drive.after(0.0));
  EXPECT_GT(grid.filter.cells().size(), 0U);
}

TEST(GridFilter, RefusesWhatDoesNotFitIntoMemory) {
  VagueRobot robot;
  const auto make = [&](const GridConfig& config) {
    return GridFilter(VagueRobot::config(), config, robot.region,
                      std::make_unique<OdometryMotion>(test::kNoise));
  };
  try {
    make({.cell = 0.01, .headingStep = 0.002});
    FAIL() << "400 x 300 x 3142 poses take 24 GB";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("a grid of 377040000 poses"), std::string::npos)
        << error.what();
  }
}

TEST(GridConfig, LetsAllThroughThatItsMessagesNameAndNothingElse) {
  const auto refusal = [](const GridConfig& config) -> std::string {
    try {
      config.check();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal({}), "");
  for (const double cell : {0.01, 1.0, 10.0}) EXPECT_EQ(refusal({.cell = cell}), "") << cell;
  for (const double cell : {0.0, 0.00999, 10.001, -1.0, HUGE_VAL, std::nan("")})
    EXPECT_NE(refusal({.cell = cell}).find("must be in [0.01, 10] m"), std::string::npos) << cell;
  for (const double step : {0.001, 1.0, kPi / 2.0})
    EXPECT_EQ(refusal({.headingStep = step}), "") << step;
  for (const double step : {0.0, 0.000999, 1.571, -0.1, HUGE_VAL, std::nan("")})
    EXPECT_NE(refusal({.headingStep = step}).find("must be in [0.001, a quarter of a turn] rad"),
              std::string::npos)
        << step;
}

}  // namespace
}  // namespace ortung
