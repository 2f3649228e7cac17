// A map whose origin is turned is the same world turned: whatever sensors, robots and programs ask
// of it at a pose is what the straight one answers at the pose turned back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "WorldFiles.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/sim/Solids.hpp"

namespace ortung::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kCell = 0.25;
constexpr double kX = 1.3;  // origin of the map [m]
constexpr double kY = -2.1;

std::string num(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

/// A room of 10 x 7.5 m, with boxes in it and a corner that nobody has seen.
std::vector<std::string> room() {
  Random random(11);
  std::vector<std::string> rows(30, std::string(40, '.'));
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      const bool isEdge = r == 0 || c == 0 || r + 1 == rows.size() || c + 1 == rows[r].size();
      rows[r][c] = isEdge || random.uniform() < 0.05 ? '#' : r < 8 && c < 8 ? ' ' : '.';
    }
  return rows;
}

std::unique_ptr<SimWorld> worldTurned(double yaw, const std::vector<std::string>& rows = room()) {
  const TemporaryFolder folder;
  folder.write("map.pgm", pgmOf(rows));
  folder.write("map.yaml",
               mapYaml("map.pgm", "[" + num(kX) + ", " + num(kY) + ", " + num(yaw) + "]", "0.25"));
  return readWorld(folder.write(
      "world.toml", gridWorld("map.yaml", "surface_depth_cells = 0.5\nz_m = [0, 1.5]\n")));
}

/// Turns about the origin of the map.
Pose2 turned(const Pose2& pose, double yaw) {
  const double x = pose.x - kX;
  const double y = pose.y - kY;
  return {kX + std::cos(yaw) * x - std::sin(yaw) * y, kY + std::sin(yaw) * x + std::cos(yaw) * y,
          pose.theta + yaw};
}

class TurnedMap : public testing::TestWithParam<double> {
 protected:
  double yaw() const { return GetParam(); }
  /// A place anywhere in the room or beside it.
  Pose2 anywhere() {
    return {kX + random_.uniform(-1.0, 11.0), kY + random_.uniform(-1.0, 8.5),
            random_.uniform(-kPi, kPi)};
  }

  std::unique_ptr<SimWorld> straight_ = worldTurned(0.0);
  std::unique_ptr<SimWorld> turned_ = worldTurned(GetParam());
  Random random_{3};
};

TEST_P(TurnedMap, IsSeenAsTheStraightOneFromThePoseTurnedBack) {
  constexpr std::size_t kRays = 90;
  int other = 0;
  int all = 0;
  for (int i = 0; i < 300; ++i) {
    const Pose2 pose = anywhere();
    const Pose2 there = turned(pose, yaw());
    // From within, and from above, where rays meet the tops of cells.
    const double z = i % 3 == 0 ? 2.0 : 0.4;
    const double elevation = i % 3 == 0 ? -0.35 : i % 3 == 1 ? 0.1 : 0.0;
    std::array<float, kRays> expected{};
    std::array<float, kRays> found{};
    straight_->castFan({pose.x, pose.y, z, pose.theta, 0.07, elevation, 15.0}, 0, expected);
    turned_->castFan({there.x, there.y, z, there.theta, 0.07, elevation, 15.0}, 0, found);
    for (std::size_t k = 0; k < kRays; ++k, ++all)
      other += std::abs(expected[k] - found[k]) > 1e-3F ? 1 : 0;
  }
  EXPECT_LE(other, all / 2000) << "rays that graze a corner may miss it";
}

TEST_P(TurnedMap, ConesAndSightAreTheSame) {
  int other = 0;
  for (int i = 0; i < 300; ++i) {
    const Pose2 pose = anywhere();
    const Pose2 to = anywhere();
    const Pose2 there = turned(pose, yaw());
    const Pose2 target = turned(to, yaw());
    float expected = 0.0F;
    float found = 0.0F;
    straight_->castCones({pose.x, pose.y, 0.4, pose.theta, 0.0, 0.2, 4.0}, 0, {&expected, 1});
    turned_->castCones({there.x, there.y, 0.4, there.theta, 0.0, 0.2, 4.0}, 0, {&found, 1});
    other += std::abs(expected - found) > 0.01F ? 1 : 0;
    other += straight_->isVisible(pose.x, pose.y, 0.4, to.x, to.y, 0.4, 0, 0.0) !=
                     turned_->isVisible(there.x, there.y, 0.4, target.x, target.y, 0.4, 0, 0.0)
                 ? 1
                 : 0;
  }
  EXPECT_LE(other, 3);
}

TEST_P(TurnedMap, RobotsHaveTheSameRoom) {
  int free = 0;
  for (int i = 0; i < 3000; ++i) {
    const Pose2 pose = anywhere();
    const Pose2 there = turned(pose, yaw());
    for (const double radius : {0.0, 0.2, 0.45}) {
      // A larger field has room beside the map, but nothing is known of it.
      const bool isFree = straight_->isFree(pose.x, pose.y, {radius});
      ASSERT_EQ(turned_->isFree(there.x, there.y, {radius}), isFree)
          << pose.x << ", " << pose.y << ", radius " << radius;
      free += isFree ? 1 : 0;
    }
  }
  EXPECT_GT(free, 500);
}

TEST_P(TurnedMap, TheCellsToLearnAreWhereTheStraightMapIsFree) {
  const RobotSize robot{0.2};
  const FieldRegion region = turned_->region(0.1, robot);
  double area = 0.0;
  for (std::size_t i = 0; i < region.grid.size(); ++i) {
    const Pose2 back = turned({region.grid.centreX(i), region.grid.centreY(i), 0.0}, -yaw());
    ASSERT_EQ(region.open[i] != 0, straight_->isFree(back.x, back.y, {0.0}));
    ASSERT_EQ(region.standable[i] != 0, straight_->isFree(back.x, back.y, robot));
    area += region.open[i] != 0 ? 0.01 : 0.0;
  }
  const FieldRegion other = straight_->region(0.1, robot);
  const auto open = std::count(other.open.begin(), other.open.end(), 1);
  EXPECT_NEAR(area, 0.01 * static_cast<double>(open), 0.5);
  EXPECT_EQ(region.surfaceSigma, other.surfaceSigma);
}

