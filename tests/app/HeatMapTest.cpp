#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "DecodedPng.hpp"
#include "HeatMap.hpp"
#include "Palette.hpp"

namespace ortung::app {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

FieldRegion openRegion(int columns, int rows) {
  FieldRegion region;
  region.grid = {-1.0, 2.0, 0.5, columns, rows};
  region.open.assign(region.grid.size(), 1);
  region.standable = region.open;
  return region;
}

/// A strip of four open cells and one solid one at the end.
FieldRegion strip() {
  FieldRegion region = openRegion(5, 1);
  region.open.back() = 0;
  return region;
}

HeatMap mapOf(const FieldRegion& region, std::vector<double> values) {
  HeatMap map;
  map.region = &region;
  map.values = std::move(values);
  return map;
}

/// The colour in the middle of a cell of the picture; rows are counted upwards, as in the grid.
Colour colourOf(const DecodedPng& png, const FieldRegion& region, int column, int row) {
  const FoundField field(png);
  const int cell = field.width / region.grid.columns;
  EXPECT_EQ(cell * region.grid.columns, field.width);
  EXPECT_EQ(cell * region.grid.rows, field.height) << "both axes have one scale";
  return png.at(field.left + column * cell + cell / 2,
                field.top + field.height - 1 - row * cell - cell / 2);
}

TEST(HeatMap, ScaleEndsAtTheLeastAndGreatestValueOfOpenCells) {
  const FieldRegion region = strip();
  const HeatMap map = mapOf(region, {2.0, kNan, 5.0, 3.0, 99.0});
  EXPECT_EQ(map.scale().low, 2.0);
  EXPECT_EQ(map.scale().high, 5.0);
  EXPECT_EQ(map.legend(4), (std::vector<double>{2.0, 3.0, 4.0, 5.0}));
  EXPECT_EQ(map.best(), 2u);
}

TEST(HeatMap, LogarithmicLegendIsEvenInLogarithmsAndLeavesOutZero) {
  const FieldRegion region = strip();
  HeatMap map = mapOf(region, {0.01, 0.0, 1.0, 0.5, 7.0});
  map.logarithmic = true;
  const std::vector<double> legend = map.legend(3);
  EXPECT_NEAR(legend[0], 0.01, 1e-12);
  EXPECT_NEAR(legend[1], 0.1, 1e-12);
  EXPECT_NEAR(legend[2], 1.0, 1e-12);
}

TEST(HeatMap, ALogarithmicScaleBeginsWhereATwentiethOfTheCellsLieBelow) {
  const FieldRegion region = openRegion(20, 5);
  std::vector<double> values(100, 0.1);
  for (std::size_t i = 0; i < 5; ++i) values[i] = 1e-200;
  values[50] = 1.0;
  HeatMap map = mapOf(region, values);
  map.logarithmic = true;
  EXPECT_EQ(map.scale().low, 0.1);
  map.values[5] = 1e-200;
  EXPECT_EQ(map.scale().low, 1e-200);
}

TEST(HeatMap, EachValueHasItsColourAtItsPlace) {
  // Nothing in this map is symmetric: exchanged axes and mirrored ones show.
  const FieldRegion region = openRegion(7, 4);
  std::vector<double> values;
  for (int i = 0; i < 28; ++i) values.push_back((i * i * 37) % 101);
  const HeatMap map = mapOf(region, values);
  const DecodedPng png(draw(map).png());
  const double low = *std::min_element(values.begin(), values.end());
  const double high = *std::max_element(values.begin(), values.end());
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 7; ++column) {
      const double value = values[static_cast<std::size_t>(row * 7 + column)];
      EXPECT_NEAR(darknessOf(colourOf(png, region, column, row)), (value - low) / (high - low),
                  0.01)
          << column << ", " << row;
    }
  }
}

TEST(HeatMap, ALogarithmicScaleIsEvenInDecades) {
  const FieldRegion region = openRegion(5, 1);
  HeatMap map = mapOf(region, {1e-8, 1e-6, 1e-4, 1e-2, 1.0});
  map.logarithmic = true;
  const DecodedPng png(draw(map).png());
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(darknessOf(colourOf(png, region, i, 0)), 0.25 * i, 0.01) << i;
}

TEST(HeatMap, CellsWithoutValueAndSolidOnesHaveColoursThatNoValueHas) {
  const FieldRegion region = strip();
  const DecodedPng png(draw(mapOf(region, {0.0, kNan, 2.0, 3.0, 1.0})).png());
  EXPECT_EQ(darknessOf(colourOf(png, region, 1, 0)), -1.0);
  EXPECT_EQ(darknessOf(colourOf(png, region, 4, 0)), -1.0);
  EXPECT_EQ(colourOf(png, region, 1, 0).red, palette::kNoValue.red);
  EXPECT_EQ(colourOf(png, region, 4, 0).red, palette::kSolid.red);
}

