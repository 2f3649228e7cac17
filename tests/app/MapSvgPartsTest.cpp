// The report's map, number by number. Its letters are 1.8 % of the longer side.
#include <gtest/gtest.h>

#include <algorithm>

#include "DecodedPng.hpp"
#include "MapSvgParts.hpp"

namespace ortung::app {
namespace {

/// x from -4 to 4 m, y from -3 to 3 m; letters of 0.144 m.
const FieldGrid kGrid{-4.0, -3.0, 0.1, 80, 60};

bool has(const std::string& svg, const std::string& part) { return svg.find(part) != svg.npos; }

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

std::vector<std::byte> decoded(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::byte> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = (bits << 6) | static_cast<std::uint32_t>(letters.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::byte>(bits >> count & 0xFF));
  }
  return bytes;
}

/// The picture within a region's SVG.
DecodedPng maskOf(const FieldRegion& region) {
  const std::string svg = regionSvg(region, MapFrame(region.grid));
  const std::string begin = "data:image/png;base64,";
  const std::size_t from = svg.find(begin) + begin.size();
  return DecodedPng(decoded(svg.substr(from, svg.find('"', from) - from)));
}

TEST(MapSvgParts, TheFrameIsTheGridsRectangle) {
  const MapFrame frame(kGrid);
  EXPECT_DOUBLE_EQ(frame.left, -4.0);
  EXPECT_DOUBLE_EQ(frame.low, -3.0);
  EXPECT_DOUBLE_EQ(frame.right(), 4.0);
  EXPECT_DOUBLE_EQ(frame.high(), 3.0);
  EXPECT_DOUBLE_EQ(frame.letter, 0.144);
  EXPECT_DOUBLE_EQ(MapFrame({0, 0, 0.5, 10, 40}).letter, 0.36) << "of the longer side";
  EXPECT_EQ(viewBox(frame), "-4.648 -3.288 8.864 7.008");
}

TEST(MapSvgParts, CellsThatAreSureToHaveChangedAreSquaresAroundWhatWasFound) {
  using Kind = MapChange::Kind;
  MapChanges changes;
  EXPECT_EQ(changesSvg(changes), "");
  changes.cells = {{Kind::kGone, 10, -21, 1.02, -2.05, 3, 3, 0, 1, 0, true},
                   {Kind::kGone, 12, -21, 1.25, -2.05, 1, 1, 0, 1, 0, false},
                   {Kind::kNew, 0, 0, 0.05, 0.05, 2, 2, 0, 1, 0, true},
                   {Kind::kNew, 1, 0, 0.15, 0.05, 2, 2, 0, 1, 0, true}};
  EXPECT_EQ(
      changesSvg(changes),
      R"(<path class="gone" d="M0.97 -2.10h0.1v0.1h-0.1z"><title>walls that are gone: 1 cells)"
      R"(</title></path><path class="fresh" d="M0.00 0.00h0.1v0.1h-0.1zM0.10 0.00h0.1v0.1h-0.1z">)"
      R"(<title>something new: 2 cells</title></path>)");
}

TEST(MapSvgParts, TheMaskIsWhiteWhereSolidAndGreyWhereTheRobotDoesNotFit) {
  FieldRegion region;
  region.grid = {0.0, 0.0, 1.0, 3, 2};
  region.open = {1, 0, 1, 1, 1, 1};
  region.standable = {1, 0, 0, 0, 1, 1};
  const DecodedPng mask = maskOf(region);
  ASSERT_EQ(mask.width, 3);
  ASSERT_EQ(mask.height, 2);
  // The upper row of the picture is the grid's second one.
  const int expected[2][3] = {{40, 0, 0}, {0, 255, 40}};
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) EXPECT_EQ(mask.at(x, y).red, expected[y][x]) << x << " " << y;
}

TEST(MapSvgParts, InMapsThatAreTooLargeAThinWallStays) {
  FieldRegion region;
  region.grid = {0.0, 0.0, 0.05, 5000, 3};
  region.open.assign(region.grid.size(), 1);
  region.standable = region.open;
  region.open[1] = 0;       // the second cell of the first pixel
  region.standable[0] = 0;  // its first cell
  region.standable[4999] = 0;
  const DecodedPng mask = maskOf(region);
  ASSERT_EQ(mask.width, 2500);
  ASSERT_EQ(mask.height, 2);
  EXPECT_EQ(mask.at(0, 1).red, 255);
  EXPECT_EQ(mask.at(1, 1).red, 0);
  EXPECT_EQ(mask.at(2499, 1).red, 40);
  EXPECT_EQ(mask.at(0, 0).red, 0);
  region.grid.columns = 4095;
  EXPECT_EQ(maskOf(region).width, 4095) << "up to there each cell has its pixel";
}

