// The free floor of a building as text.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <random>
#include <sstream>

#include "TestClient.hpp"
#include "ortung/server/FieldText.hpp"

namespace ortung::test {
namespace {

/// Reads the lines as docs/protocol.md says.
std::vector<std::uint8_t> cellsOf(const std::vector<std::string>& lines) {
  std::vector<std::uint8_t> cells(std::stoul(valueOf(lines.at(0), "columns")) *
                                  std::stoul(valueOf(lines.at(0), "rows")));
  for (const std::string& line : lines) {
    std::size_t at = std::stoul(valueOf(line, "from"));
    std::istringstream runs(line.substr(line.rfind(' ') + 1));
    std::uint8_t kind = 0;
    for (std::string run; std::getline(runs, run, ','); kind ^= 1U)
      for (std::size_t n = std::stoul(run); n > 0; --n) cells.at(at++) = kind;
  }
  return cells;
}

TEST(FieldText, TellsWhereAFloorIsFreeInRuns) {
  const std::vector<std::string> lines =
      floorText({-1.0, 2.0, 0.5, 4, 2}, {0, 1, 1, 0, 0, 1, 0, 1});
  EXPECT_EQ(lines, std::vector<std::string>{"open x_min_m=-1 y_min_m=2 step_m=0.5 columns=4 rows=2 "
                                            "from=0 1,2,2,1,1,1"});
  EXPECT_EQ(floorText({0.0, 0.0, 1.0, 2, 1}, {1, 1}).at(0),
            "open x_min_m=0 y_min_m=0 step_m=1 columns=2 rows=1 from=0 0,2");
  EXPECT_TRUE(floorText({0.0, 0.0, 1.0, 2, 2}, {1, 1}).empty()) << "cells are missing";
  EXPECT_TRUE(floorText({}, {}).empty());
}

TEST(FieldText, ReadBackIsTheSameFloor) {
  std::mt19937 random(1);
  std::vector<std::uint8_t> open(300 * 200);
  std::uint8_t kind = 0;
  for (std::uint8_t& cell : open) cell = kind = random() % 7 == 0 ? kind ^ 1U : kind;
  const std::vector<std::string> lines = floorText({0.0, 0.0, 0.1, 300, 200}, open);
  EXPECT_GT(lines.size(), 1U);
  for (const std::string& line : lines) EXPECT_LT(line.size(), 1000U) << "longer ones are cut";
  EXPECT_EQ(cellsOf(lines), open);
}

TEST(FieldText, MakesCellsLargerUntilTheyFit) {
  // A chess board has a run in each cell, and would be 2 MB.
  std::vector<std::uint8_t> open(1000 * 1000);
  for (std::size_t i = 0; i < open.size(); ++i) open[i] = (i / 1000 + i % 1000) % 2;
  const std::vector<std::string> lines = floorText({5.0, 0.0, 0.1, 1000, 1000}, open);
  EXPECT_EQ(valueOf(lines.at(0), "step_m"), "0.2")
      << "250,000 cells, each of which holds an open one";
  const std::vector<std::uint8_t> cells = cellsOf(lines);
  EXPECT_EQ(std::accumulate(cells.begin(), cells.end(), 0), 250'000);

  std::vector<std::uint8_t> noise(500 * 500);
  std::mt19937 random(2);
  for (std::uint8_t& cell : noise) cell = random() % 50 == 0 ? 1 : 0;
  std::size_t bytes = 0;
  for (const std::string& line : floorText({0.0, 0.0, 0.1, 500, 500}, noise))
    bytes += line.size() + 1;
  EXPECT_LE(bytes, 256U << 10);
  EXPECT_GT(bytes, 10'000U);
}

}  // namespace
}  // namespace ortung::test
