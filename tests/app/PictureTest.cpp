#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "DecodedPng.hpp"
#include "Palette.hpp"
#include "Picture.hpp"

namespace ortung::app {
namespace {

constexpr Colour kWhite{255, 255, 255};
constexpr Colour kRed{200, 10, 30};

using Pixels = std::set<std::pair<int, int>>;

/// The pixels of a white picture that something was drawn into.
Pixels drawnIn(const Picture& picture) {
  const DecodedPng png(picture.png());
  EXPECT_EQ(png.width, picture.width());
  EXPECT_EQ(png.height, picture.height());
  Pixels drawn;
  for (int y = 0; y < png.height; ++y)
    for (int x = 0; x < png.width; ++x)
      if (!png.is(x, y, kWhite)) drawn.insert({x, y});
  return drawn;
}

/// All pixels of the rectangle with these corners, both included.
Pixels block(int left, int top, int right, int bottom) {
  Pixels all;
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) all.insert({x, y});
  return all;
}

Pixels lineOf(double x0, double y0, double x1, double y1, int thickness) {
  Picture picture(12, 9, kWhite);
  picture.line(x0, y0, x1, y1, thickness, kRed);
  return drawnIn(picture);
}

TEST(Picture, PixelsHaveTheirColoursAtTheirPlaces) {
  Picture picture(3, 2, {1, 2, 3});
  picture.set(2, 0, {10, 20, 30});
  picture.set(0, 1, {40, 50, 60});
  const DecodedPng png(picture.png());
  EXPECT_TRUE(png.is(2, 0, {10, 20, 30}));
  EXPECT_TRUE(png.is(0, 1, {40, 50, 60}));
  for (const auto& [x, y] : Pixels{{0, 0}, {1, 0}, {1, 1}, {2, 1}})
    EXPECT_TRUE(png.is(x, y, {1, 2, 3})) << x << " " << y;
}

TEST(Picture, DrawingsAreClippedAtTheBorder) {
  Picture picture(5, 4, kWhite);
  for (const auto& [x, y] : Pixels{{-1, 0}, {5, 0}, {0, -1}, {0, 4}}) picture.set(x, y, kRed);
  EXPECT_EQ(drawnIn(picture), Pixels{});
  picture.fill(-2, -1, 4, 3, kRed);
  EXPECT_EQ(drawnIn(picture), block(0, 0, 1, 1));
  picture.fill(4, 3, 10, 10, kRed);
  Pixels both = block(0, 0, 1, 1);
  both.insert({4, 3});
  EXPECT_EQ(drawnIn(picture), both);
  picture.fill(2, 0, 0, 4, kRed);
  EXPECT_EQ(drawnIn(picture), both) << "nothing is as wide as 0";
}

TEST(Picture, LinesHaveBothEndsAndTheirThickness) {
  EXPECT_EQ(lineOf(2, 4, 6, 4, 1), block(2, 4, 6, 4));
  EXPECT_EQ(lineOf(6, 4, 2, 4, 1), block(2, 4, 6, 4));
  EXPECT_EQ(lineOf(3, 1, 3, 7, 1), block(3, 1, 3, 7));
  EXPECT_EQ(lineOf(4, 4, 7, 4, 3), block(3, 3, 8, 5));
  EXPECT_EQ(lineOf(4, 4, 7, 4, 2), block(3, 3, 7, 4));
  EXPECT_EQ(lineOf(5, 5, 5, 5, 1), block(5, 5, 5, 5));
  EXPECT_EQ(lineOf(1.6, 2.4, 1.6, 2.4, 1), block(2, 2, 2, 2));
  Pixels diagonal;
  for (int i = 1; i <= 6; ++i) diagonal.insert({i, i});
  EXPECT_EQ(lineOf(1, 1, 6, 6, 1), diagonal);
}

TEST(Picture, OfLinesFromAfarOnlyThePartWithinIsDrawn) {
  EXPECT_EQ(lineOf(-1e12, 2, 1e12, 2, 1), block(0, 2, 11, 2));
  EXPECT_EQ(lineOf(5, -1e12, 5, 3, 1), block(5, 0, 5, 3));
  EXPECT_EQ(lineOf(5, 3, 5, 1e12, 1), block(5, 3, 5, 8));
  EXPECT_EQ(lineOf(-3, -9, 15, -9, 1), Pixels{});
  EXPECT_EQ(lineOf(30, -9, 30, 50, 1), Pixels{});
  EXPECT_EQ(lineOf(-20, 8, 5, -20, 1), Pixels{}) << "it passes the corner";
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(lineOf(0, 0, infinity, 0, 1), Pixels{});
  EXPECT_EQ(lineOf(0, std::nan(""), 5, 5, 1), Pixels{});
}

TEST(Picture, ARingHasThePixelsBetweenItsTwoCircles) {
  Picture picture(30, 30, kWhite);
  picture.ring(14.6, 13.4, 8.0, 3, kRed);
  Pixels expected;
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 30; ++x) {
      const double away = std::hypot(x - 15, y - 13);
      if (away >= 5.0 && away <= 8.0) expected.insert({x, y});
    }
  }
  EXPECT_EQ(drawnIn(picture), expected);
}

