// Ranges in parts of a level, and what is expected between the centres of cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "DifferenceKernel.hpp"
#include "FakeRoom.hpp"
#include "LevelDifference.hpp"

namespace ortung {
namespace {

TEST(PartsOfALevel, TellARangeToAnEighthOfALevel) {
  for (const RangeResolution& resolution :
       {RangeResolution{}, {.metres = 0.02, .perMetre = 0.0}, {.metres = 0.1, .perMetre = 0.05}}) {
    const RangeScale scale(8.0, resolution);
    const double lowest = scale.range(0);
    const double highest = scale.range(RangeScale::kNothing - 1);
    for (double range = lowest; range <= std::min(highest, 7.99); range += 0.0037) {
      const std::uint8_t level = scale.level(range);
      const auto widthTo = [&](int other) {
        return std::abs(scale.range(static_cast<std::uint8_t>(other)) - scale.range(level));
      };
      const double width = std::max(level > 0 ? widthTo(level - 1) : 0.0, widthTo(level + 1));
      const double told = rangeOfParts(scale, partsOf(scale, range));
      EXPECT_NEAR(told, range, width / (2 * kPartsALevel) + 1e-9) << range;
    }
  }
}

TEST(PartsOfALevel, BeyondTheGreatestRangeAreThatRange) {
  const RangeScale scale(8.0, {});
  for (const double range : {8.0, 100.0, HUGE_VAL})
    EXPECT_EQ(rangeOfParts(scale, partsOf(scale, range)), 8.0) << range;
}

// The wall at the right recedes by what one moves away from it: between the centres, too.
TEST(RangeBetween, IsThatOfTheWallWhereverOneStands) {
  const test::Room room{4.0, 3.0};
  const FieldRegion region = room.region(0.25, 0.1);
  const RangeScale scale(8.0, {});
  constexpr int kDirections = 360;
  DirectionTable table;
  table.start(region, kDirections, 1);
  for (std::size_t cell = 0; cell < region.grid.size(); ++cell)
    for (int direction = 0; direction < kDirections; ++direction) {
      const double x = region.grid.centreX(cell);
      const double y = region.grid.centreY(cell);
      const double angle = direction * kTurn / kDirections;
      table.learn(x, y, angle, scale.level(room.range(x, y, angle)));
    }
  table.finish();
  Random random(12);
  for (int i = 0; i < 300; ++i) {
    const Pose2 sensor{random.uniform(-1.8, 1.8), random.uniform(-0.5, 0.5),
                       random.uniform(-0.2, 0.2)};
    const auto range = rangeBetween(table, scale, sensor);
    ASSERT_TRUE(range);
    const double expected = room.range(sensor.x, sensor.y, sensor.theta);
    const double width = scale.range(101) - scale.range(100);
    EXPECT_NEAR(*range, expected, width + 0.01) << sensor.x << " " << sensor.y;
  }
  EXPECT_FALSE(rangeBetween(table, scale, {2.1, 0.0, 0.0}));
}

/// The difference of one beam, from the formula: to the mean of eight levels, or to the nearer one
/// of two surfaces if their levels are far apart.
int expectedDifference(const LevelsAround& around, std::size_t beam, int reading) {
  int sum = 0;
  int low = 255;
  int high = 0;
  for (std::size_t c = 0; c < LevelsAround::kCells; ++c)
    for (std::size_t next = 0; next < 2; ++next) {
      const int level = around.rows[c][beam + next];
      sum += level * around.weights[2 * c + next];
      low = std::min(low, level);
      high = std::max(high, level);
    }
  const int mean = (sum + 16) / 32;  // in parts of a level
  const int ofOne = std::abs(reading - mean);
  const int below = 4 * low - reading;
  const int above = reading - 4 * high;
  const int ofTwo = std::max({below, above, std::min(-below, -above) - 32, 0});
  return std::min(255, high - low > 24 ? std::min(ofOne, ofTwo) : ofOne);
}

TEST(LevelDifferences, AreThoseOfTheFormulaWithEveryInstructionSet) {
  Random random(21);
  for (const std::size_t n : {32u, 64u, 256u, 288u, 544u}) {
    for (int kind = 0; kind < 40; ++kind) {
      std::vector<std::uint8_t> levels(LevelsAround::kCells * (n + 1));
      const auto spread = static_cast<std::uint32_t>(kind % 4 == 0 ? 256 : 20 + kind);
      for (std::uint8_t& level : levels)
        level = static_cast<std::uint8_t>(random.below(20) == 0 ? random.below(256)
                                                                : random.below(spread));
      LevelsAround around;
      around.weights.fill(0);
      int left = LevelsAround::kWhole;
      if (kind % 5 == 0) {  // on the centre of a cell, and on a direction
        around.weights[random.below(8)] = LevelsAround::kWhole;
        left = 0;
      }
      for (std::size_t i = 0; left > 0 && i < around.weights.size(); ++i) {
        const int weight =
            i + 1 == around.weights.size()
                ? left
                : static_cast<int>(random.below(static_cast<std::uint32_t>(left) + 1));
        around.weights[i] = static_cast<std::uint8_t>(weight);
        left -= weight;
      }
      for (std::size_t c = 0; c < LevelsAround::kCells; ++c)
        around.rows[c] = levels.data() + c * (n + 1);
      std::vector<std::int16_t> reading(n);
      for (std::int16_t& parts : reading) parts = static_cast<std::int16_t>(random.below(1021));
      for (const InstructionSet set : {InstructionSet::kPortable, InstructionSet::kAvx2,
                                       InstructionSet::kAvx512, InstructionSet::kNeon}) {
        const DifferenceKernel kernel = differenceKernel(set);
        if (kernel == nullptr) continue;
        std::vector<std::uint8_t> found(n);
        kernel(around, reading.data(), n, found.data());
        for (std::size_t j = 0; j < n; ++j)
          ASSERT_EQ(found[j], expectedDifference(around, j, reading[j]))
              << "beam " << j << " of " << n << ", set " << static_cast<int>(set);
      }
    }
  }
}

}  // namespace
}  // namespace ortung
