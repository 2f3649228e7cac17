#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "FakeWorld.hpp"
#include "WorldFiles.hpp"
#include "ortung/formats/PointsData.hpp"
#include "ortung/sim_api/Sensor.hpp"
#include "ortung/sim_api/Sight.hpp"

// The geometric shape of all objects (paper, section 4), as sensors get it.
namespace ortung::test {
namespace {

/// A sensor that gives the nearest point of each robot's outline: what a fine scanner that can tell
/// robots would see, without a ray.
class NearestPoints : public Sensor {
 public:
  void generateData(const World& world, const RobotState& robot, Random* /*noise*/, Timestamp now,
                    std::span<SensorData* const> data) override {
    std::vector<PointsData::Point> points;
    for (const WorldObject& object : world.objects()) {
      if (object.kind != "robot" || object.robot == robot.number) continue;
      PointsData::Point nearest{1e9, 0.0};
      for (const WorldPiece& piece : object.pieces)
        look(robot.pose, outlineOf(object, piece), nearest);
      points.push_back(nearest);
    }
    std::vector<std::uint32_t> words;
    PointsData::encode(points, words);
    for (SensorData* feature : data) feature->setData(now, words);
  }
  static void look(const Pose2& eye, const std::vector<FloorPoint>& outline,
                   PointsData::Point& nearest) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const FloorPoint& a = outline[i];
      const FloorPoint& b = outline[(i + 1) % outline.size()];
      for (int k = 0; k < 100; ++k) {
        const double x = a.x + (b.x - a.x) * k / 100.0;
        const double y = a.y + (b.y - a.y) * k / 100.0;
        const auto seen = lookAt({.pose = eye}, x, y);
        if (seen && seen->range < nearest.range) nearest = {seen->range, seen->bearing};
      }
    }
  }
};

/// An L of a bar and a triangle.
std::vector<Primitive> pieces() {
  Primitive bar;
  bar.centre = {0.5, 0.0};
  bar.halfX = 0.5;
  bar.halfY = 0.1;
  bar.colour = "red";
  Primitive triangle;
  triangle.shape = Primitive::Shape::kTriangle;
  triangle.corners = {Point2{0.8, 0.1}, Point2{0.9, 0.7}, Point2{1.0, 0.1}};  // with the clock
  triangle.centre = {0.9, 0.3};
  triangle.zLow = 0.2;
  triangle.zHigh = 0.4;
  return {bar, triangle};
}

double areaOf(const std::vector<FloorPoint>& outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const FloorPoint& a = outline[i];
    const FloorPoint& b = outline[(i + 1) % outline.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return twice / 2.0;
}

TEST(Outlines, OfAMovingBodyFollowIt) {
  const auto world = worldOf("[[rectangle]]\ncenter_m = [9, 9]\nsize_m = [1, 1]\n");
  const RobotNumber robot =
      world->addBody({.kind = "robot", .name = "l", .colour = "blue", .pieces = pieces()}, {});
  world->moveBody(robot, {2.0, 1.0, 1.5707963267948966});
  const WorldObject& object = world->objects().back();
  ASSERT_EQ(object.pieces.size(), 2u);
  EXPECT_EQ(object.pieces[0].colour, "red");
  EXPECT_EQ(object.pieces[1].colour, "");
  EXPECT_EQ(object.pieces[1].zLow, 0.2);
  EXPECT_EQ(object.pieces[1].zHigh, 0.4);
  const std::vector<FloorPoint> bar = outlineOf(object, object.pieces[0]);
  ASSERT_EQ(bar.size(), 4u);
  EXPECT_NEAR(bar[0].x, 2.1, 1e-12);  // (0, -0.1), turned by 90 degrees
  EXPECT_NEAR(bar[0].y, 1.0, 1e-12);
  EXPECT_NEAR(areaOf(bar), 0.2, 1e-12);
  const std::vector<FloorPoint> triangle = outlineOf(object, object.pieces[1]);
  ASSERT_EQ(triangle.size(), 3u);
  EXPECT_NEAR(areaOf(triangle), 0.06, 1e-12);  // against the clock
  const bool hasTip = std::any_of(triangle.begin(), triangle.end(), [](const FloorPoint& p) {
    return std::hypot(p.x - 1.3, p.y - 1.9) < 1e-9;
  });
  EXPECT_TRUE(hasTip);
  // A manipulator that moves is another shape.
  world->reshapeBody(robot, std::vector<Primitive>{pieces()[0]});
  EXPECT_EQ(world->objects().back().pieces.size(), 1u);
}

TEST(Outlines, OfWhatStandsAreThoseOfTheFile) {
  const auto world = worldOf(R"(
[[rectangle]]
center_m = [1, 2]
size_m = [2, 1]
angle_deg = 30
[[ellipse]]
center_m = [5, 5]
size_m = [2, 1]
angle_deg = 90
[[triangle]]
corners_m = [0, 0, 1, 0, 0, 2]
)");
  ASSERT_EQ(world->objects().size(), 3u);
  // Rays end where the outlines are.
  for (const WorldObject& object : world->objects()) {
    ASSERT_EQ(object.pieces.size(), 1u);
    const auto outline = outlineOf(object, object.pieces[0]);
    const double x = 20.0;
    const double y = 3.0;
    for (const FloorPoint& point : outline) {
      const double angle = std::atan2(point.y - y, point.x - x);
      const double way = std::hypot(point.x - x, point.y - y);
      EXPECT_LE(rangeAt(*world, x, y, angle), way + 1e-3);
    }
    const std::size_t kind = static_cast<std::size_t>(&object - world->objects().data());
    constexpr std::array kAreas{2.0, 1.5663, 1.0};  // of a polygon of 48 corners for the ellipse
    EXPECT_NEAR(areaOf(outline), kAreas[kind], 1e-3);
  }
}

TEST(Outlines, GiveASensorPluginTheNearestPointOfARobotOfSeveralPieces) {
  const auto world = worldOf("[[rectangle]]\ncenter_m = [9, 9]\nsize_m = [1, 1]\n");
  world->addBody({.kind = "robot", .name = "l", .colour = "", .pieces = pieces()}, {2.0, 0.0, 0.0});
  NearestPoints sensor;
  PointsData data(SensorId{"a", "b", "c"}, {}, {});
  SensorData* features[] = {&data};
  RobotState robot;
  robot.pose = {2.9, 2.0, -1.5707963267948966};  // above the triangle's tip, at (2.9, 0.7)
  sensor.generateData(*world, robot, nullptr, 1, features);
  std::vector<std::uint32_t> words(data.getData().begin(), data.getData().end());
  ASSERT_EQ(words.size(), 2u);
  EXPECT_NEAR(words[0] / 1000.0, 1.3, 0.002);
  // By its extent alone it would be 1.3 m away all along its width; left of the tip is the bar.
  robot.pose.x = 2.2;
  sensor.generateData(*world, robot, nullptr, 2, features);
  EXPECT_GT(data.getData()[0] / 1000.0, 1.45);
}

TEST(Outlines, OfFakeWorldsAreThoseOfTheExtent) {
  FakeWorld room(10.0, 10.0);
  WorldObject ball;
  ball.pose = {1.0, 1.0, 0.0};
  ball.isRound = true;
  ball.halfX = ball.halfY = ball.radius = 0.11;
  room.addObject(ball);
  ASSERT_EQ(room.objects()[0].pieces.size(), 1u);
  EXPECT_NEAR(areaOf(outlineOf(room.objects()[0], room.objects()[0].pieces[0])), 0.038, 1e-3);
}

}  // namespace
}  // namespace ortung::test
