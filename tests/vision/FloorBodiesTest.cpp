/// What stands on a painted floor, and where a pixel lies on it, by closed-form geometry.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "ortung/calibration/ImageFile.hpp"
#include "ortung/vision/BlobFinder.hpp"
#include "ortung/vision/FieldLines.hpp"
#include "ortung/vision/FloorScan.hpp"
#include "ortung/vision/FloorSight.hpp"

namespace ortung {
namespace {

using Rgb = std::array<std::uint8_t, 3>;
constexpr Rgb kGreen{40, 140, 60};
constexpr Rgb kBlack{15, 15, 15};
constexpr Rgb kYellow{220, 190, 40};
constexpr double kPi = std::numbers::pi;

Picture pictureOf(int width, int height, const Rgb& colour) {
  Picture picture{{width, height}, {}};
  for (int i = 0; i < width * height; ++i)
    picture.pixels.insert(picture.pixels.end(), colour.begin(), colour.end());
  return picture;
}
void set(Picture& picture, int u, int v, const Rgb& colour) {
  std::copy(colour.begin(), colour.end(),
            picture.pixels.begin() + 3 * (v * picture.size.width + u));
}

/// A camera 2 m above the floor that looks straight down: 100 px a radian's tangent, so a pixel is
/// 2 cm of floor.
CameraView fromAbove() {
  Parameters p("camera");
  p.set("size_px", std::vector<double>{401, 401});
  p.set("focal_px", std::vector<double>{100, 100});
  p.set("centre_px", std::vector<double>{200, 200});
  return {readCamera(p), {.z = 2.0, .tilt = kPi / 2}};
}

/// Paints what lies within, by its place on the floor [m].
template <class Inside>
void paint(Picture& picture, const CameraView& view, const Rgb& colour, const Inside& inside) {
  for (int v = 0; v < picture.size.height; ++v)
    for (int u = 0; u < picture.size.width; ++u) {
      const auto place = view.floorAt({static_cast<double>(u), static_cast<double>(v)});
      if (place && inside(place->x, place->y)) set(picture, u, v, colour);
    }
}

FloorScan::Config scanConfig() { return {.directions = 360, .maxRange = 3.5}; }

// A body whose visible side is an arc of 20 degrees around the camera, 1.5 m away, to the left.
TEST(FloorScan, FindsABodyWhereTheFloorEnds) {
  const CameraView view = fromAbove();
  Picture picture = pictureOf(401, 401, kGreen);
  paint(picture, view, kBlack, [](double x, double y) {
    const double turn = std::abs(std::remainder(std::atan2(y, x) - kPi / 2, 2 * kPi));
    return turn <= 10 * kPi / 180 && std::hypot(x, y) >= 1.5;
  });
  const auto bodies = FloorScan(view, scanConfig()).find(picture.view(), ColourTable({}));
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_NEAR(bodies[0].range, 1.5, 0.07);  // steps grow by 3 %
  EXPECT_NEAR(bodies[0].bearing, kPi / 2, 1.5 * kPi / 180);
  EXPECT_NEAR(bodies[0].width, 1.5 * 20 * kPi / 180, 0.08);
}

// Straight ahead of the camera the first and the last direction meet: a body is not cut there, or
// behind, where angles wrap.
TEST(FloorScan, BodiesAcrossTheFirstDirectionAreWhole) {
  const CameraView view = fromAbove();
  for (const double bearing : {0.0, kPi}) {
    Picture picture = pictureOf(401, 401, kGreen);
    paint(picture, view, kBlack, [&](double x, double y) {
      return std::abs(std::remainder(std::atan2(y, x) - bearing, 2 * kPi)) <= 0.15 &&
             std::hypot(x, y) >= 1.2;
    });
    const auto bodies = FloorScan(view, scanConfig()).find(picture.view(), ColourTable({}));
    ASSERT_EQ(bodies.size(), 1u) << bearing;
    EXPECT_NEAR(std::remainder(bodies[0].bearing - bearing, 2 * kPi), 0.0, 0.03);
    EXPECT_NEAR(bodies[0].width, 1.2 * 0.3, 0.06);
  }
}

TEST(FloorScan, LinesBallsPostsAndWallsAreNoBodies) {
  const CameraView view = fromAbove();
  const ColourTable table({});
  const auto countOf = [&](const Rgb& colour, const auto& inside) {
    Picture picture = pictureOf(401, 401, kGreen);
    paint(picture, view, colour, inside);
    return FloorScan(view, scanConfig()).find(picture.view(), table).size();
  };
  const auto sector = [](double half, double from, double to) {
    return [=](double x, double y) {
      return std::abs(std::atan2(y, x)) <= half && std::hypot(x, y) >= from &&
             std::hypot(x, y) <= to;
    };
  };
  EXPECT_EQ(countOf(kBlack, sector(0.15, 1.2, 9.0)), 1u);
  EXPECT_EQ(countOf(kBlack, sector(0.15, 1.2, 1.32)), 0u) << "a line hides little floor";
  EXPECT_EQ(countOf(kYellow, sector(0.15, 1.2, 9.0)), 0u) << "a ball";
  EXPECT_EQ(countOf(kBlack, sector(0.03, 1.2, 9.0)), 0u) << "a post is too thin";
  EXPECT_EQ(countOf(kBlack, sector(0.8, 1.2, 9.0)), 0u) << "a wall is too wide";
  EXPECT_EQ(countOf(kBlack, [](double, double) { return true; }), 0u) << "no floor, no range";
}

TEST(FloorScan, TheNearestBodyIsTheFirst) {
  const CameraView view = fromAbove();
  Picture picture = pictureOf(401, 401, kGreen);
  for (const auto& [bearing, range] : {std::pair{0.5, 2.0}, {-1.0, 1.0}, {2.0, 1.5}})
    paint(picture, view, kBlack, [b = bearing, r = range](double x, double y) {
      return std::abs(std::remainder(std::atan2(y, x) - b, 2 * kPi)) <= 0.15 &&
             std::hypot(x, y) >= r;
    });
  const auto bodies = FloorScan(view, scanConfig()).find(picture.view(), ColourTable({}));
  ASSERT_EQ(bodies.size(), 3u);
  EXPECT_NEAR(bodies[0].bearing, -1.0, 0.03);
  EXPECT_NEAR(bodies[1].bearing, 2.0, 0.03);
  EXPECT_NEAR(bodies[2].bearing, 0.5, 0.03);
}

TEST(FloorScan, PicturesOfAnotherKindAreLeftOut) {
  const FloorScan scan(fromAbove(), scanConfig());
  const std::vector<std::uint8_t> pixels(401 * 401 * 3, 10);
  EXPECT_TRUE(scan.find({{401, 401}, PixelFormat::kGrey, pixels.data()}, ColourTable({})).empty());
  EXPECT_TRUE(scan.find({{400, 401}, PixelFormat::kRgb, pixels.data()}, ColourTable({})).empty());
}

// Straight down a pixel is 2 cm wide; its sigma and that of the paint, 2 cm, add as squares.
TEST(FloorSight, IsThePlaceAndItsWorstDirection) {
  const auto below = floorSightOf(fromAbove(), {200, 150}, 2.0);
  ASSERT_TRUE(below);
  EXPECT_NEAR(std::hypot(below->x, below->y), 1.0, 1e-9);
  EXPECT_NEAR(below->sigma, std::hypot(0.02, 2 * 0.02), 1e-9);
  // Looking ahead, a row lower is nearer by far more than a pixel is wide.
  Parameters p("camera");
  p.set("size_px", std::vector<double>{640, 480});
  p.set("focal_px", std::vector<double>{400, 400});
  p.set("centre_px", std::vector<double>{320, 240});
  const CameraView ahead(readCamera(p), {.z = 1.0});
  const auto far = floorSightOf(ahead, {320, 340}, 1.0);
  ASSERT_TRUE(far);
  EXPECT_NEAR(far->x, 4.0, 1e-9);  // 100 px below the horizon at a focal length of 400 px
  EXPECT_NEAR(far->y, 0.0, 1e-9);
  EXPECT_NEAR(far->sigma, std::hypot(0.02, 4.0 - 400.0 / 101), 1e-9);
  EXPECT_FALSE(floorSightOf(ahead, {320, 230}, 1.0)) << "above the horizon";
}

TEST(FloorTop, IsTheRowWhereTheFloorEnds) {
  Picture picture = pictureOf(200, 160, kBlack);
  for (int v = 60; v < 160; ++v)
    for (int u = 0; u < 200; ++u) set(picture, u, v, kGreen);
  EXPECT_EQ(floorTopOf(picture.view(), ColourTable({})), 60.0);
  // A robot in a third of the columns does not lower it, nor does green of 11 rows on the wall.
  for (int v = 60; v < 160; ++v)
    for (int u = 0; u < 66; ++u) set(picture, u, v, kBlack);
  for (int v = 20; v < 31; ++v)
    for (int u = 0; u < 200; ++u) set(picture, u, v, kGreen);
  EXPECT_EQ(floorTopOf(picture.view(), ColourTable({})), 60.0);
  EXPECT_EQ(floorTopOf(pictureOf(200, 160, kBlack).view(), ColourTable({})), 80.0) << "no floor";
  picture = pictureOf(600, 160, kGreen);  // read as grey, three times as many pixels as it has
  EXPECT_EQ(floorTopOf({{600, 160}, PixelFormat::kGrey, picture.pixels.data()}, ColourTable({})),
            80.0)
      << "grey has no green";
}

TEST(FindBlobs, GivesBoxMiddleAndAreaTheLargestFirst) {
  Picture picture = pictureOf(100, 80, kGreen);
  const auto box = [&](int u0, int v0, int width, int height) {
    for (int v = v0; v < v0 + height; ++v)
      for (int u = u0; u < u0 + width; ++u) set(picture, u, v, kYellow);
  };
  box(10, 20, 5, 3);
  box(50, 40, 10, 20);
  box(15, 23, 2, 2);  // touches the first one at a corner: it is one part
  box(90, 70, 2, 2);
  const auto blobs = findBlobs(picture.view(), ColourTable({}), ColourClass::kBall, 5);
  ASSERT_EQ(blobs.size(), 2u) << "one is too small";
  EXPECT_EQ(blobs[0].pixels, 200.0);
  EXPECT_EQ(blobs[0].middle.u, 54.5);
  EXPECT_EQ(blobs[0].middle.v, 49.5);
  EXPECT_EQ(blobs[0].uMin, 50.0);
  EXPECT_EQ(blobs[0].uMax, 60.0);
  EXPECT_EQ(blobs[0].vMin, 40.0);
  EXPECT_EQ(blobs[0].vMax, 60.0);
  EXPECT_EQ(blobs[1].pixels, 19.0);
  EXPECT_EQ(blobs[1].uMax, 17.0);
  EXPECT_EQ(blobs[1].vMax, 25.0);
  EXPECT_EQ(findBlobs(picture.view(), ColourTable({}), ColourClass::kFloor, 5).size(), 1u);
}

// Of a picture of more than 100000 pixels every second row and column is used.
TEST(FindBlobs, LargePicturesAreThinnedOut) {
  Picture picture = pictureOf(400, 300, kGreen);
  for (int v = 100; v < 140; ++v)
    for (int u = 200; u < 220; ++u) set(picture, u, v, kYellow);
  const auto blobs = findBlobs(picture.view(), ColourTable({}), ColourClass::kBall, 5);
  ASSERT_EQ(blobs.size(), 1u);
  EXPECT_EQ(blobs[0].pixels, 800.0);
  EXPECT_EQ(blobs[0].uMin, 200.0);
  EXPECT_EQ(blobs[0].uMax, 220.0);
  EXPECT_EQ(blobs[0].vMax, 140.0);
}

FieldLine arcOf(double radiusX, double radiusY, double from, double to, double angle) {
  FieldLine line;
  line.shape = FieldLine::Shape::kArc;
  line.x = 1.0, line.y = 2.0, line.radiusX = radiusX, line.radiusY = radiusY;
  line.from = from, line.to = to, line.angle = angle, line.width = 0.1;
  return line;
}

// A quarter circle of radius 2 around (1, 2), from ahead to the left, turned by a quarter: it goes
// from (1, 4) to (-1, 2).
TEST(FieldLines, ArcsEndAtTheirEnds) {
  const FieldLine arc = arcOf(2, 2, 0, kPi / 2, kPi / 2);
  const FieldLines field({&arc, 1});
  const auto on = field.nearest(1 - 3 * std::sqrt(0.5), 2 + 3 * std::sqrt(0.5));
  EXPECT_NEAR(on.distance, 1.0, 1e-9);
  EXPECT_NEAR(on.x, 1 - 2 * std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(on.y, 2 + 2 * std::sqrt(0.5), 1e-9);
  const auto begin = field.nearest(3, 4.5);
  EXPECT_NEAR(begin.x, 1.0, 1e-9);
  EXPECT_NEAR(begin.y, 4.0, 1e-9);
  EXPECT_NEAR(begin.distance, std::hypot(2, 0.5), 1e-9);
  const auto end = field.nearest(-1.5, 0);
  EXPECT_NEAR(end.x, -1.0, 1e-9);
  EXPECT_NEAR(end.y, 2.0, 1e-9);
  EXPECT_EQ(field.xMin(), -1.0);
  EXPECT_EQ(field.xMax(), 3.0);
  EXPECT_EQ(field.yMin(), 0.0);
  EXPECT_EQ(field.yMax(), 4.0);
}

TEST(FieldLines, EllipsesAreNearestAtTheirAxes) {
  const FieldLine ellipse = arcOf(3, 1, 0, 2 * kPi, 0);
  const FieldLines field({&ellipse, 1});
  EXPECT_NEAR(field.nearest(6, 2).distance, 2.0, 1e-9);
  EXPECT_NEAR(field.nearest(-3, 2).distance, 1.0, 1e-9);
  EXPECT_NEAR(field.nearest(1, 4.5).distance, 1.5, 1e-9);
  EXPECT_NEAR(field.nearest(1, 0.5).distance, 0.5, 1e-9);
}

TEST(FieldLines, WhatHasNoWidthIsNoLine) {
  FieldLine border = arcOf(2, 2, 0, 2 * kPi, 0);
  border.width = 0.0;
  FieldLine dot;  // a line without a length is a point
  dot.x0 = dot.x1 = 5, dot.y0 = dot.y1 = 6, dot.width = 0.1;
  const std::vector<FieldLine> lines{border, dot};
  const FieldLines field(lines);
  EXPECT_EQ(field.lines().size(), 1u);
  EXPECT_NEAR(field.nearest(2, 2).distance, 5.0, 1e-9);
  EXPECT_THROW(FieldLines({&border, 1}), std::invalid_argument);
  EXPECT_THROW(FieldLines(std::vector<FieldLine>(10001, dot)), std::invalid_argument);
  EXPECT_NO_THROW(FieldLines(std::vector<FieldLine>(10000, dot)));
}

}  // namespace
}  // namespace ortung
