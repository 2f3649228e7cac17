#include <gtest/gtest.h>

#include <numbers>

#include "ortung/base/Random.hpp"
#include "ortung/base/StraightPieces.hpp"

namespace ortung {
namespace {

/// Points every 5 cm along the sides of a polygon, with noise across all directions.
std::vector<PlanePoint> outlineOf(const std::vector<PlanePoint>& corners, double noise,
                                  Random& random) {
  std::vector<PlanePoint> points;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const PlanePoint& a = corners[i];
    const PlanePoint& b = corners[i + 1];
    const auto steps = static_cast<int>(distance(a, b) / 0.05);
    for (int k = 0; k < steps; ++k) {
      const double share = static_cast<double>(k) / steps;
      points.push_back({a.x + share * (b.x - a.x) + noise * random.gaussian(),
                        a.y + share * (b.y - a.y) + noise * random.gaussian()});
    }
  }
  return points;
}

TEST(StraightPieces, AreTheSidesOfAPolygon) {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const double turn = random.uniform(0.0, std::numbers::pi);
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    std::vector<PlanePoint> corners = {{0, 0}, {3, 0}, {3, 2}, {1, 2.5}};
    for (PlanePoint& p : corners) p = {c * p.x - s * p.y, s * p.x + c * p.y};
    const auto outline = outlineOf(corners, 0.01, random);
    const auto pieces = straightPiecesOf(outline, {.tolerance = 0.08, .shortest = 0.5});
    ASSERT_EQ(pieces.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LT(distance(pieces[k].from, corners[k]), 0.1);
      EXPECT_LT(distance(pieces[k].to, corners[k + 1]), 0.1);
      // The line itself is much better than its points: 40 of 0.01 m.
      const double expected =
          std::atan2(corners[k + 1].y - corners[k].y, corners[k + 1].x - corners[k].x);
      const double found =
          std::atan2(pieces[k].to.y - pieces[k].from.y, pieces[k].to.x - pieces[k].from.x);
      EXPECT_NEAR(std::remainder(found - expected, 2 * std::numbers::pi), 0.0, 0.02);
    }
  }
}

TEST(StraightPieces, TwoPointsAreOneWhereTwoAreEnough) {
  const std::vector<PlanePoint> two = {{1, 2}, {4, 6}};
  const auto pieces = straightPiecesOf(two, {.tolerance = 0.1, .shortest = 5.0, .fewestPoints = 2});
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_NEAR(distance(pieces[0].from, pieces[0].to), 5.0, 1e-9);
  EXPECT_TRUE(
      straightPiecesOf(two, {.tolerance = 0.1, .shortest = 5.0, .fewestPoints = 3}).empty());
}

TEST(StraightPieces, OfNothingAreNone) {
  EXPECT_TRUE(straightPiecesOf({}, {}).empty());
  const std::vector<PlanePoint> one = {{1, 2}};
  EXPECT_TRUE(straightPiecesOf(one, {}).empty());
  const std::vector<PlanePoint> same(10, {1, 2});
  EXPECT_TRUE(straightPiecesOf(same, {}).empty());
}

}  // namespace
}  // namespace ortung
