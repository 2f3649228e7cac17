/// Balls on a painted floor: their outlines by closed-form geometry.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "ortung/base/Parameters.hpp"
#include "ortung/calibration/ImageFile.hpp"
#include "ortung/vision/BallFinder.hpp"

namespace ortung {
namespace {

using Rgb = std::array<std::uint8_t, 3>;
constexpr Rgb kGreen{40, 140, 60};
constexpr Rgb kYellow{220, 190, 40};
constexpr Rgb kBeige{240, 205, 165};
constexpr Rgb kBlack{15, 15, 15};
constexpr double kRadius = 0.11;  // [m]

CameraView front() {
  Parameters p("camera");
  p.set("size_px", std::vector<double>{640, 480});
  p.set("focal_px", std::vector<double>{400, 400});
  return {readCamera(p), {.z = 0.8, .tilt = 0.35}};
}

/// Paints the pixels whose ray comes as near to a point as a ball's radius.
void paintBall(Picture& picture, const CameraView& view, const Point3& middle, const Rgb& colour,
               double radius = kRadius) {
  for (int v = 0; v < picture.size.height; ++v)
    for (int u = 0; u < picture.size.width; ++u) {
      const auto ray = view.rayAt({static_cast<double>(u), static_cast<double>(v)});
      if (!ray) continue;
      const double z = middle.z - view.place().z;
      const double along = ray->x * middle.x + ray->y * middle.y + ray->z * z;
      const double off = middle.x * middle.x + middle.y * middle.y + z * z - along * along;
      if (along > 0.0 && off < radius * radius)
        std::copy(colour.begin(), colour.end(),
                  picture.pixels.begin() + 3 * (v * picture.size.width + u));
    }
}

Picture bareFloor() {
  Picture picture{{640, 480}, {}};
  for (int i = 0; i < 640 * 480; ++i)
    picture.pixels.insert(picture.pixels.end(), kGreen.begin(), kGreen.end());
  return picture;
}

std::vector<SeenBall> found(const Picture& picture) {
  BallFinder finder(front(), {});
  return finder.find(picture.view(), ColourTable({}));
}

TEST(BallFinder, FindsYellowAndPaleBallsWhereTheyLieTheNearestFirst) {
  Picture picture = bareFloor();
  paintBall(picture, front(), {4.0, -1.0, kRadius}, kBeige);
  paintBall(picture, front(), {1.6, 0.4, kRadius}, kYellow);
  const auto balls = found(picture);
  ASSERT_EQ(balls.size(), 2U);
  EXPECT_NEAR(balls[0].range, std::hypot(1.6, 0.4), 0.05);
  EXPECT_NEAR(balls[0].bearing, std::atan2(0.4, 1.6), 0.015);
  EXPECT_NEAR(balls[1].range, std::hypot(4.0, 1.0), 0.2);  // a pixel is 5 cm there
  EXPECT_NEAR(balls[1].bearing, std::atan2(-1.0, 4.0), 0.015);
}

TEST(BallFinder, WhatIsTooLargeTooSmallOrInTheAirIsNone) {
  for (const auto& [place, radius] : {std::pair{Point3{2.0, 0.0, kRadius}, 0.25},
                                      {Point3{2.0, 0.0, kRadius}, 0.05},
                                      {Point3{1.5, 0.0, 0.7}, kRadius}}) {
    Picture picture = bareFloor();
    paintBall(picture, front(), place, kYellow, radius);
    EXPECT_TRUE(found(picture).empty()) << place.x << " " << place.z << " " << radius;
  }
}

// A leg or a shirt has the ball's colour, but no outline of a ball; a round thing on a robot has
// black below it.
TEST(BallFinder, ColourAloneIsNoBall) {
  Picture leg = bareFloor();
  for (int v = 100; v < 330; ++v)
    for (int u = 300; u < 330; ++u)
      std::copy(kBeige.begin(), kBeige.end(), leg.pixels.begin() + 3 * (v * 640 + u));
  EXPECT_TRUE(found(leg).empty());
  const auto middle = front().pixelOf({2.0, 0.0, kRadius});
  Picture robot = bareFloor();
  for (int v = static_cast<int>(middle->v); v < 480; ++v)
    for (int u = static_cast<int>(middle->u) - 60; u < static_cast<int>(middle->u) + 60; ++u)
      std::copy(kBlack.begin(), kBlack.end(), robot.pixels.begin() + 3 * (v * 640 + u));
  paintBall(robot, front(), {2.0, 0.0, kRadius}, kYellow);
  EXPECT_TRUE(found(robot).empty());
}

TEST(BallFinder, PicturesOfAnotherKindAreLeftOut) {
  BallFinder finder(front(), {});
  const std::vector<std::uint8_t> pixels(640 * 480 * 3, 200);
  EXPECT_TRUE(
      finder.find({{640, 480}, PixelFormat::kGrey, pixels.data()}, ColourTable({})).empty());
  EXPECT_TRUE(finder.find({{639, 480}, PixelFormat::kRgb, pixels.data()}, ColourTable({})).empty());
}

}  // namespace
}  // namespace ortung
