#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ortung/base/Random.hpp"
#include "ortung/calibration/ImageFile.hpp"
#include "ortung/vision/BlobFinder.hpp"
#include "ortung/vision/LineFinder.hpp"

namespace ortung {
namespace {

using Colour = std::array<int, 3>;
constexpr Colour kGreen{40, 140, 60};
constexpr Colour kWhite{230, 235, 228};
constexpr Colour kBlack{15, 15, 15};
constexpr Colour kYellow{220, 190, 40};

/// A green floor with noise.
Picture floorOf(int width, int height, Random& random) {
  Picture picture{{width, height}, {}};
  for (int i = 0; i < width * height; ++i)
    for (const int channel : kGreen)
      picture.pixels.push_back(
          static_cast<std::uint8_t>(channel + static_cast<int>(random.uniform(-6.0, 6.0))));
  return picture;
}

/// Paints what lies within, with soft edges; inside(u, v) is how deep a pixel lies in it [px].
template <typename Inside>
void paint(Picture& picture, const Colour& colour, const Inside& inside) {
  for (int v = 0; v < picture.size.height; ++v)
    for (int u = 0; u < picture.size.width; ++u) {
      const double share = std::clamp(inside(u, v) + 0.5, 0.0, 1.0);
      std::uint8_t* p = picture.pixels.data() + 3 * (v * picture.size.width + u);
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = static_cast<std::uint8_t>(std::lround(p[k] + share * (colour[k] - p[k])));
    }
}

std::vector<LinePoint> find(const Picture& picture) {
  const ImageView view = picture.view();
  LineFinder finder({});
  const auto points = finder.find(view, ColourTable(findColours({&view, 1})));
  return {points.begin(), points.end()};
}

TEST(LineFinder, FindsTheMiddleOfALineToAFractionOfAPixel) {
  Random random(5);
  for (const double width : {2.0, 5.0, 14.0, 40.0}) {
    Picture picture = floorOf(400, 300, random);
    const double slope = 0.35;
    const auto across = [&](double u, double v) {
      return (v - 140.0 - slope * (u - 200.0)) / std::hypot(1.0, slope);
    };
    paint(picture, kWhite, [&](int u, int v) { return width / 2.0 - std::abs(across(u, v)); });
    const auto points = find(picture);
    ASSERT_GT(points.size(), 40U) << width;
    double sum = 0.0;
    for (const LinePoint& p : points) {
      EXPECT_LT(std::abs(across(p.pixel.u, p.pixel.v)), 1.0) << width;
      sum += across(p.pixel.u, p.pixel.v);
    }
    EXPECT_NEAR(sum / static_cast<double>(points.size()), 0.0, 0.15) << width;
  }
}

TEST(LineFinder, FindsNothingOnBareFloorInADarkHallOrInAGreyPicture) {
  Random random(6);
  EXPECT_TRUE(find(floorOf(400, 300, random)).empty());
  Picture dark{{200, 100}, std::vector<std::uint8_t>(200 * 100 * 3, 3)};
  EXPECT_TRUE(find(dark).empty());
  const std::vector<std::uint8_t> grey(100 * 50, 200);
  LineFinder finder({});
  EXPECT_TRUE(
      finder.find({{100, 50}, PixelFormat::kGrey, grey.data()}, ColourTable(Colours{})).empty());
}

TEST(LineFinder, WhiteWallsBlackRobotsAndYellowBallsAreNoLines) {
  Random random(7);
  Picture picture = floorOf(400, 300, random);
  paint(picture, kWhite, [](int, int v) { return 60.0 - v; });
  paint(picture, kBlack, [](int u, int v) { return 30.0 - std::hypot(u - 100, v - 180); });
  paint(picture, kYellow, [](int u, int v) { return 12.0 - std::hypot(u - 250, v - 200); });
  EXPECT_TRUE(find(picture).empty());
}

TEST(LineFinder, AWallBeforeALineDoesNotHideIt) {
  Random random(8);
  Picture picture = floorOf(400, 300, random);
  paint(picture, kWhite, [](int, int v) { return 20.0 - std::abs(v - 40); });  // too wide
  paint(picture, kWhite, [](int, int v) { return 3.0 - std::abs(v - 72); });
  std::size_t found = 0;
  for (const LinePoint& p : find(picture)) found += std::abs(p.pixel.v - 72.0) < 1.0 ? 1 : 0;
  EXPECT_GT(found, 55U);
}

/// A floor with a line of 1.6 px across it, which is mostly the floor's colour and a little of
/// another one.
Picture faintLine(const Colour& colour, Random& random, double from, double to) {
  Picture picture = floorOf(400, 300, random);
  Colour mixed = kGreen;
  for (std::size_t k = 0; k < 3; ++k) mixed[k] += (colour[k] - kGreen[k]) / 14;
  paint(picture, mixed, [&](int u, int v) {
    return u < from || u > to ? -9.0 : 0.8 - std::abs(v - 140.0 - 0.1 * (u - 200.0));
  });
  return picture;
}

std::size_t countOn(const std::vector<LinePoint>& points) {
  return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [](const LinePoint& p) {
        return std::abs(p.pixel.v - 140.0 - 0.1 * (p.pixel.u - 200.0)) < 1.0;
      }));
}

