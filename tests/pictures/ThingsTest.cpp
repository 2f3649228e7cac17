#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "Snapshots.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung::test {
namespace {

constexpr const char* kWorld = R"(
[world]
x_m = [-6, 6]
y_m = [-5, 5]
[[rectangle]]
kind = "wall"
center_m = [6.1, 0]
size_m = [0.2, 10]
z_m = [0, 0.6]
[[ellipse]]
kind = "post"
center_m = [3, 2]
size_m = [0.3, 0.2]
angle_deg = 30
z_m = [0, 1.2]
[[triangle]]
kind = "obstacle"
corners_m = [3, -2, 4, -3, 4.2, -1.8]
z_m = [0.2, 0.9]
[[rectangle]]
kind = "line"
center_m = [1.5, 0]
size_m = [0.1, 8]
)";

Primitive box(double halfX, double halfY, double zLow, double zHigh) {
  Primitive one;
  one.halfX = halfX;
  one.halfY = halfY;
  one.zLow = zLow;
  one.zHigh = zHigh;
  return one;
}

/// The world with two robots and a ball in it.
struct FullWorld {
  std::unique_ptr<SimWorld> world = worldOf(kWorld);
  RobotNumber red = 0, own = 0, ball = 0;
  FullWorld() {
    Primitive horn = box(0.05, 0.05, 0.0, 0.2);
    horn.centre = {0.3, 0.1};
    red =
        world->addBody({"robot", "red1", "red", {box(0.2, 0.25, 0.0, 0.6), horn}}, {2.6, 0.4, 0.8});
    own = world->addBody({"robot", "own", "black", {box(0.2, 0.2, 0.0, 0.6)}}, {0.4, 0.0, 0.0});
    Primitive round;
    round.shape = Primitive::Shape::kEllipse;
    round.halfX = round.halfY = 0.11;
    round.zHigh = 0.22;
    ball = world->addBody({"ball", "ball", "orange", {round}}, {1.8, -0.6, 0.0});
  }
};

constexpr const char* kEye =
    "model = \"perspective\"\nsize_px = [320, 240]\nfocal_px = [180, 180]\n";

/// Compares distances of what is drawn with those that rays find, pixel by pixel.
void compareWithRays(CameraPicture& camera, const FullWorld& scene, const Pose2& sensor,
                     int least) {
  const Annotation seen = annotate(camera, *scene.world, sensor, scene.own);
  int compared = 0;
  for (int v = 1; v < seen.size.height; v += 3)
    for (int u = 1; u < seen.size.width; u += 3) {
      const PixelClass kind = seen.kind(u, v);
      // A ball is a cylinder for rays, and lines are nothing.
      if (!seen.isInside(u, v) || kind == PixelClass::kBall) continue;
      const auto ray = camera.camera().rayAt({static_cast<double>(u), static_cast<double>(v)});
      if (!ray) continue;
      const double z = camera.camera().place().z;
      RayFan fan{sensor.x, sensor.y,          z,   sensor.theta + std::atan2(ray->y, ray->x),
                 0.0,      std::asin(ray->z), 60.0};
      float range = 0.0F;
      scene.world->castFan(fan, scene.own, {&range, 1});
      const FloorPoint hit{sensor.x + range * std::cos(fan.elevation) * std::cos(fan.firstAngle),
                           sensor.y + range * std::cos(fan.elevation) * std::sin(fan.firstAngle)};
      const Pose2& ball = scene.world->objects().back().pose;
      if (std::hypot(hit.x - ball.x, hit.y - ball.y) < 0.12) continue;
      const double floor = ray->z < 0.0 ? z / -ray->z : 1e9;
      const bool isFloor = kind == PixelClass::kField || kind == PixelClass::kLine ||
                           (kind == PixelClass::kBackground && ray->z < 0.0);
      const double expected = isFloor ? floor : range;
      if (isFloor) {
        EXPECT_GE(range, std::min(floor, 60.0) - 0.02) << u << ", " << v;
      } else if (kind == PixelClass::kBackground) {
        EXPECT_TRUE(std::isinf(seen.ranges[seen.index(u, v)]));
        EXPECT_FLOAT_EQ(range, 60.0F) << u << ", " << v;
        continue;
      }
      if (floor > 60.0 && isFloor) continue;
      EXPECT_NEAR(seen.ranges[seen.index(u, v)], expected, 0.002)
          << u << ", " << v << " class " << static_cast<int>(kind);
      ++compared;
    }
  EXPECT_GT(compared, least);
}

