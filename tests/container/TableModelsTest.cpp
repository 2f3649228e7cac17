#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "FakeRoom.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/tables/DirectionTable.hpp"
#include "ortung/tables/EndPointField.hpp"
#include "ortung/tables/PositionTable.hpp"

namespace ortung {
namespace {

using test::kPi;
using test::Room;

TEST(FieldGrid, HoldsItsLowerEdgesAndNotItsUpperOnes) {
  const FieldGrid grid{-1.0, 2.0, 0.5, 4, 2};
  EXPECT_EQ(grid.cellAt(-1.0, 2.0), 0);
  EXPECT_EQ(grid.cellAt(0.999, 2.999), 7);
  EXPECT_EQ(grid.cellAt(1.0, 2.5), -1);
  EXPECT_EQ(grid.cellAt(0.0, 3.0), -1);
  EXPECT_EQ(grid.cellAt(-1.001, 2.5), -1);
  EXPECT_EQ(grid.cellAt(std::nan(""), 2.5), -1);
  EXPECT_EQ(grid.cellAt(1e300, -1e300), -1);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    EXPECT_EQ(grid.cellAt(grid.centreX(i), grid.centreY(i)), static_cast<std::ptrdiff_t>(i));
  }
}

TEST(FieldRegion, IsChecked) {
  FieldRegion region = Room{2, 2}.region(0.5, 0.1);
  EXPECT_NO_THROW(region.check());
  region.open.pop_back();
  EXPECT_THROW(region.check(), std::invalid_argument);
  region = Room{2, 2}.region(0.5, 5.0);
  EXPECT_THROW(region.check(), std::invalid_argument) << "nothing is standable";
  region = Room{2, 2}.region(0.5, 0.1);
  region.grid.cell = std::nan("");
  EXPECT_THROW(region.check(), std::invalid_argument);
}

TEST(CellTable, KnowsNothingUntilSetAndIgnoresTheOutside) {
  CellTable table;
  EXPECT_EQ(table.at(0, 0), CellTable::kNone) << "an empty table";
  table.start({0, 0, 1, 3, 2});
  EXPECT_EQ(table.at(1.5, 0.5), CellTable::kNone);
  table.set(1.5, 0.5, 42);
  table.set(5, 5, 1);
  table.set(-0.1, 0.5, 1);
  EXPECT_EQ(table.at(1.1, 0.9), 42);
  EXPECT_EQ(table.at(2.5, 0.5), CellTable::kNone);
  EXPECT_EQ(table.at(5, 5), CellTable::kNone);
}

// A level is a millimetre up to 65 m, then as fine as 65535 levels allow.
TEST(PositionTable, KeepsDistancesToAPointWithinHalfALevel) {
  for (const double maxRange : {5.0, 20.0, 200.0}) {
    PositionTable table(maxRange);
    const double level = std::max(0.001, maxRange / 65534);
    const FieldGrid grid{-2, -2, 0.1, 40, 40};
    table.start(grid);
    const auto truth = [&](std::size_t i) {
      return std::hypot(grid.centreX(i) - 0.33, grid.centreY(i) + 0.71) * maxRange / 5;
    };
    for (std::size_t i = 0; i < grid.size(); ++i)
      table.learn(grid.centreX(i), grid.centreY(i), truth(i));
    for (std::size_t i = 0; i < grid.size(); ++i) {
      ASSERT_NEAR(table.at(grid.centreX(i), grid.centreY(i)), truth(i),
                  0.5 * level + 1e-6 * maxRange);
    }
    EXPECT_TRUE(std::isnan(table.at(2.1, 0)));
  }
}

TEST(PositionTable, DoesNotKeepWhatItCannotHold) {
  PositionTable table(20.0);
  table.start({0, 0, 1, 1, 1});
  for (const double range :
       {-1.0, 65.536, 1e9, static_cast<double>(INFINITY), static_cast<double>(NAN)}) {
    table.learn(0.5, 0.5, range);
    EXPECT_TRUE(std::isnan(table.at(0.5, 0.5))) << range;
  }
}

TEST(BearingTable, KeepsEveryDirectionWithinHalfALevel) {
  BearingTable table;
  table.start({0, 0, 1, 1, 1});
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const double direction = i < 4 ? (i - 2) * kPi : random.uniform(-20, 20);
    table.learn(0.5, 0.5, direction);
    const auto found = static_cast<double>(table.at(0.5, 0.5));
    ASSERT_GE(found, -3.1415928);
    ASSERT_LE(found, 3.1415928);
    ASSERT_NEAR(wrapAngle(found - direction), 0.0, kPi / 65535 + 3e-7);
  }
}

