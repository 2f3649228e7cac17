// How many places explain a scan: rooms of which that is known by their shape.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "FakeWorld.hpp"
#include "SensorRig.hpp"
#include "ortung/formats/PoseFixData.hpp"

namespace ortung {
namespace {

constexpr double kPi = std::numbers::pi;

struct Corner {
  double x;  ///< [m]
  double y;
};

/// A world of straight walls, some of which are known.
class Walls : public FakeWorld {
 public:
  Walls() : FakeWorld(200.0, 200.0) {}

  /// Adds a room with these corners, counter-clockwise, moved by x [m].
  void addRoom(const std::vector<Corner>& corners, double x, bool isKnown = true) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Corner& a = corners[i];
      const Corner& b = corners[(i + 1) % corners.size()];
      const FieldWall wall{x + a.x, a.y, x + b.x, b.y, 0.0, 2.0, false};
      solid_.push_back(wall);
      if (isKnown) known_.push_back(wall);
    }
  }

  std::span<const FieldWall> mapWalls() const override { return known_; }
  void castFan(const RayFan& fan, RobotNumber, std::span<float> ranges) const override {
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const double angle = fan.firstAngle + static_cast<double>(i) * fan.angleStep;
      const double c = std::cos(angle);
      const double s = std::sin(angle);
      double nearest = std::numeric_limits<double>::infinity();
      for (const FieldWall& wall : solid_) {
        const double dx = wall.x1 - wall.x0;
        const double dy = wall.y1 - wall.y0;
        const double cross = c * dy - s * dx;
        const double range = ((wall.x0 - fan.x) * dy - (wall.y0 - fan.y) * dx) / cross;
        const double along = ((wall.x0 - fan.x) * s - (wall.y0 - fan.y) * c) / cross;
        if (range >= 0.0 && along >= 0.0 && along <= 1.0) nearest = std::min(nearest, range);
      }
      ranges[i] = static_cast<float>(std::min(nearest, fan.maxRange));
    }
  }

 private:
  std::vector<FieldWall> solid_;
  std::vector<FieldWall> known_;
};

const std::vector<Corner> kSquare{{0, 0}, {5, 0}, {5, 5}, {0, 5}};
/// No turn and no reflection lays it on itself.
const std::vector<Corner> kLShape{{0, 0}, {7, 0}, {7, 3}, {4, 3}, {4, 5}, {0, 5}};

PoseFixData::Reading positionsIn(const Walls& world, const Pose2& robot) {
  SensorRig rig("lrf_iconic", "beams = 360\nfov_deg = 360\nmax_range_m = 20");
  Random noise(7);
  rig.sense(world, robot, &noise);
  EXPECT_EQ(rig.data[1]->sequence(), 1u);  // it has looked
  return rig.get<PoseFixData>(1).reading();
}

void expectOneAt(const PoseFixData::Reading& positions, const Pose2& place) {
  const auto isThere = [&](const PoseFixData::Fix& fix) {
    return distance(fix.pose, place) < 0.05 &&
           std::abs(wrapAngle(fix.pose.theta - place.theta)) < 0.02;
  };
  EXPECT_EQ(std::count_if(positions.begin(), positions.end(), isThere), 1)
      << place.x << " " << place.y << " " << place.theta;
}

TEST(IconicPlaces, OfASquareRoomAreFour) {
  Walls world;
  world.addRoom(kSquare, 0.0);
  const PoseFixData::Reading positions = positionsIn(world, {1.5, 2.0, 0.4});
  ASSERT_EQ(positions.size(), 4u);
  for (int quarter = 0; quarter < 4; ++quarter) {
    const Pose2 turn{0.0, 0.0, quarter * kPi / 2};  // around the room's middle
    const Pose2 place = Pose2{2.5, 2.5, 0.0} * turn * Pose2{-1.0, -0.5, 0.4};
    expectOneAt(positions, place);
  }
}

TEST(IconicPlaces, OfARoomLikeNoOtherIsOne) {
  Walls world;
  world.addRoom({{0, 0}, {9, 0}, {9, 2}, {0, 2}}, -20.0);
  world.addRoom(kLShape, 0.0);
  for (const Pose2 robot : {Pose2{1.5, 2.0, 0.4}, Pose2{6.0, 1.5, -2.8}, Pose2{2.0, 4.0, 1.7}}) {
    const PoseFixData::Reading positions = positionsIn(world, robot);
    ASSERT_EQ(positions.size(), 1u) << robot.x;
    expectOneAt(positions, robot);
  }
}

TEST(IconicPlaces, OfEqualRoomsAreAsManyAsThereAreRooms) {
  for (const int rooms : {2, 3, 8}) {
    Walls world;
    for (int i = 0; i < rooms; ++i) world.addRoom(kLShape, 11.0 * i);
    const PoseFixData::Reading positions = positionsIn(world, {1.5, 2.0, 0.4});
    ASSERT_EQ(positions.size(), static_cast<std::size_t>(rooms));
    for (int i = 0; i < rooms; ++i) expectOneAt(positions, {1.5 + 11.0 * i, 2.0, 0.4});
  }
}

TEST(IconicPlaces, OfMoreEqualRoomsThanPositionsAreNone) {
  Walls world;
  for (int i = 0; i < 9; ++i) world.addRoom(kLShape, 11.0 * i);
  EXPECT_TRUE(positionsIn(world, {1.5, 2.0, 0.4}).empty());
}

/// All rooms count, however many walls a building has: longer ones elsewhere do not hide one.
TEST(IconicPlaces, OfEqualRoomsAmongManyWallsAreAllOfThem) {
  Walls world;
  world.addRoom(kLShape, 0.0);
  world.addRoom(kLShape, -11.0);
  for (int i = 0; i < 160; ++i) {
    const double y = 10.0 + 2.2 * i;
    world.addRoom({{0, y}, {20, y}, {20, y + 0.1}, {0, y + 0.1}}, 0.0);
  }
  const PoseFixData::Reading positions = positionsIn(world, {1.5, 2.0, 0.4});
  ASSERT_EQ(positions.size(), 2u);
  expectOneAt(positions, {1.5, 2.0, 0.4});
  expectOneAt(positions, {-9.5, 2.0, 0.4});
}

TEST(IconicPlaces, AlongACorridorAreNone) {
  Walls world;
  world.addRoom({{-60, 0}, {60, 0}, {60, 2.5}, {-60, 2.5}}, 0.0);
  EXPECT_TRUE(positionsIn(world, {1.0, 1.0, 0.3}).empty());
}

TEST(IconicPlaces, OfARoomThatNobodyHasMappedAreNone) {
  Walls world;
  world.addRoom({{0, 0}, {9, 0}, {9, 2}, {0, 2}}, 0.0);
  world.addRoom(kLShape, 30.0, false);
  EXPECT_TRUE(positionsIn(world, {31.5, 2.0, 0.4}).empty());
}

}  // namespace
}  // namespace ortung