TEST(Things, AreWhereRaysMeetThem) {
  const FullWorld scene;
  CameraPicture camera(viewOf(kEye, 0.7, radians(15.0)));
  compareWithRays(camera, scene, {0.0, 0.0, 0.05}, 2000);
}

TEST(Things, AreWhereRaysMeetThemAfterTheyHaveMoved) {
  FullWorld scene;
  CameraPicture camera(viewOf(kEye, 0.7, radians(15.0)));
  scene.world->moveBody(scene.red, {1.6, -0.3, 2.2});
  scene.world->moveBody(scene.ball, {3.1, 1.0, 0.0});
  compareWithRays(camera, scene, {0.0, 0.0, 0.05}, 2000);
}

constexpr const char* kMirror =
    "model = \"unified\"\nsize_px = [300, 300]\nxi = 0.95\nfocal_px = [115, 115]\n";

TEST(Things, AreWhereRaysMeetThemInAMirror) {
  const FullWorld scene;
  CameraPicture camera(viewOf(kMirror, 0.7, radians(90.0)));
  compareWithRays(camera, scene, {0.0, 0.0, 0.05}, 2000);
  const Annotation seen = annotate(camera, *scene.world, {0.0, 0.0, 0.0}, scene.own);
  std::set<std::uint32_t> objects;
  for (const std::uint32_t thing : seen.things) objects.insert(thing >> 8);
  EXPECT_EQ(objects.size(), 6u);  // nothing, wall, post, triangle, robot, ball
}

/// A pixel is one of a line if the ray through its middle meets the line's rectangle, however far
/// away and narrow it is there.
TEST(Things, ThatAreLinesAreThoseOfThePixelsMiddles) {
  const auto world = worldOf(
      "[world]\nx_m = [-6, 6]\ny_m = [-5, 5]\n[[rectangle]]\nkind = \"line\"\n"
      "center_m = [1.5, 0]\nsize_m = [0.03, 8]\n[[rectangle]]\nkind = \"line\"\n"
      "center_m = [-4.5, 0]\nsize_m = [0.03, 8]\n");
  for (const char* model : {kMirror, kEye}) {
    CameraPicture camera(viewOf(model, 0.7, radians(model == kMirror ? 90.0 : 15.0)));
    const Annotation seen = annotate(camera, *world, {0.0, 0.0, 0.0});
    int near = 0, far = 0;
    for (int v = 0; v < seen.size.height; ++v)
      for (int u = 0; u < seen.size.width; ++u) {
        const auto ray = camera.camera().rayAt({static_cast<double>(u), static_cast<double>(v)});
        if (!ray || ray->z > -1e-3) continue;
        const double x = ray->x * 0.7 / -ray->z;
        const double y = ray->y * 0.7 / -ray->z;
        const bool isNear = std::abs(x - 1.5) < 0.015;
        const bool isFar = std::abs(x + 4.5) < 0.015;
        const bool isLine = std::abs(y) < 4.0 && (isNear || isFar);
        near += isLine && isNear;
        far += isLine && isFar;
        const double off =
            std::min(std::abs(std::abs(x - 1.5) - 0.015), std::abs(std::abs(x + 4.5) - 0.015));
        if (off < 1e-4 || std::abs(std::abs(y) - 4.0) < 1e-3) continue;
        EXPECT_EQ(seen.kind(u, v) == PixelClass::kLine, isLine) << u << ", " << v;
      }
    EXPECT_GT(near, 100);
    if (model == kMirror) {
      EXPECT_GT(far, 5) << "a line of a fifth of a pixel";
    }
  }
}