TEST(RangeScale, GivesBackTheMiddleOfEachLevel) {
  for (const double perMetre : {0.0, 0.01, 0.1}) {
    const RangeScale scale(8.0, {.metres = 0.05, .perMetre = perMetre});
    int used = 0;
    for (int level = 0; level < 255; ++level) {
      const double range = scale.range(static_cast<std::uint8_t>(level));
      if (range >= 8.0) break;
      EXPECT_EQ(scale.level(range), level);
      ++used;
    }
    EXPECT_GT(used, 100);
    EXPECT_EQ(scale.range(RangeScale::kNothing), 8.0);
  }
}

TEST(RangeScale, NoiseLikeTheResolutionIsTheSameNumberOfLevelsAtEveryRange) {
  const RangeScale scale(80.0, {.metres = 0.03, .perMetre = 0.02});
  for (const double range : {0.5, 2.0, 10.0, 40.0, 70.0}) {
    const double sigma = 0.03 + 0.02 * range;
    // A small step, in levels, against its length in sigmas: the definition of the scale.
    double levels = 0.0;
    for (int i = 0; i < 1000; ++i) {
      levels += (scale.level(range + (i / 999.0 + 3) * sigma) -
                 scale.level(range + (i / 999.0 - 3) * sigma)) /
                1000.0;
    }
    const double sigmas = (std::log1p(0.02 * (range + 3.5 * sigma) / 0.03) -
                           std::log1p(0.02 * (range - 2.5 * sigma) / 0.03)) /
                          0.02;
    EXPECT_NEAR(levels, sigmas * scale.levelsPerSigma(range, sigma),
                0.2);  // of about 7.5: levels are whole
    EXPECT_NEAR(levels, sigmas * scale.levelsPerSigma(range, 3.0 * sigma) / 3.0, 0.2);
  }
}

TEST(RangeScale, RisesAndSeesNothingFromTheGreatestRangeOn) {
  const RangeScale scale(8.0, {.metres = 0.05, .perMetre = 0.01});
  int last = 0;
  for (double range = 0.0; range < 8.0; range += 0.001) {
    const int level = scale.level(range);
    ASSERT_GE(level, last);
    ASSERT_LE(level - last, 1);
    last = level;
    ASSERT_NEAR(scale.range(static_cast<std::uint8_t>(level)), range,
                0.6 * (0.05 + 0.01 * range) / scale.levelsPerSigma(range, 0.05 + 0.01 * range));
  }
  for (const double range : {8.0, 9.0, static_cast<double>(INFINITY), static_cast<double>(NAN)}) {
    EXPECT_EQ(scale.level(range), RangeScale::kNothing);
  }
  EXPECT_EQ(scale.level(-1.0), 0);
}

FieldRegion oneCell() {
  FieldRegion region;
  region.grid = {0, 0, 1, 1, 1};
  region.open = region.standable = {1};
  return region;
}

TEST(DirectionTable, KnowsTheNearestDirectionOfAnyAngle) {
  DirectionTable table;
  table.start(oneCell(), 360, 1);
  EXPECT_NEAR(table.step(), kPi / 180, 1e-15);
  for (int turn = -3; turn <= 3; ++turn) {
    for (int k = 0; k < 360; ++k) {
      for (const double off : {-0.49, 0.0, 0.49})
        ASSERT_EQ(table.directionOf((k + off + 360 * turn) * kPi / 180), k);
    }
  }
}

TEST(DirectionTable, StaysWithinItsRowForAnyAngleWhatever) {
  DirectionTable table;
  for (const int directions : {1, 7, 360, 36000}) {
    table.start(oneCell(), directions, 1);
    for (const double angle :
         {1e18, -1e300, static_cast<double>(INFINITY), static_cast<double>(NAN), -1e-17, 2 * kPi}) {
      EXPECT_GE(table.directionOf(angle), 0);
      EXPECT_LT(table.directionOf(angle), directions);
    }
  }
}

