// Ranges in parts of a level, and what is expected between the centres of cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

}  // namespace
}  // namespace ortung