TEST(Things, AreOfTheirClassAndTheirPlaceAmongObjects) {
  const FullWorld scene;
  CameraPicture camera(viewOf(kEye, 0.7, radians(15.0)));
  const Annotation seen = annotate(camera, *scene.world, {0.0, 0.0, 0.05}, scene.own);
  std::set<PixelClass> kinds;
  for (int v = 0; v < seen.size.height; ++v)
    for (int u = 0; u < seen.size.width; ++u) {
      const std::uint32_t object = seen.object(u, v);
      kinds.insert(seen.kind(u, v));
      if (object == 0) continue;
      ASSERT_LE(object, scene.world->objects().size());
      const WorldObject& is = scene.world->objects()[object - 1];
      const std::string kind = seen.kind(u, v) == PixelClass::kRobot  ? "robot"
                               : seen.kind(u, v) == PixelClass::kBall ? "ball"
                               : seen.kind(u, v) == PixelClass::kPost ? "post"
                               : seen.kind(u, v) == PixelClass::kWall ? "wall"
                                                                      : "obstacle";
      EXPECT_EQ(is.kind, kind);
      EXPECT_NE(is.name, "own");
    }
  EXPECT_EQ(kinds.size(), 8u);  // all but goals
}

/// The ball is a sphere: the range of each of its pixels in closed form.
TEST(Things, ThatAreBallsAreRound) {
  const FullWorld scene;
  CameraPicture camera(viewOf(kEye, 0.7, radians(25.0)));
  const Annotation seen = annotate(camera, *scene.world, {0.9, -0.2, -0.4}, scene.own);
  const Pose2 inSensor = inverse(Pose2{0.9, -0.2, -0.4}) * Pose2{1.8, -0.6, 0.0};
  int compared = 0;
  for (int v = 0; v < seen.size.height; ++v)
    for (int u = 0; u < seen.size.width; ++u) {
      if (seen.kind(u, v) != PixelClass::kBall || !seen.isInside(u, v)) continue;
      const auto ray = *camera.camera().rayAt({static_cast<double>(u), static_cast<double>(v)});
      const double along = ray.x * inSensor.x + ray.y * inSensor.y + ray.z * (0.11 - 0.7);
      const double squared = inSensor.x * inSensor.x + inSensor.y * inSensor.y + 0.59 * 0.59;
      const double half = 0.11 * 0.11 - (squared - along * along);
      ASSERT_GT(half, -2e-3) << u << ", " << v;
      const double expected = along - std::sqrt(std::max(half, 0.0));
      EXPECT_NEAR(seen.ranges[seen.index(u, v)], expected, 0.012);
      ++compared;
    }
  EXPECT_GT(compared, 300);
}

TEST(Things, OfATeamShowItsColour) {
  FullWorld scene;
  CameraPicture camera(viewOf(kEye, 0.7, radians(15.0)));
  const auto cyan = [&] {
    Snapshot picture = snap(camera, *scene.world, {0.0, 0.0, 0.05}, scene.own);
    int count = 0;
    for (int v = 0; v < picture.size.height; ++v)
      for (int u = 0; u < picture.size.width; ++u)
        count += picture.at(u, v, 1) > 100 && picture.at(u, v, 2) > 100 && picture.at(u, v, 0) < 60;
    return count;
  };
  EXPECT_EQ(cyan(), 0);
  scene.world->markBody(scene.red, "cyan");
  EXPECT_GT(cyan(), 50);
}

TEST(Things, ThatAreNetsAreLookedThrough) {
  const std::string behind =
      "[world]\nx_m = [-6, 6]\ny_m = [-5, 5]\n[[rectangle]]\nkind = \"goal\"\ncenter_m = [2, 0]\n"
      "size_m = [0.03, 3]\nz_m = [0, 1]\n";
  CameraPicture camera(viewOf(kEye, 0.5, 0.0));
  const auto rangeAhead = [&](const std::string& look) {
    const auto world = worldOf(behind + look +
                               "[[rectangle]]\nkind = \"wall\"\ncenter_m = [4, 0]\n"
                               "size_m = [0.2, 9]\nz_m = [0, 2]\n");
    const Annotation seen = annotate(camera, *world, {0.0, 0.0, 0.0});
    return seen.ranges[seen.index(160, 120)];
  };
  EXPECT_NEAR(rangeAhead(""), 1.985, 0.01);
  EXPECT_NEAR(rangeAhead("look = \"net\"\n"), 3.9, 0.01);
}

}  // namespace
}  // namespace ortung::test