TEST(DirectionTable, KeepsTheAngleThatIsNearest) {
  DirectionTable table;
  table.start(oneCell(), 4, 1);
  for (int k = 0; k < 4; ++k)
    table.learn(0.5, 0.5, k * kPi / 2 + 0.3, static_cast<std::uint8_t>(10 + k));
  table.learn(0.5, 0.5, 0.1, 77);   // nearer than 0.3
  table.learn(0.5, 0.5, -0.2, 88);  // not nearer than 0.1
  table.learn(0.5, 0.5, kPi - 0.5, 99);
  table.finish();
  const std::uint8_t* row = table.row(0.5, 0.5);
  ASSERT_NE(row, nullptr);
  EXPECT_EQ(row[0], 77);
  EXPECT_EQ(row[1], 11);
  EXPECT_EQ(row[2], 12);
}

TEST(DirectionTable, FillsNarrowGapsAndDropsRowsWithWideOnes) {
  const auto tableWithGap = [](int gap) {
    DirectionTable table;
    table.start(oneCell(), 36, 1);
    for (int k = gap; k < 36; ++k)
      table.learn(0.5, 0.5, k * kPi / 18, static_cast<std::uint8_t>(k));
    table.finish();
    const std::uint8_t* row = table.row(0.5, 0.5);
    return row == nullptr ? std::vector<std::uint8_t>() : std::vector<std::uint8_t>(row, row + 36);
  };
  EXPECT_EQ(tableWithGap(1)[0], 35);
  const auto four = tableWithGap(4);  // 0 and 1 are near 35, 2 and 3 are near 4
  ASSERT_FALSE(four.empty());
  EXPECT_EQ(four[0], 35);
  EXPECT_EQ(four[1], 35);
  EXPECT_EQ(four[2], 4);
  EXPECT_EQ(four[3], 4);
  EXPECT_TRUE(tableWithGap(5).empty()) << "the third of five has no neighbour within two";
  EXPECT_TRUE(tableWithGap(36).empty());
}

TEST(DirectionTable, RepeatsItsBeginningBehindItsEnd) {
  DirectionTable table;
  constexpr int kRun = 9;
  table.start(oneCell(), 12, kRun);
  for (int k = 0; k < 12; ++k) table.learn(0.5, 0.5, k * kPi / 6, static_cast<std::uint8_t>(k));
  table.finish();
  const std::uint8_t* row = table.row(0.5, 0.5);
  for (int k = 0; k < 12 + kRun - 1; ++k) EXPECT_EQ(row[k], k % 12);
  EXPECT_GE(table.levels().size(),
            static_cast<std::size_t>(12 + kRun - 1 + DirectionTable::kSlack));
}

TEST(DirectionTable, HasRowsForOpenCellsOnly) {
  FieldRegion region = Room{4, 4}.region(1.0, 0.2);
  region.open[5] = 0;
  DirectionTable table;
  table.start(region, 4, 1);
  for (std::size_t i = 0; i < region.grid.size(); ++i) {
    for (int k = 0; k < 4; ++k)
      table.learn(region.grid.centreX(i), region.grid.centreY(i), k * kPi / 2, 1);
  }
  table.finish();
  for (std::size_t i = 0; i < region.grid.size(); ++i) {
    EXPECT_EQ(table.rowOfCell(static_cast<std::ptrdiff_t>(i)) == nullptr, i == 5);
  }
  EXPECT_EQ(table.row(100, 0), nullptr);
}

TEST(DirectionTable, RefusesImpossibleSizes) {
  DirectionTable table;
  EXPECT_THROW(table.start(oneCell(), 0, 1), std::invalid_argument);
  EXPECT_THROW(table.start(oneCell(), 36001, 1), std::invalid_argument);
  EXPECT_THROW(table.start(oneCell(), 10, 0), std::invalid_argument);
  EXPECT_THROW(table.start(oneCell(), 10, 12), std::invalid_argument);
}

/// Distance to the nearest mark in cells, over all pairs.
double nearest(const FieldGrid& grid, std::size_t cell, const std::vector<std::size_t>& marks) {
  double best = INFINITY;
  for (const std::size_t m : marks) {
    best = std::min(best, std::hypot(grid.centreX(cell) - grid.centreX(m),
                                     grid.centreY(cell) - grid.centreY(m)) /
                              grid.cell);
  }
  return best;
}

