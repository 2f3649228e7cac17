// What map_server publishes of a pixel (wiki.ros.org/map_server, section 2.2; nav2_map_server), and
// what becomes of it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "MapServerCells.hpp"

namespace ortung {
namespace {

using Mode = MapServerCells::Mode;

MapPixel grey(std::uint32_t of255, std::uint32_t alpha = 255) {
  return {3 * 257 * of255, 257 * alpha};
}
MapPixel colour(std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
  return {257 * (red + green + blue), MapPixel::kFull};
}

TEST(MapServerCells, AreFreeOccupiedOrUnknownInTrinaryMode) {
  const MapServerCells cells;
  // 0.65 of black is 89.25 of 255; 0.196 is 205.02.
  for (const auto& [light, expected] :
       {std::pair(0u, 100), {89u, 100}, {90u, -1}, {205u, -1}, {206u, 0}, {254u, 0}, {255u, 0}})
    EXPECT_EQ(cells.occupancyOf(grey(light)), expected) << light;
}

TEST(MapServerCells, AreLightWhereOccupiedIfNegated) {
  const MapServerCells cells{.negate = true};
  for (const auto& [light, expected] :
       {std::pair(0u, 0), {49u, 0}, {50u, -1}, {165u, -1}, {166u, 100}, {255u, 100}})
    EXPECT_EQ(cells.occupancyOf(grey(light)), expected) << light;
}

TEST(MapServerCells, ScaleBetweenTheThresholds) {
  MapServerCells cells{.mode = Mode::kScale};
  EXPECT_EQ(cells.occupancyOf(grey(0)), 100);
  EXPECT_EQ(cells.occupancyOf(grey(89)), 100);
  EXPECT_EQ(cells.occupancyOf(grey(90)), 99);   // (0.64706 - 0.196) / 0.454 = 0.9935
  EXPECT_EQ(cells.occupancyOf(grey(128)), 67);  // (0.49804 - 0.196) / 0.454 = 0.6653
  EXPECT_EQ(cells.occupancyOf(grey(205)), 0);
  EXPECT_EQ(cells.occupancyOf(grey(255)), 0);
  cells = {.mode = Mode::kScale, .negate = true, .occupiedAbove = 1.0, .freeBelow = 0.0};
  for (std::uint32_t light = 0; light <= 255; ++light)
    EXPECT_EQ(cells.occupancyOf(grey(light)), std::lround(light / 2.55)) << light;
  // Nothing lies between two thresholds that are one: 0.5 is neither above nor below.
  cells = {.mode = Mode::kScale, .occupiedAbove = 0.5, .freeBelow = 0.5};
  EXPECT_EQ(cells.occupancyOf({MapPixel::kFull * 3 / 2, MapPixel::kFull}), 100);
  cells = {.mode = Mode::kScale, .occupiedAbove = 0.0, .freeBelow = 0.0};
  EXPECT_EQ(cells.occupancyOf(grey(255)), -1);
}

TEST(MapServerCells, AreTheValuesThemselvesInRawMode) {
  for (const bool negate : {false, true}) {
    const MapServerCells cells{.mode = Mode::kRaw, .negate = negate};
    for (std::uint32_t value = 0; value <= 255; ++value) {
      const int expected = value <= 100 ? static_cast<int>(value) : -1;
      EXPECT_EQ(cells.occupancyOf(grey(value)), expected) << value;
      EXPECT_EQ(cells.occupancyOf(grey(value, 0)), expected) << "alpha does not count";
    }
  }
}

TEST(MapServerCells, OfColoursTheMeanCounts) {
  const MapServerCells cells;
  EXPECT_EQ(cells.occupancyOf(colour(255, 0, 0)), 100);    // 2/3 dark
  EXPECT_EQ(cells.occupancyOf(colour(255, 255, 0)), -1);   // 1/3
  EXPECT_EQ(cells.occupancyOf(colour(255, 255, 110)), 0);  // 0.1895
  EXPECT_EQ(cells.occupancyOf(colour(110, 255, 255)), 0) << "whichever colour it is";
}

TEST(MapServerCells, WhatIsTransparentIsUnknown) {
  for (const Mode mode : {Mode::kTrinary, Mode::kScale})
    for (const std::uint32_t light : {0u, 100u, 255u}) {
      const MapServerCells cells{.mode = mode};
      EXPECT_EQ(cells.occupancyOf(grey(light, 0)), -1);
      EXPECT_EQ(cells.occupancyOf(grey(light, 254)), -1) << "even a little";
    }
}

TEST(MapServerCells, From65OnTheyAreOccupiedAndUpTo25Free) {
  for (int occupancy = -128; occupancy <= 127; ++occupancy)
    EXPECT_EQ(cellOf(occupancy), occupancy < 0 || occupancy > 100 ? GridCell::kUnknown
                                 : occupancy >= 65                ? GridCell::kOccupied
                                 : occupancy <= 25                ? GridCell::kFree
                                                                  : GridCell::kUnknown)
        << occupancy;
}

}  // namespace
}  // namespace ortung