TEST(HeatMap, ColoursOnlyGetDarker) {
  double last = 256.0;
  for (int i = 0; i <= 100; ++i) {
    const Colour c = palette::sequential(0.01 * i);
    const double luminance = 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;
    EXPECT_LT(luminance, last) << i;
    last = luminance;
    EXPECT_NEAR(darknessOf(c), 0.01 * i, 0.01);
  }
}

TEST(HeatMap, MarksLeaveFreeWhatLiesInThem) {
  const FieldRegion region = openRegion(200, 150);
  HeatMap map = mapOf(region, std::vector<double>(region.grid.size(), 0.0));
  const double x = 41.75;  // middle of column 85
  const double y = 19.25;  // middle of row 34
  const auto cell = static_cast<std::size_t>(region.grid.cellAt(x, y));
  map.values[cell] = 1.0;
  map.truth = Pose2{x, y, 0.0};
  map.marksBest = true;
  const DecodedPng png(draw(map).png());
  const FoundField field(png);
  EXPECT_NEAR(darknessOf(colourOf(png, region, 85, 34)), 1.0, 0.01) << "the peak is seen";
  const double zoom = field.width / 200.0;
  const int middleX = field.left + static_cast<int>(85.5 * zoom);
  const int middleY = field.top + static_cast<int>((150 - 34.5) * zoom);
  EXPECT_TRUE(png.is(middleX + 25, middleY, palette::kTruth)) << "heading 0 points to the right";
  EXPECT_FALSE(png.is(middleX - 25, middleY, palette::kTruth));
  EXPECT_TRUE(png.is(middleX, middleY + 14, palette::kTruth));
  EXPECT_TRUE(png.is(middleX, middleY - 14, palette::kTruth));
  int black = 0;
  for (int i = 4; i < 10; ++i) black += png.is(middleX, middleY + i, palette::kBest);
  EXPECT_GE(black, 1) << "the square around the best cell";
}

TEST(HeatMap, LandmarksLieWhereTheFieldModelSays) {
  const FieldRegion region = openRegion(40, 30);  // x from -1 to 19 m, y from 2 to 17 m
  FieldModel model;
  model.landmarks = {{7, "post", 3.0, 15.0, 0.0}, {8, "post", 100.0, 15.0, 0.0}};
  HeatMap map = mapOf(region, std::vector<double>(region.grid.size(), 0.5));
  map.field = &model;
  const DecodedPng png(draw(map).png());
  const FoundField field(png);
  EXPECT_TRUE(
      png.is(field.left + field.width / 5, field.top + field.height * 2 / 15, palette::kLandmark));
  int marks = 0;
  for (int y = field.top; y < field.top + field.height; ++y)
    for (int x = field.left; x < field.left + field.width; ++x)
      marks += png.is(x, y, palette::kLandmark);
  EXPECT_EQ(marks, 85) << "one diamond of 6 pixels to each side, none for what lies outside";
}

TEST(HeatMap, LinesOfTheFloorAreDrawn) {
  const FieldRegion region = openRegion(40, 30);
  FieldModel model;
  FieldLine line;
  line.x0 = 4.0;
  line.y0 = 4.5;
  line.x1 = 14.0;
  line.y1 = 4.5;
  model.lines = {line};
  line.x0 = -1e300;
  line.x1 = 1e300;
  line.y0 = line.y1 = 2.0e300;  // a hostile table file costs nothing
  model.lines.push_back(line);
  HeatMap map = mapOf(region, std::vector<double>(region.grid.size(), 0.5));
  map.field = &model;
  const DecodedPng png(draw(map).png());
  const FoundField field(png);
  const int y = field.top + field.height * 25 / 30;
  EXPECT_TRUE(png.is(field.left + field.width / 2, y, palette::kLine));
  EXPECT_FALSE(png.is(field.left + field.width / 5, y, palette::kLine));
}

TEST(HeatMap, IsPeakedWhereALinearScaleWouldShowNothing) {
  const FieldRegion region = openRegion(100, 10);
  std::vector<double> values(1000, 1e-9);
  values[123] = 1.0;
  EXPECT_TRUE(mapOf(region, values).isPeaked());
  for (std::size_t i = 0; i < 30; ++i) values[i] = 0.2;
  EXPECT_FALSE(mapOf(region, values).isPeaked());
}

TEST(HeatMap, DrawsWithoutAnyValue) {
  const FieldRegion region = strip();
  HeatMap map = mapOf(region, std::vector<double>(5, kNan));
  map.truth = Pose2{std::numeric_limits<double>::infinity(), 0.0, 0.0};
  map.marksBest = true;
  for (const bool logarithmic : {false, true}) {
    map.logarithmic = logarithmic;
    EXPECT_FALSE(draw(map).png().empty());
  }
}

}  // namespace
}  // namespace ortung::app
