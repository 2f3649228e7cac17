// Lines and spots that beams end on, against closed form.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include "FakeRoom.hpp"
#include "Files.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/tables/SurfaceField.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung {
namespace {

using test::kPi;
using test::TemporaryFolder;

FieldRegion square(double surfaceSigma = 0.0) {
  FieldRegion region = test::Room{4, 4}.region(0.1, 0.2);
  region.surfaceSigma = surfaceSigma;
  return region;
}

/// Ends along a line through (x, y) at @p angle.
void markLine(SurfaceField& field, double x, double y, double angle, double length) {
  for (double along = -length / 2; along <= length / 2; along += 0.003)
    field.mark(x + along * std::cos(angle), y + along * std::sin(angle));
}

TEST(SurfaceField, FindsALineAtAnyAngleFinerThanItsCells) {
  for (double angle = 0.0; angle < kPi; angle += 0.1) {
    SurfaceField field;
    field.start(square(), 0.05, 0.1);
    const double x = 0.013;
    const double y = -0.021;
    markLine(field, x, y, angle, 2.0);
    field.finish();
    for (const double along : {-0.6, -0.1, 0.0, 0.33}) {
      for (const double off : {-0.1, 0.0, 0.04}) {
        const double px = x + along * std::cos(angle) - off * std::sin(angle);
        const double py = y + along * std::sin(angle) + off * std::cos(angle);
        const Surface* surface = field.near(px, py);
        ASSERT_NE(surface, nullptr) << angle;
        EXPECT_LT(surface->along, 0.0F);
        const auto nx = static_cast<double>(surface->normalX);
        const auto ny = static_cast<double>(surface->normalY);
        EXPECT_NEAR(std::abs(-nx * std::sin(angle) + ny * std::cos(angle)), 1.0, 1e-4) << angle;
        const double distance = nx * (px - static_cast<double>(surface->x)) +
                                ny * (py - static_cast<double>(surface->y));
        EXPECT_NEAR(std::abs(distance), std::abs(off), 0.001) << angle;
        EXPECT_LT(surface->across, 0.002F);
      }
    }
  }
}

TEST(SurfaceField, KeepsTheLinesOfACornerApart) {
  SurfaceField field;
  field.start(square(), 0.05, 0.1);
  for (double along = 0.0; along < 1.0; along += 0.003) {
    field.mark(0.51 - along, 0.51);
    field.mark(0.51, 0.51 - along);
  }
  field.finish();
  for (const double along : {0.08, 0.2, 0.5}) {
    const Surface* top = field.near(0.51 - along, 0.51);
    const Surface* right = field.near(0.51, 0.51 - along);
    ASSERT_TRUE(top != nullptr && right != nullptr);
    EXPECT_NEAR(std::abs(static_cast<double>(top->normalY)), 1.0, 1e-4) << along;
    EXPECT_NEAR(std::abs(static_cast<double>(right->normalX)), 1.0, 1e-4) << along;
  }
}

TEST(SurfaceField, KnowsASpotOnAllSides) {
  SurfaceField field;
  field.start(square(), 0.05, 0.1);
  for (double angle = 0.0; angle < 2 * kPi; angle += 0.05)
    field.mark(0.325 + 0.01 * std::cos(angle), 0.225 + 0.01 * std::sin(angle));
  field.finish();
  const Surface* spot = field.near(0.38, 0.22);
  ASSERT_NE(spot, nullptr);
  EXPECT_GE(spot->along, 0.0F);
  EXPECT_NEAR(static_cast<double>(spot->x), 0.325, 0.001);
  EXPECT_NEAR(static_cast<double>(spot->y), 0.225, 0.001);
  EXPECT_NEAR(static_cast<double>(spot->y), 0.225, 0.001);
  // On a ring of radius r either coordinate has the variance r^2 / 2.
  EXPECT_NEAR(static_cast<double>(spot->across), 0.01 / std::sqrt(2.0), 1e-4);
  EXPECT_NEAR(static_cast<double>(spot->along), 0.01 / std::sqrt(2.0), 1e-4);
  EXPECT_EQ(field.near(1.2, 0.2), nullptr);  // out of reach
}

/// Of the cells with ends within reach, the centre of the nearest; of several, of the highest row,
/// then of the highest column. Not a number: none is within reach.
std::array<double, 2> nearestOf(const std::set<std::pair<int, int>>& marked, int column, int row) {
  int best = SurfaceField::kReach * SurfaceField::kReach + 1;
  std::array<double, 2> centre{NAN, NAN};
  for (int r = SurfaceField::kReach; r >= -SurfaceField::kReach; --r)
    for (int c = SurfaceField::kReach; c >= -SurfaceField::kReach; --c) {
      if (r * r + c * c >= best || !marked.contains({column + c, row + r})) continue;
      best = r * r + c * c;
      centre = {(column + c + 0.5) * 0.05, (row + r + 0.5) * 0.05};
    }
  return centre;
}

TEST(SurfaceField, IsOfTheNearestCellEverywhere) {
  Random random(11);
  std::set<std::pair<int, int>> marked;  // columns and rows of cells of 0.05 m
  for (int i = 0; i < 40; ++i)
    marked.insert(
        {static_cast<int>(random.uniform(-30, 30)), static_cast<int>(random.uniform(-30, 30))});
  for (int i = -25; i < 10; ++i) {  // walls, also slanting and thick ones
    marked.insert({i, -12});
    marked.insert({17, i});
    marked.insert({i, i + 9});
    for (int thick = 0; thick < 3; ++thick) marked.insert({i, 25 + thick});
  }
  SurfaceField field;
  field.start(square(), 0.05, 0.0);
  for (const auto& [column, row] : marked) field.mark((column + 0.5) * 0.05, (row + 0.5) * 0.05);
  field.finish();
  for (int column = -40; column < 40; ++column)
    for (int row = -40; row < 40; ++row) {
      const Surface* found = field.near((column + 0.5) * 0.05, (row + 0.5) * 0.05);
      const auto [x, y] = nearestOf(marked, column, row);
      ASSERT_EQ(found == nullptr, std::isnan(x)) << column << " " << row;
      if (found != nullptr) {
        ASSERT_EQ(found, field.near(x, y)) << column << " " << row;
      }
    }
}

TEST(SurfaceField, IsAsCoarseAsTheWorldSays) {
  SurfaceField field;
  field.start(square(0.015), 0.05, 0.1);
  markLine(field, 0.0, 0.0, 0.4, 1.0);
  field.finish();
  EXPECT_GE(field.near(0.0, 0.0)->across, 0.015F);
  EXPECT_EQ(field.sigma(), 0.015);
}

TEST(SurfaceField, IsTheSameFromAFile) {
  const TemporaryFolder folder;
  SurfaceField field;
  field.start(square(0.01), 0.05, 0.1);
  markLine(field, 0.1, 0.2, 1.0, 3.0);
  field.mark(100.0, 0.0);  // outside
  field.mark(std::nan(""), 0.0);
  field.finish();
  {
    TableWriter writer(folder.path() / "t");
    field.save(writer, "a.");
    writer.commit();
  }
  const auto file = std::make_shared<TableFile>(folder.path() / "t");
  SurfaceField read;
  read.load(file, "a.");
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const double x = random.uniform(-2.5, 2.5);
    const double y = random.uniform(-2.5, 2.5);
    const Surface* ours = field.near(x, y);
    const Surface* theirs = read.near(x, y);
    ASSERT_EQ(ours == nullptr, theirs == nullptr);
    if (ours == nullptr) continue;
    EXPECT_EQ(ours->x, theirs->x);
    EXPECT_EQ(ours->y, theirs->y);
    EXPECT_EQ(ours->normalX, theirs->normalX);
    EXPECT_EQ(ours->across, theirs->across);
  }
  const std::shared_ptr<const SurfaceField> shared = SurfaceField::of(file, "a.");
  EXPECT_EQ(shared->near(0.1, 0.2)->x, field.near(0.1, 0.2)->x);
  EXPECT_EQ(SurfaceField::of(file, "a."), shared) << "it is made once";
  read.load(file, "other.");  // of a version that had none
  EXPECT_TRUE(read.isEmpty());
  EXPECT_EQ(read.near(0.1, 0.2), nullptr);
}