TEST(Picture, TextOfTwiceTheSizeHasEachPixelFourTimes) {
  Picture small(80, 20, kWhite);
  small.text(3, 2, 1, kRed, "Ag9 [m]");
  Picture large(160, 40, kWhite);
  large.text(6, 4, 2, kRed, "Ag9 [m]");
  Pixels expected;
  for (const auto& [x, y] : drawnIn(small))
    for (const auto& pixel : block(2 * x, 2 * y, 2 * x + 1, 2 * y + 1)) expected.insert(pixel);
  EXPECT_GT(expected.size(), 200u);
  EXPECT_EQ(drawnIn(large), expected);
}

TEST(Picture, TextIsAsWideAsItSays) {
  for (const std::string text : {"i", "Position", "-0.25"}) {
    EXPECT_EQ(Picture::textWidth(3, text), 3 * Picture::textWidth(1, text));
    Picture picture(200, 30, kWhite);
    picture.text(10, 4, 2, kRed, text);
    const Pixels drawn = drawnIn(picture);
    ASSERT_FALSE(drawn.empty());
    EXPECT_GE(drawn.begin()->first, 10) << text;
    EXPECT_LT(drawn.rbegin()->first, 10 + Picture::textWidth(2, text)) << text;
    EXPECT_GE(drawn.rbegin()->first, 10 + Picture::textWidth(2, text) - 6) << text;
  }
}

TEST(Picture, LettersThatTheFontLacksAreQuestionMarks) {
  const auto written = [](const std::string& text) {
    Picture picture(60, 20, kWhite);
    picture.text(2, 2, 1, kRed, text);
    return drawnIn(picture);
  };
  EXPECT_EQ(written("a\x1F"
                    "b"),
            written("a?b"));
  EXPECT_EQ(written("a\xE4"
                    "b"),
            written("a?b"));
  EXPECT_EQ(written("a\x7F"
                    "b"),
            written("a?b"));
  EXPECT_NE(written("a~b"), written("a?b"));
  EXPECT_NE(written("a b"), written("a?b"));
}

bool isSame(Colour a, Colour b) { return a.red == b.red && a.green == b.green && a.blue == b.blue; }

// ColorBrewer's YlGnBu with nine colours, and matplotlib's plasma at eighths, darkest last.
TEST(Palette, ScalesHaveThePublishedColoursAndMiddlesBetweenThem) {
  EXPECT_TRUE(isSame(palette::sequential(0.0), {255, 255, 217}));
  EXPECT_TRUE(isSame(palette::sequential(0.5), {65, 182, 196}));
  EXPECT_TRUE(isSame(palette::sequential(1.0), {8, 29, 88}));
  EXPECT_TRUE(isSame(palette::sequential(1.0 / 16), {246, 252, 197}));
  EXPECT_TRUE(isSame(palette::sequential(15.0 / 16), {23, 41, 118}));
  EXPECT_TRUE(isSame(palette::quality(0.0), {240, 249, 33}));
  EXPECT_TRUE(isSame(palette::quality(0.5), {180, 47, 139}));
  EXPECT_TRUE(isSame(palette::quality(1.0), {13, 8, 135}));
}

TEST(Palette, SharesOutsideAreThoseOfTheEnds) {
  EXPECT_TRUE(isSame(palette::sequential(-0.5), palette::sequential(0.0)));
  EXPECT_TRUE(isSame(palette::sequential(1.5), palette::sequential(1.0)));
  EXPECT_TRUE(isSame(palette::quality(-1e9), palette::quality(0.0)));
  EXPECT_TRUE(isSame(palette::quality(1e9), palette::quality(1.0)));
}

}  // namespace
}  // namespace ortung::app
