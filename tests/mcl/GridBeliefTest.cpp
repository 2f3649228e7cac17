// Motion and noise of a belief on a grid, against the moments that they have by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "GridBelief.hpp"

namespace ortung {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kCell = 0.1;  // [m]
constexpr int kTurns = 72;     // of 5 degrees
constexpr double kStep = 2.0 * kPi / kTurns;

GridBelief belief(int columns = 80, int rows = 60) {
  return {{.originX = -1.0, .originY = 2.0, .cell = kCell, .columns = columns, .rows = rows},
          kCell,
          kTurns};
}

/// Puts all into the cell that has this pose.
void concentrate(GridBelief& belief, const Pose2& pose) {
  ASSERT_TRUE(belief.fill([&](const Pose2& centre) {
    return std::abs(centre.x - pose.x) < 0.5 * kCell && std::abs(centre.y - pose.y) < 0.5 * kCell &&
                   std::abs(wrapAngle(centre.theta - pose.theta)) < 0.5 * kStep
               ? 1.0
               : 0.0;
  }));
  ASSERT_EQ(belief.samples().size(), 1U);
}

struct Moments {
  explicit Moments(const GridBelief& belief, double aroundHeading) {
    std::array<double, 3> mean{};
    belief.forEach([&](const Pose2& cell, double share) {
      const std::array<double, 3> l{cell.x, cell.y, wrapAngle(cell.theta - aroundHeading)};
      for (std::size_t i = 0; i < 3; ++i) mean[i] += share * l[i];
      sum += share;
    });
    belief.forEach([&](const Pose2& cell, double share) {
      const std::array<double, 3> l{cell.x, cell.y, wrapAngle(cell.theta - aroundHeading)};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
          covariance[3 * i + k] += share * (l[i] - mean[i]) * (l[k] - mean[k]);
    });
    pose = {mean[0], mean[1], wrapAngle(mean[2] + aroundHeading)};
  }
  double sum = 0.0;
  Pose2 pose;
  PoseCovariance covariance{};
};

/// The covariance of noise in the robot's frame, in the field's.
PoseCovariance turned(const PoseCovariance& inRobot, double heading) {
  const double c = std::cos(heading);
  const double s = std::sin(heading);
  const double turn[3][3] = {{c, -s, 0}, {s, c, 0}, {0, 0, 1}};
  PoseCovariance inField{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
          inField[3 * row + column] += turn[row][i] * inRobot[3 * i + k] * turn[column][k];
  return inField;
}

/// The middle of a cell, as far from the edges as any, with the heading of a layer.
Pose2 middle(int layer) { return {3.05, 5.05, wrapAngle((layer + 0.5) * kStep)}; }

// Variances of a small part of a cell, of many cells, and along a slant.
TEST(GridBelief, NoiseInPositionHasItsCovarianceInTheFrameOfTheRobot) {
  const PoseCovariance all[] = {{0.001, 0, 0, 0, 0.0005, 0, 0, 0, 0},
                                {0.05, 0, 0, 0, 0.03, 0, 0, 0, 0},
                                {0.05, 0.01, 0, 0.01, 0.04, 0, 0, 0, 0},
                                {0.02, -0.008, 0, -0.008, 0.03, 0, 0, 0, 0}};
  for (const PoseCovariance& noise : all) {
    for (int layer = 0; layer < kTurns; layer += 5) {
      for (const double turn : {0.0, 0.7}) {
        GridBelief grid = belief();
        concentrate(grid, middle(layer));
        grid.blur(noise, turn);
        const Moments found(grid, middle(layer).theta);
        const PoseCovariance expected = turned(noise, middle(layer).theta - turn);
        EXPECT_NEAR(found.sum, 1.0, 1e-6);
        EXPECT_NEAR(found.pose.x, middle(layer).x, 1e-5);
        EXPECT_NEAR(found.pose.y, middle(layer).y, 1e-5);
        for (std::size_t i = 0; i < 9; ++i)
          EXPECT_NEAR(found.covariance[i], expected[i], 1e-3 * noise[0])
              << "layer " << layer << ", turn " << turn << ", entry " << i;
      }
    }
  }
}

// Errors of a heading that belong to errors of the place: whole cells ahead or aside for a step of
// the heading, so that nothing falls between two cells. Noise that comes after such a step is
// turned by it: 5 degrees mix 0.8 % of the variance along x with that along y.
TEST(GridBelief, NoiseOfHeadingAndPositionTogetherHasTheirCovariance) {
  const double ofTurn = 0.25 * kStep * kStep;
  for (const double ahead : {-1.0, 0.0, 1.0, 2.0}) {
    for (const double aside : {-2.0, 0.0, 1.0}) {
      const double alongX = ahead * kCell / kStep;
      const double alongY = aside * kCell / kStep;
      const double x = 0.2 * kCell * kCell;
      const double y = 0.1 * kCell * kCell;
      const PoseCovariance noise{x + alongX * alongX * ofTurn,
                                 alongX * alongY * ofTurn,
                                 alongX * ofTurn,
                                 alongX * alongY * ofTurn,
                                 y + alongY * alongY * ofTurn,
                                 alongY * ofTurn,
                                 alongX * ofTurn,
                                 alongY * ofTurn,
                                 ofTurn};
      GridBelief grid = belief();
      concentrate(grid, middle(20));
      grid.blur(noise, middle(20).theta);  // before that turn it looked along x
      const Moments found(grid, middle(20).theta);
      EXPECT_NEAR(found.sum, 1.0, 1e-6);
      EXPECT_NEAR(found.pose.x, middle(20).x, 1e-5);
      EXPECT_NEAR(found.pose.y, middle(20).y, 1e-5);
      EXPECT_NEAR(wrapAngle(found.pose.theta - middle(20).theta), 0.0, 1e-5);
      for (std::size_t i = 0; i < 9; ++i)
        EXPECT_NEAR(found.covariance[i], noise[i], 0.01 * (noise[0] + noise[4]))
            << ahead << " ahead, " << aside << " aside, entry " << i;
    }
  }
}

TEST(GridBelief, NoiseOfHeadingAloneMovesNothing) {
  for (const double sigma : {0.3 * kStep, 1.0 * kStep, 4.0 * kStep}) {
    GridBelief grid = belief();
    concentrate(grid, middle(70));  // where headings begin anew
    grid.blur({0, 0, 0, 0, 0, 0, 0, 0, sigma * sigma}, 0.0);
    const Moments found(grid, middle(70).theta);
    EXPECT_NEAR(found.covariance[8], sigma * sigma, 1e-3 * sigma * sigma);
    EXPECT_NEAR(wrapAngle(found.pose.theta - middle(70).theta), 0.0, 1e-5);
    for (const std::size_t i : {0U, 1U, 2U, 4U, 5U}) EXPECT_NEAR(found.covariance[i], 0.0, 1e-9);
  }
}

// Exactly, by whatever fractions of cells and headings, and back again.
TEST(GridBelief, MotionIsExactAndLosesOnlyWhatLeavesTheArea) {
  for (int layer = 0; layer < kTurns; layer += 7) {
    GridBelief grid = belief();
    concentrate(grid, middle(layer));
    Pose2 expected = middle(layer);
    const auto expectOne = [&] {
      const SampleSet set = grid.samples();
      ASSERT_EQ(set.size(), 1U);
      EXPECT_NEAR(set.x[0], expected.x, 1e-5);
      EXPECT_NEAR(set.y[0], expected.y, 1e-5);
      EXPECT_NEAR(wrapAngle(static_cast<double>(set.theta[0]) - expected.theta), 0.0, 1e-5);
      EXPECT_NEAR(set.logWeight[0], 0.0F, 1e-6F);
    };
    for (const Pose2& change : {Pose2{0.034, 0.0, 0.0}, Pose2{0.5, -0.21, 0.3},
                                Pose2{-0.77, 0.4, -1.9}, Pose2{0.0, 0.049, 3.0}}) {
      grid.move(change);
      expected = expected * change;
      expectOne();
    }
    grid.move({100.0, 0.0, 0.0});
    EXPECT_EQ(grid.samples().size(), 0U);
  }
}

// At the edges of the area and elsewhere.
TEST(GridBelief, WeighsEveryCellOnceWhereverTheSharesAre) {
  for (const int first : {0, 1, 30, 58, 59}) {
    for (const int count : {1, 2}) {
      GridBelief grid = belief(60, 60);
      const double left = -1.0 + first * kCell;
      const double low = 2.0 + first * kCell;
      const auto isIn = [&](double x, double y) {
        return x > left && x < left + count * kCell && y > low && y < low + count * kCell;
      };
      ASSERT_TRUE(grid.fill([&](const Pose2& pose) { return isIn(pose.x, pose.y) ? 1.0 : 0.0; }));
      const int inEach = std::min(count, 60 - first);
      const std::size_t cells = static_cast<std::size_t>(inEach * inEach * kTurns);
      for (int i = 0; i < 3; ++i) {
        grid.weigh([&](const SampleSet& set, std::vector<float>& out) {
          ASSERT_EQ(set.size(), cells);
          for (std::size_t k = 0; k < set.size(); ++k) {
            ASSERT_TRUE(isIn(set.x[k], set.y[k])) << set.x[k] << " " << set.y[k];
            out[k] = set.theta[k];  // p = e^theta
          }
        });
      }
      double sum = 0.0;
      double expected = 0.0;
      for (int k = 0; k < kTurns; ++k)
        expected += inEach * inEach * std::exp(3.0 * wrapAngle((k + 0.5) * kStep));
      grid.forEach([&](const Pose2& pose, double share) {
        EXPECT_NEAR(share, std::exp(3.0 * pose.theta) / expected, 1e-5);
        sum += share;
      });
      EXPECT_NEAR(sum, 1.0, 1e-5);
    }
  }
}

}  // namespace
}  // namespace ortung