TEST(EndPointField, IsTheDistanceToTheNearestMark) {
  Random random(1);
  for (int repetition = 0; repetition < 20; ++repetition) {
    EndPointField field;
    field.start({-1, 2, 0.5, static_cast<int>(1 + random.below(12)),
                 static_cast<int>(1 + random.below(12))},
                0.1, 0.3);
    const FieldGrid& grid = field.grid();
    EXPECT_NEAR(grid.originX, -1.3, 1e-12);
    EXPECT_NEAR(grid.originY, 1.7, 1e-12);
    std::vector<std::size_t> marks;
    for (std::uint64_t k = random.below(6); k > 0; --k) {
      marks.push_back(random.below(grid.size()));
      field.mark(grid.centreX(marks.back()) + 0.04, grid.centreY(marks.back()) - 0.04);
    }
    field.mark(1e6, 0);
    field.mark(std::nan(""), 0);
    field.finish();
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const double expected = std::min(255.0, EndPointField::kPerCell * nearest(grid, i, marks));
      ASSERT_NEAR(static_cast<double>(field.levels()[i]), expected, 0.501)
          << repetition << ": " << i;
    }
  }
}

// A corridor of 60,000 cells: squares of cell numbers do not fit into 32 bits.
TEST(EndPointField, IsRightInLongCorridors) {
  EndPointField field;
  field.start({0, 0, 0.05, 60000, 1}, 0.05, 0.0);
  for (const int column : {3, 59000}) field.mark((column + 0.5) * 0.05, 0.025);
  field.finish();
  for (int column = 0; column < 60000; ++column) {
    const int cells = std::min(std::abs(column - 3), std::abs(column - 59000));
    ASSERT_EQ(field.levels()[static_cast<std::size_t>(column)], std::min(255, 8 * cells)) << column;
  }
}

TEST(EndPointField, RefusesImpossibleSizes) {
  EndPointField field;
  EXPECT_THROW(field.start({0, 0, 1, 1000, 1000}, 1e-3, 0), std::invalid_argument);
  EXPECT_THROW(field.start({0, 0, 1, 10, 10}, 0.0, 0), std::invalid_argument);
  EXPECT_THROW(field.start({0, 0, 1, 10, 10}, std::nan(""), 0), std::invalid_argument);
}

// The learned tables of a scan against the room's closed form.
TEST(ScanTables, HoldTheRoomsRanges) {
  const Room room;
  const FieldRegion region = room.region(0.25, 0.2);
  for (const double span : {kPi, 1.5 * kPi, 2 * kPi}) {
    const ScanData::Config config{.beams = static_cast<int>(std::lround(span / kPi * 180)),
                                  .firstAngle = -span / 2,
                                  .angleStep = kPi / 180,
                                  .maxRange = 6.0};
    const Pose2 mount{0.2, -0.1, 0.5};
    ScanData data({"LMS200", "LRF", "scan"}, mount, config);
    test::learnEverywhere(data, region, kPi / 180,
                          [&](const Pose2& s) { return test::scanWords(room, s, config); });
    Random random(2);
    for (int i = 0; i < 200; ++i) {
      const std::size_t cell = random.below(region.grid.size());
      const double heading = random.uniform(-kPi, kPi);
      const Pose2 sensor{region.grid.centreX(cell), region.grid.centreY(cell), heading};
      const std::vector<double> expected = data.expectation(sensor * inverse(mount));
      ASSERT_EQ(expected.size(), static_cast<std::size_t>(config.beams));
      for (int beam = 0; beam < config.beams; ++beam) {
        // The table knows whole degrees; the neighbours on both sides bound what it may hold.
        const double angle = heading + config.firstAngle + beam * config.angleStep;
        double low = 6.0;
        double high = 0.0;
        for (double off = -1.05; off <= 1.06; off += 0.15) {
          const double range =
              std::min(6.0, room.range(sensor.x, sensor.y, angle + off * kPi / 180));
          low = std::min(low, range);
          high = std::max(high, range);
        }
        const double level = 0.03 + 0.02 * high;  // wider than a level of this scale
        ASSERT_GE(expected[static_cast<std::size_t>(beam)], low - level) << beam;
        ASSERT_LE(expected[static_cast<std::size_t>(beam)], high + level) << beam;
      }
    }
  }
}

}  // namespace
}  // namespace ortung