TEST(MapSvgParts, TheRegionIsDrawnOverTheWholeFrame) {
  FieldRegion region;
  region.grid = kGrid;
  region.open.assign(region.grid.size(), 1);
  region.standable = region.open;
  const std::string svg = regionSvg(region, MapFrame(kGrid));
  EXPECT_EQ(countOf(svg, R"(x="-4.000" y="-3.000" width="8.000" height="6.000")"), 4u);
}

TEST(MapSvgParts, AxesHaveLinesAndNumbersAtRoundMetres) {
  const std::string svg = axesSvg(MapFrame(kGrid));
  EXPECT_TRUE(has(svg, R"(<g class="axes" font-size="0.144")"));
  // Metre by metre: nine lines upwards, and seven across; nine of twelve for the shorter side.
  EXPECT_EQ(countOf(svg, "v6.000"), 9u);
  EXPECT_EQ(countOf(svg, "h8.000"), 7u);
  EXPECT_TRUE(has(svg, R"(<path d="M2.000 -3.000v6.000"/><text x="2.000" y="3.187">2</text>)"));
  EXPECT_TRUE(
      has(svg, R"(<path d="M-4.000 1.000h8.000"/><text class="y" x="-4.072" y="1.050">-1</text>)"));
  EXPECT_TRUE(has(svg, R"(<text x="0.000" y="3.403">x [m]</text>)"));
  EXPECT_TRUE(has(svg, R"(<text class="y" x="-4.072" y="-3.130">y [m]</text>)"));
}

TEST(MapSvgParts, TheBarIsOfARoundLengthUpToAFifthOfTheMap) {
  EXPECT_TRUE(has(axesSvg(MapFrame(kGrid)),
                  R"(<path d="M-4.000 3.562v0.058h1.000v-0.058"/><text x="-3.500" y="3.562" )"
                  R"(font-size="0.144">1 m</text>)"));
  EXPECT_TRUE(has(axesSvg(MapFrame({0, 0, 0.5, 50, 40})), "h5.000v")) << "25 m";
  EXPECT_TRUE(has(axesSvg(MapFrame({0, 0, 0.5, 48, 40})), "h2.000v")) << "24 m";
}

TEST(MapSvgParts, LandmarksAreDiamondsWithTheirNumbersBeside) {
  FieldModel field;
  EXPECT_EQ(landmarksSvg(field, MapFrame(kGrid)), "");
  field.landmarks = {{7, "post", 1.0, -2.0, 0.0}, {8, "post", 3.9, 1.5, 0.0}};
  const std::string svg = landmarksSvg(field, MapFrame(kGrid));
  // Half a diamond is 0.45 letters, 0.0648 m.
  EXPECT_TRUE(has(svg,
                  "<title>post 7 at 1.000 m, -2.000 m</title>"
                  R"(<path d="M0.935 -2.000l0.065 0.065l0.065 -0.065l-0.065 -0.065z"/>)"));
  EXPECT_TRUE(has(svg, R"x(<text class="right" transform="translate(1.091 -2.039) scale(1 -1)" )x"
                       R"x(font-size="0.108">7</text>)x"));
  EXPECT_TRUE(has(svg, R"x(<text class="left" transform="translate(3.809 1.461) scale(1 -1)" )x"
                       R"x(font-size="0.108">8</text>)x"));
}

TEST(MapSvgParts, ThousandsOfMarksAreNotDrawn) {
  FieldModel field;
  EXPECT_EQ(linesSvg(field), "");
  field.lines.resize(5001);
  field.landmarks.resize(5001);
  EXPECT_EQ(countOf(linesSvg(field), "M"), 5000u);
  const std::string svg = landmarksSvg(field, MapFrame(kGrid));
  EXPECT_EQ(countOf(svg, R"(<g class="landmark">)"), 5000u);
  EXPECT_EQ(countOf(svg, "<text"), 0u) << "names would cover each other";
}

}  // namespace
}  // namespace ortung::app
