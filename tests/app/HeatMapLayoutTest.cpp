// Where the parts of a heat map lie in its picture, and which values end its scale.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "DecodedPng.hpp"
#include "HeatMap.hpp"
#include "Palette.hpp"

namespace ortung::app {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kLeft = 86;  // of the field [pixels]
constexpr int kTop = 72;   // of the field, without a note
constexpr int kKeyLine = 48;

FieldRegion regionOf(int columns, int rows) {
  FieldRegion region;
  region.grid = {0.0, 0.0, 0.5, columns, rows};
  region.open.assign(region.grid.size(), 1);
  region.standable = region.open;
  return region;
}

HeatMap mapOf(const FieldRegion& region, std::vector<double> values) {
  HeatMap map;
  map.region = &region;
  map.values = std::move(values);
  return map;
}

HeatMap evenMap(const FieldRegion& region) {
  std::vector<double> values(region.grid.size(), 0.5);
  values.front() = 0.0;
  values.back() = 1.0;
  return mapOf(region, std::move(values));
}

/// Height of a picture of which the field has so many pixels, without a key.
int heightFor(int field) { return kTop + field + 62 + 76 + 16; }

TEST(HeatMapLayout, CellsAreAsLargeAsFitInto800By1000PixelsButNoLargerThan40) {
  const auto expectZoom = [](int columns, int rows, int zoom) {
    const FieldRegion region = regionOf(columns, rows);
    const Picture picture = draw(evenMap(region));
    const FoundField field(DecodedPng(picture.png()));
    EXPECT_EQ(field.width, columns * zoom) << columns << " x " << rows;
    EXPECT_EQ(field.height, rows * zoom) << columns << " x " << rows;
    EXPECT_EQ(field.left, kLeft);
    EXPECT_EQ(field.top, kTop);
    EXPECT_EQ(picture.width(), kLeft + std::max(columns * zoom, 400) + 32);
    EXPECT_EQ(picture.height(), heightFor(rows * zoom));
  };
  expectZoom(100, 10, 8);
  expectZoom(99, 10, 9);   // 8.08, rounded up
  expectZoom(40, 400, 3);  // 2.5, rounded up
  expectZoom(5, 4, 40);
  expectZoom(1000, 3, 1);
}

TEST(HeatMapLayout, ANoteMovesTheFieldDownByALine) {
  const FieldRegion region = regionOf(5, 4);
  HeatMap map = evenMap(region);
  map.note = "each cell: the best";
  EXPECT_EQ(FoundField(DecodedPng(draw(map).png())).top, kTop + 24);
}

TEST(HeatMapLayout, TheBarHasAllColoursFromLeftToRight) {
  const FieldRegion region = regionOf(50, 20);
  const DecodedPng png(draw(evenMap(region)).png());
  const int top = kTop + 20 * 16 + 62;
  for (const int x : {0, 100, 200, 400, 600, 799}) {
    for (const int y : {top, top + 15})
      EXPECT_NEAR(darknessOf(png.at(kLeft + x, y)), x / 800.0, 0.01) << x;
  }
  EXPECT_TRUE(png.is(kLeft + 10, top - 1, palette::kPaper));
  EXPECT_TRUE(png.is(kLeft + 10, top + 16, palette::kPaper));
  for (const int tick : {0, 200, 400, 600, 799}) {
    EXPECT_TRUE(png.is(kLeft + tick, top + 16, palette::kInk)) << tick;
    EXPECT_TRUE(png.is(kLeft + tick, top + 19, palette::kInk)) << tick;
    EXPECT_FALSE(png.is(kLeft + tick, top + 20, palette::kInk)) << tick;
  }
}

TEST(HeatMapLayout, SolidCellsAreOutlinedWhereTheyMeetOpenOnes) {
  FieldRegion region = regionOf(5, 3);
  region.open[7] = 0;  // in the middle
  region.open[0] = 0;  // in the lower left corner
  const DecodedPng png(draw(evenMap(region)).png());
  const auto cell = [&](int column, int row, int x, int y) {
    return png.at(kLeft + 40 * column + x, kTop + 40 * (2 - row) + y);
  };
  const auto isInk = [](Colour c) { return c.red == palette::kInk.red; };
  for (const int i : {0, 9}) {  // a quarter of the cell
    EXPECT_TRUE(isInk(cell(2, 1, i, 20)));
    EXPECT_TRUE(isInk(cell(2, 1, 39 - i, 20)));
    EXPECT_TRUE(isInk(cell(2, 1, 20, i)));
    EXPECT_TRUE(isInk(cell(2, 1, 20, 39 - i)));
    EXPECT_TRUE(isInk(cell(0, 0, 39 - i, 25))) << "on its right";
    EXPECT_TRUE(isInk(cell(0, 0, 20, i))) << "above it";
    EXPECT_FALSE(isInk(cell(0, 0, i, 25))) << "outside nothing is open";
    EXPECT_FALSE(isInk(cell(0, 0, 20, 39 - i))) << "below neither";
  }
  for (const int i : {10, 29}) {
    EXPECT_EQ(cell(2, 1, i, 20).red, palette::kSolid.red);
    EXPECT_EQ(cell(2, 1, 20, i).red, palette::kSolid.red);
  }
  EXPECT_FALSE(isInk(cell(3, 1, 0, 20))) << "open cells stay as they are";
}

TEST(HeatMapLayout, TheKeyHasALineForEveryRowOfEntries) {
  FieldRegion region = regionOf(5, 4);
  const int plain = heightFor(160);
  HeatMap map = evenMap(region);
  EXPECT_EQ(draw(map).height(), plain);
  map.truth = Pose2{1.0, 1.0, 0.0};
  EXPECT_EQ(draw(map).height(), plain + kKeyLine);
  map.marksBest = true;
  region.open[3] = 0;
  map.values[6] = kNan;
  // 400 pixels are not enough for two of these names in a row.
  EXPECT_EQ(draw(map).height(), plain + 4 * kKeyLine);
  const FieldModel none;
  map.field = &none;
  EXPECT_EQ(draw(map).height(), plain + 4 * kKeyLine) << "no landmarks, no entry";
}

TEST(HeatMapLayout, EntriesOfTheKeyStandBelowEachOtherAtTheirSymbols) {
  FieldRegion region = regionOf(5, 4);
  region.open[3] = 0;
  HeatMap map = evenMap(region);
  map.values[6] = kNan;
  const std::array<Colour, 2> boxes = {palette::kSolid, palette::kNoValue};
  const auto expectBoxes = [&](int row) {
    const DecodedPng png(draw(map).png());
    for (const Colour& colour : boxes) {
      const int middle = heightFor(160) - 16 + row++ * kKeyLine + kKeyLine / 2;
      for (const int y : {-7, 0, 6})
        for (const int x : {-11, 0, 10})
          EXPECT_TRUE(png.is(kLeft + 18 + x, middle + y, colour)) << row << ": " << x << " " << y;
      for (const int y : {-9, 8}) EXPECT_TRUE(png.is(kLeft + 18, middle + y, palette::kPaper));
    }
  };
  expectBoxes(0);
  map.truth = Pose2{1.0, 1.0, 0.0};
  map.marksBest = true;
  expectBoxes(2);
}

TEST(HeatMapLayout, EntriesThatFitExactlyStandSideBySide) {
  const auto lines = [](int columns) {
    const FieldRegion region = regionOf(columns, 250);  // 4 pixels a cell, as 1000 are for 250 rows
    HeatMap map = evenMap(region);
    const int plain = draw(map).height();
    map.truth = Pose2{1.0, 1.0, 0.0};
    map.marksBest = true;
    return (draw(map).height() - plain) / kKeyLine;
  };
  // 52 pixels before each text and 24 behind it.
  const int both =
      2 * 76 + Picture::textWidth(2, "true pose") + Picture::textWidth(2, "most probable cell");
  ASSERT_EQ(both % 4, 0) << "no picture is as wide as that";
  EXPECT_EQ(lines(both / 4), 1);
  EXPECT_EQ(lines(both / 4 - 1), 2);
}

TEST(HeatMapLayout, CaptionsAreInSmallLettersIfLargeOnesDoNotFit) {
  const FieldRegion region = regionOf(5, 4);
  HeatMap map = evenMap(region);
  const auto expectSize = [&](int scale) {
    Picture picture = draw(map);
    const auto before = picture.png();
    picture.text(16, 16, scale, palette::kInk, map.caption);
    EXPECT_TRUE(picture.png() == before) << "it is there already";
    picture.text(16, 16, 3 - scale, palette::kInk, map.caption);
    EXPECT_FALSE(picture.png() == before);
  };
  map.caption = "p(s)";
  expectSize(2);
  map.caption = std::string(60, 'm');
  expectSize(1);
}

TEST(HeatMapScale, APaleEndThatIsNextToNothingIsZero) {
  const FieldRegion region = regionOf(3, 1);
  EXPECT_EQ(mapOf(region, {0.9e-6, 1.0, 0.5}).scale().low, 0.0);
  EXPECT_EQ(mapOf(region, {1.1e-6, 1.0, 0.5}).scale().low, 1.1e-6);
  EXPECT_EQ(mapOf(region, {-1e-9, 1.0, 0.5}).scale().low, -1e-9) << "below zero is something else";
}

TEST(HeatMapScale, ALogarithmicOneHasNoZeros) {
  const FieldRegion region = regionOf(4, 1);
  HeatMap map = mapOf(region, {0.0, -1.0, kNan, 0.0});
  map.logarithmic = true;
  EXPECT_EQ(map.scale().low, 0.0);
  EXPECT_EQ(map.scale().high, 0.0);
  EXPECT_EQ(map.legend(3), (std::vector<double>{0.0, 0.0, 0.0}));
  map.values = {0.25, 0.25, 0.0, 0.25};
  EXPECT_EQ(map.scale().low, 0.25);
  EXPECT_EQ(map.scale().high, 0.25);
  EXPECT_EQ(map.legend(2), (std::vector<double>{0.25, 0.25}));
}

// 20 cells: a twentieth of them is one, so the second least value begins the scale.
TEST(HeatMapScale, TheCutIsATwentiethOfTheCells) {
  const FieldRegion region = regionOf(20, 1);
  std::vector<double> values;
  for (int i = 1; i <= 20; ++i) values.push_back(21 - i);
  HeatMap map = mapOf(region, values);
  map.logarithmic = true;
  EXPECT_EQ(map.scale().low, 2.0);
  EXPECT_EQ(map.scale().high, 20.0);
  map.logarithmic = false;
  EXPECT_EQ(map.scale().low, 1.0) << "a linear one has all";
}

TEST(HeatMapScale, OneValueIsDrawnInTheMiddleColour) {
  const FieldRegion region = regionOf(4, 1);
  const DecodedPng png(draw(mapOf(region, {3.0, 3.0, 3.0, 3.0})).png());
  EXPECT_NEAR(darknessOf(png.at(kLeft + 20, kTop + 20)), 0.5, 0.01);
}

TEST(HeatMapScale, TheBestCellIsTheFirstOfTheGreatestOpenOnes) {
  FieldRegion region = regionOf(5, 1);
  EXPECT_EQ(mapOf(region, {1.0, 4.0, 2.0, 4.0, kNan}).best(), 1u);
  region.open[1] = 0;
  EXPECT_EQ(mapOf(region, {1.0, 4.0, 2.0, 4.0, kNan}).best(), 3u);
  EXPECT_EQ(mapOf(region, {kNan, 4.0, kNan, kNan, -1.0}).best(), 4u);
  EXPECT_FALSE(mapOf(region, {kNan, 4.0, kNan, kNan, kNan}).best());
}

// A tenth of the greatest value is not above it; of 100 cells two are 2 %.
TEST(HeatMapScale, PeakedMeansThatFewerThanTwoPercentReachATenth) {
  const FieldRegion region = regionOf(100, 1);
  std::vector<double> values(100, 0.25);
  values[7] = 2.5;
  EXPECT_TRUE(mapOf(region, values).isPeaked());
  values[8] = 0.2501;
  EXPECT_FALSE(mapOf(region, values).isPeaked());
  EXPECT_FALSE(mapOf(region, std::vector<double>(100, kNan)).isPeaked());
}

}  // namespace
}  // namespace ortung::app