TEST(LineFinder, FindsThinFaintLinesWhereManyScanLinesCrossThem) {
  Random random(11);
  const Picture picture = faintLine(kWhite, random, 50, 350);
  const auto points = find(picture);
  EXPECT_GT(countOn(points), 42U);  // of 50 columns
  EXPECT_EQ(countOn(points), points.size());
  const ImageView view = picture.view();
  LineFinder bold({.findsFaint = false});
  EXPECT_LT(bold.find(view, ColourTable(findColours({&view, 1}))).size(), 10U);
}

TEST(LineFinder, AShortFaintMarkOrAStreakOfLightIsNoLine) {
  Random random(12);
  EXPECT_TRUE(find(faintLine(kWhite, random, 190, 215)).empty()) << "four columns";
  // Light makes all channels of the floor brighter alike.
  EXPECT_TRUE(find(faintLine({80, 280, 120}, random, 50, 350)).empty());
}

TEST(FindColours, TakesTheFloorAsItIsInBluishAndInYellowishLight) {
  for (const Colour& green : {Colour{20, 150, 120}, Colour{90, 140, 50}}) {
    Picture picture{{100, 100}, {}};
    for (int i = 0; i < 100 * 100; ++i)
      for (const int channel : green)
        picture.pixels.push_back(static_cast<std::uint8_t>(channel + i % 5));
    const ImageView view = picture.view();
    const ColourTable table(findColours({&view, 1}));
    EXPECT_TRUE(table.isFloor(picture.pixels.data()));
    const std::uint8_t white[3] = {230, 230, 230};
    EXPECT_FALSE(table.isFloor(white));
  }
}

TEST(FindBalls, FindsABallWhereItLies) {
  Random random(9);
  Picture picture = floorOf(640, 480, random);
  Parameters p("camera");
  p.set("size_px", std::vector<double>{640, 480});
  p.set("focal_px", std::vector<double>{400, 400});
  const CameraView view(readCamera(p), {.z = 0.8, .tilt = 0.35});
  const auto middle = view.pixelOf({2.0, 0.4, 0.11});
  const auto side = view.pixelOf({2.0, 0.51, 0.11});
  const double radius = std::hypot(side->u - middle->u, side->v - middle->v);
  paint(picture, kYellow,
        [&](int u, int v) { return radius - std::hypot(u - middle->u, v - middle->v); });
  // The same disc far up would be as large as a house.
  paint(picture, kYellow, [&](int u, int v) { return radius - std::hypot(u - 500, v - 70); });
  const ImageView image = picture.view();
  const auto balls = findBalls(image, ColourTable(findColours({&image, 1})), view, 0.11, 10.0);
  ASSERT_EQ(balls.size(), 1U);
  EXPECT_NEAR(balls[0].range, std::hypot(2.0, 0.4), 0.03);
  EXPECT_NEAR(balls[0].bearing, std::atan2(0.4, 2.0), 0.01);
}

}  // namespace
}  // namespace ortung