TEST_P(TurnedMap, WallsAndObstaclesAreTurned) {
  const auto expected = straight_->mapWalls();
  const auto found = turned_->mapWalls();
  ASSERT_EQ(found.size(), expected.size());
  ASSERT_GE(found.size(), 4u);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Pose2 from = turned({expected[i].x0, expected[i].y0, 0.0}, yaw());
    const Pose2 to = turned({expected[i].x1, expected[i].y1, 0.0}, yaw());
    EXPECT_NEAR(found[i].x0, from.x, 1e-9);
    EXPECT_NEAR(found[i].y0, from.y, 1e-9);
    EXPECT_NEAR(found[i].x1, to.x, 1e-9);
    EXPECT_NEAR(found[i].y1, to.y, 1e-9);
  }
  const Solids before = straight_->solids();
  const Solids after = turned_->solids();
  ASSERT_EQ(after.walls.size(), before.walls.size());
  for (std::size_t i = 0; i < after.walls.size(); ++i) {
    const Pose2 from = turned({before.walls[i].from.x, before.walls[i].from.y, 0.0}, yaw());
    EXPECT_NEAR(after.walls[i].from.x, from.x, 1e-9);
    EXPECT_NEAR(after.walls[i].from.y, from.y, 1e-9);
  }
}

TEST_P(TurnedMap, TheFieldIsTheBoxAroundItsCorners) {
  Box2 box{kX, kX, kY, kY};
  for (const Pose2& corner :
       {Pose2{kX + 10.0, kY, 0.0}, {kX, kY + 7.5, 0.0}, {kX + 10.0, kY + 7.5, 0.0}}) {
    const Pose2 at = turned(corner, yaw());
    box = {std::min(box.xLow, at.x), std::max(box.xHigh, at.x), std::min(box.yLow, at.y),
           std::max(box.yHigh, at.y)};
  }
  const Box2 found = turned_->solids().bounds;
  EXPECT_NEAR(found.xLow, box.xLow, 1e-9);
  EXPECT_NEAR(found.xHigh, box.xHigh, 1e-9);
  EXPECT_NEAR(found.yLow, box.yLow, 1e-9);
  EXPECT_NEAR(found.yHigh, box.yHigh, 1e-9);
}

TEST_P(TurnedMap, IsAnotherWorld) {
  EXPECT_NE(turned_->fingerprint(), straight_->fingerprint());
  EXPECT_EQ(worldTurned(yaw() + 2.0 * kPi)->fingerprint(), turned_->fingerprint());
}

INSTANTIATE_TEST_SUITE_P(Yaw, TurnedMap,
                         testing::Values(0.01, 37.0 * kPi / 180.0, kPi / 2.0, -2.2, 3.1, -0.7));

// By hand: a wall of three cells along the rows from the corner (1.3, -2.1) on, turned by a quarter
// to the left, lies to the left of x = 1.3 and goes up.
TEST(TurnedMapByHand, AWallAlongTheRowsGoesUp) {
  const auto world = worldTurned(kPi / 2.0, {"....", "....", "###."});
  // The wall: x from 1.05 to 1.3, y from -2.1 to -1.35; surfaces half a cell behind its outline.
  const double y = kY + 1.5 * kCell;
  EXPECT_NEAR(rangeAt(*world, kX - 2.5 * kCell, y, 0.0), 1.5 * kCell + 0.125, 1e-5);
  EXPECT_TRUE(world->isFree(kX - 1.5 * kCell, y, {0.1}));
  EXPECT_FALSE(world->isFree(kX - 0.5 * kCell, y, {0.0})) << "in the wall";
  EXPECT_TRUE(world->isFree(kX - 0.5 * kCell, kY + 3.5 * kCell, {0.0})) << "behind its end";
  EXPECT_FALSE(world->isFree(kX + 0.5 * kCell, y, {0.0})) << "where the map is if not turned";
}

TEST(TurnedMapByHand, AYawOfWholeTurnsIsNone) {
  const std::string straight = worldTurned(0.0)->fingerprint();
  for (const double yaw : {2.0 * kPi, -4.0 * kPi, 1e-12, -0.0})
    EXPECT_EQ(worldTurned(yaw)->fingerprint(), straight) << yaw;
}

TEST(TurnedMapByHand, AllOfAMapLiesWithin10Km) {
  const TemporaryFolder folder;
  folder.write("map.pgm", pgmOf(room()));
  const auto refusal = [&](const std::string& origin) {
    folder.write("map.yaml", mapYaml("map.pgm", origin, "100"));
    return refusalOf(folder.write("world.toml", gridWorld()));
  };
  EXPECT_EQ(refusal("[0, 0, 3.14159]"), "");
  EXPECT_EQ(refusal("[6000, 0, 0]"), "");
  EXPECT_NE(refusal("[-6001, 0, 3.14159]").find("beyond 10 km"), std::string::npos);
  EXPECT_NE(refusal("[7500, 0, 0.8]").find("beyond 10 km"), std::string::npos);
  EXPECT_NE(refusal("[0, 0, .nan]").find("yaw of origin is .nan"), std::string::npos);
  EXPECT_NE(refusal("[0, 0, 10001]").find("yaw of origin is 10001"), std::string::npos);
}

}  // namespace
}  // namespace ortung::test
