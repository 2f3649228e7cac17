#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "DecodedPng.hpp"
#include "FieldCanvas.hpp"
#include "FieldMarks.hpp"
#include "Palette.hpp"

namespace ortung::app {
namespace {

constexpr int kLeft = 100;
constexpr int kTop = 40;

/// A field of 10 m x 7 m with its lower left corner at (0, -1), 48 pixels a metre, on white paper.
class FieldCanvasTest : public testing::Test {
 protected:
  const FieldGrid grid_{0.0, -1.0, 0.25, 40, 28};
  Picture picture_{700, 440, palette::kPaper};
  FieldCanvas canvas_{picture_, grid_, kLeft, kTop, 12};

  static constexpr int kBottom = kTop + 336;
  static int atX(double x) { return kLeft + static_cast<int>(std::lround(48.0 * x)); }
  static int atY(double y) { return kTop + static_cast<int>(std::lround(48.0 * (6.0 - y))); }
  DecodedPng png() const { return DecodedPng(picture_.png()); }
};

TEST_F(FieldCanvasTest, PixelsFollowMetresWithYUpwards) {
  EXPECT_EQ(canvas_.width(), 480);
  EXPECT_EQ(canvas_.height(), 336);
  EXPECT_DOUBLE_EQ(canvas_.pixelX(0.0), kLeft);
  EXPECT_DOUBLE_EQ(canvas_.pixelX(2.5), kLeft + 120.0);
  EXPECT_DOUBLE_EQ(canvas_.pixelY(-1.0), kBottom);
  EXPECT_DOUBLE_EQ(canvas_.pixelY(6.0), kTop);
  EXPECT_DOUBLE_EQ(canvas_.pixelY(5.0), kTop + 48.0);
}

// A label needs 80 pixels, so there are at most six in x and four in y.
TEST_F(FieldCanvasTest, TicksAreFivePixelsAtRoundMetres) {
  canvas_.axes();
  const DecodedPng png = this->png();
  const auto ticks = [&](int first, int last, const auto& isInk) {
    std::set<int> found;
    for (int at = first; at <= last; ++at)
      if (isInk(at)) found.insert(at);
    return found;
  };
  const std::set<int> across = {atX(0), atX(2), atX(4), atX(6), atX(8), atX(10)};
  const std::set<int> upwards = {atY(0), atY(5)};
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(ticks(60, 690, [&](int x) { return png.is(x, kBottom + i, palette::kInk); }), across);
    EXPECT_EQ(ticks(20, kBottom, [&](int y) { return png.is(kLeft - 1 - i, y, palette::kInk); }),
              upwards);
  }
  EXPECT_TRUE(ticks(60, 690, [&](int x) { return png.is(x, kBottom + 5, palette::kInk); }).empty());
  EXPECT_TRUE(
      ticks(20, kBottom, [&](int y) { return png.is(kLeft - 6, y, palette::kInk); }).empty());
}

// The font's own pixels tell where a label stands: drawn again over it, nothing changes.
TEST_F(FieldCanvasTest, LabelsStandInTheMiddleOfTheirTicks) {
  canvas_.axes();
  const auto before = picture_.png();
  const auto width = [](const std::string& text) { return Picture::textWidth(2, text); };
  for (const int x : {0, 4, 10}) {
    const std::string text = std::to_string(x);
    picture_.text(atX(x) - width(text) / 2, kBottom + 8, 2, palette::kInk, text);
  }
  for (const int y : {0, 5}) {
    const std::string text = std::to_string(y);
    picture_.text(kLeft - 9 - width(text), atY(y) - 8, 2, palette::kInk, text);
  }
  picture_.text(kLeft + 240 - width("x [m]") / 2, kBottom + 30, 2, palette::kInk, "x [m]");
  picture_.text(4, kTop - 22, 2, palette::kInk, "y [m]");
  EXPECT_TRUE(picture_.png() == before);
}

TEST_F(FieldCanvasTest, TheMarkOfTheTruthPointsWhereTheRobotLooks) {
  const double x = 5.0;
  const double y = 1.5;
  for (const int quarter : {0, 1, 2, 3}) {
    Picture picture(700, 440, palette::kPaper);
    const FieldCanvas canvas(picture, grid_, kLeft, kTop, 12);
    canvas.truth({x, y, quarter * std::numbers::pi / 2});
    const DecodedPng png(picture.png());
    const int dx[] = {1, 0, -1, 0};
    const int dy[] = {0, -1, 0, 1};
    for (int side = 0; side < 4; ++side) {
      const auto isMarked = [&](int pixels) {
        return png.is(atX(x) + pixels * dx[side], atY(y) + pixels * dy[side], palette::kTruth);
      };
      EXPECT_TRUE(isMarked(14)) << "the ring, of 12 to 15 pixels";
      EXPECT_FALSE(isMarked(11)) << "its middle is free";
      for (const int pixels : {20, 25, 31})
        EXPECT_EQ(isMarked(pixels), side == quarter) << side << " " << quarter;
      EXPECT_FALSE(isMarked(35)) << "the pointer ends at 31.5 pixels";
    }
  }
}

TEST_F(FieldCanvasTest, WhatLiesOutsideIsNotDrawn) {
  const auto before = picture_.png();
  canvas_.truth({10.1, 0.0, 0.0});
  canvas_.truth({5.0, -1.1, 0.0});
  canvas_.truth({5.0, 1.0, std::nan("")});
  FieldModel field;
  field.landmarks = {{1, "post", -0.1, 0.0, 0.0}, {2, "post", 5.0, 6.1, 0.0}};
  canvas_.field(field);
  EXPECT_TRUE(picture_.png() == before);
}

TEST_F(FieldCanvasTest, TheBestCellIsFramedOutsideOfItsPixels) {
  canvas_.best(5.0, 1.5);  // half of 12 pixels, and 3 around
  const DecodedPng png = this->png();
  for (const int side : {-1, 1}) {
    EXPECT_TRUE(png.is(atX(5.0) + 9 * side, atY(1.5), palette::kBest));
    EXPECT_TRUE(png.is(atX(5.0), atY(1.5) + 9 * side, palette::kBest));
    EXPECT_FALSE(png.is(atX(5.0) + 6 * side, atY(1.5), palette::kBest));
    EXPECT_FALSE(png.is(atX(5.0) + 12 * side, atY(1.5), palette::kBest));
  }
  Picture small(100, 100, palette::kPaper);
  const FieldGrid fine{0.0, 0.0, 1.0, 100, 100};
  FieldCanvas(small, fine, 0, 0, 1).best(50.0, 50.0);
  EXPECT_TRUE(DecodedPng(small.png()).is(56, 50, palette::kBest)) << "at least 6 pixels away";
}

TEST_F(FieldCanvasTest, LabelsOfLandmarksStandOnTheSideThatIsFree) {
  FieldModel field;
  field.landmarks = {{4, "post", 9.95, 1.0, 0.0}, {5, "post", 3.0, 1.0, 0.0}};
  canvas_.field(field);
  const auto before = picture_.png();
  const int width = Picture::textWidth(2, "4");
  picture_.text(atX(9.95) - 9 - width, atY(1.0) - 7, 2, palette::kInk, "4");
  picture_.text(atX(3.0) + 10, atY(1.0) - 7, 2, palette::kInk, "5");
  EXPECT_TRUE(picture_.png() == before);
}

TEST(FieldMarks, AStraightLineHasItsEnds) {
  FieldLine line;
  line.x0 = 1.0;
  line.y0 = 2.0;
  line.x1 = -3.0;
  line.y1 = 4.0;
  const std::vector<std::array<double, 2>> expected = {{1.0, 2.0}, {-3.0, 4.0}};
  EXPECT_EQ(pointsOf(line), expected);
}

// Half an ellipse of 2 m x 1 m around (2, 1), turned by 90 degrees.
TEST(FieldMarks, AnArcFollowsItsEllipse) {
  FieldLine arc;
  arc.shape = FieldLine::Shape::kArc;
  arc.x = 2.0;
  arc.y = 1.0;
  arc.radiusX = 2.0;
  arc.radiusY = 1.0;
  arc.angle = std::numbers::pi / 2;
  arc.from = 0.0;
  arc.to = std::numbers::pi;
  const auto points = pointsOf(arc);
  ASSERT_EQ(points.size(), 49u);
  const auto expectAt = [&](std::size_t i, double x, double y) {
    EXPECT_NEAR(points[i][0], x, 1e-12) << i;
    EXPECT_NEAR(points[i][1], y, 1e-12) << i;
  };
  expectAt(0, 2.0, 3.0);
  expectAt(24, 1.0, 1.0);
  expectAt(48, 2.0, -1.0);
  expectAt(8, 1.5, 1.0 + std::sqrt(3.0));  // t = 30 degrees
  for (const auto& [x, y] : points)
    EXPECT_NEAR(std::pow(x - 2.0, 2) + std::pow((y - 1.0) / 2.0, 2), 1.0, 1e-12);
}

}  // namespace
}  // namespace ortung::app