TEST(SurfaceField, RefusesToBeginWithoutCellsOrWithTooMany) {
  const auto start = [](int columns, int rows, double cell) {
    FieldRegion region = square();
    region.grid = {0.0, 0.0, 0.1, columns, rows};
    SurfaceField().start(region, cell, 0.0);
  };
  EXPECT_NO_THROW(start(1, 1, 0.1));
  EXPECT_THROW(start(0, 1, 0.1), std::invalid_argument);
  EXPECT_THROW(start(1, 0, 0.1), std::invalid_argument);
  EXPECT_THROW(start(-1, -1, 0.1), std::invalid_argument);
  EXPECT_THROW(start(1, 1, -0.1), std::invalid_argument);
  EXPECT_THROW(start(1, 1, std::nan("")), std::invalid_argument);
  EXPECT_THROW(start(1 << 14, (1 << 13) + 1, 0.1), std::invalid_argument);
}

TEST(SurfaceField, RefusesFilesThatLie) {
  const TemporaryFolder folder;
  int number = 0;
  const auto load = [&](std::vector<double> grid, std::vector<std::int32_t> cells,
                        std::vector<float> ends) {
    const auto path = folder.path() / std::to_string(++number);
    TableWriter writer(path);
    writer.add<double>("surface_grid", {grid.size()}, grid);
    writer.add<std::int32_t>("surface_cells", {cells.size()}, cells);
    writer.add<float>("surface_ends", {ends.size() / 6, 6}, ends);
    writer.commit();
    SurfaceField().load(std::make_shared<TableFile>(path), "");
  };
  const std::vector<double> grid = {0, 0, 0.05, 10, 10, 0};
  const std::vector<float> ends = {0, 0, 0.1F, 0, 0.1F, 7};
  EXPECT_NO_THROW(load(grid, {5}, ends));
  EXPECT_THROW(load(grid, {100}, ends), TableError);
  EXPECT_THROW(load(grid, {-1}, ends), TableError);
  EXPECT_THROW(load(grid, {5, 6}, ends), TableError);
  EXPECT_THROW(load(grid, {5, 5}, {0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1}), TableError);
  EXPECT_THROW(load(grid, {5}, {std::nanf(""), 0, 0, 0, 0, 1}), TableError);
  EXPECT_THROW(load(grid, {5}, {0, 0, 1e30F, 0, 0, 1}), TableError);
  EXPECT_THROW(load(grid, {5}, {0, 0, 0, 0, 0, 0}), TableError);
  for (const std::vector<double>& lying : {std::vector<double>{0, 0, 0.05, 1e9, 1e9, 0},
                                           {0, 0, -1, 10, 10, 0},
                                           {std::nan(""), 0, 0.05, 10, 10, 0},
                                           {0, 0, 0.05, 10.5, 10, 0},
                                           {0, std::nan(""), 0.05, 10, 10, 0},
                                           {0, 0, 1e-5, 10, 10, 0},
                                           {0, 0, 1e4, 10, 10, 0},
                                           {0, 0, std::nan(""), 10, 10, 0},
                                           {0, 0, 0.05, 10.5, 10, 0},
                                           {0, 0, 0.05, 10, 10.5, 0},
                                           {0, 0, 0.05, 0, 10, 0},
                                           {0, 0, 0.05, 10, 0, 0},
                                           {0, 0, 0.05, -10, -10, 0},
                                           {0, 0, 0.05, std::nan(""), 10, 0},
                                           {0, 0, 0.05, HUGE_VAL, 10, 0},
                                           {0, 0, 0.05, 10, HUGE_VAL, 0},
                                           {0, 0, 0.05, 1e10, 1, 0},
                                           {0, 0, 0.05, 10, 10, 1e4},
                                           {0, 0, 0.05, 10, 10, std::nan("")},
                                           {0, 0, 0.05, 10, 10, -1},
                                           {0, 0, 0.05}})
    EXPECT_THROW(load(lying, {5}, ends), TableError);
}

}  // namespace
}  // namespace ortung
