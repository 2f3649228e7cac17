// Sums over points equal those that are added up one by one, with every instruction set, whatever
// the number of points and poses, within the field and beyond it.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "CellLookup.hpp"
#include "PointSums.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

/// A field with a few marks, points around a robot, and what two kinds of them say by level.
struct Problem {
  EndPointField field;
  std::vector<float> x, y;
  std::vector<const float*> logs;
  std::array<std::array<float, 256>, 2> tables;

  explicit Problem(std::size_t points) {
    Random random(points);
    field.start({-2.0, -1.5, 0.5, 8, 6}, 0.1, 0.2);
    for (int i = 0; i < 20; ++i) field.mark(random.uniform(-2, 2), random.uniform(-1.5, 1.5));
    field.finish();
    for (std::size_t table = 0; table < 2; ++table)
      for (std::size_t level = 0; level < 256; ++level)
        tables[table][level] = -0.01F * static_cast<float>(level * (table + 1));
    for (std::size_t i = 0; i < points; ++i) {
      x.push_back(static_cast<float>(random.uniform(-3, 3)));
      y.push_back(static_cast<float>(random.uniform(-3, 3)));
      logs.push_back(tables[random.below(2)].data());
    }
  }
};

PlacingPoses poses(std::size_t n) {
  Random random(n + 1);
  PlacingPoses made;
  for (std::size_t i = 0; i < n; ++i) {
    const double heading = random.uniform(-3, 3);
    made.x[i] = static_cast<float>(random.uniform(-2, 2));
    made.y[i] = static_cast<float>(random.uniform(-1.5, 1.5));
    made.sine[i] = static_cast<float>(std::sin(heading));
    made.cosine[i] = static_cast<float>(std::cos(heading));
  }
  made.size = n;
  return made;
}

/// The sum for one pose: points whose cell is none count as far ones do.
double expected(const Problem& p, const PlacingPoses& at, std::size_t i) {
  const CellLookup lookup(p.field.grid());
  double sum = 0.0;
  for (std::size_t k = 0; k < p.x.size(); ++k) {
    const std::int32_t cell = lookup.index(at.x[i] + at.cosine[i] * p.x[k] - at.sine[i] * p.y[k],
                                           at.y[i] + at.sine[i] * p.x[k] + at.cosine[i] * p.y[k]);
    const std::uint8_t level = cell < 0 ? 255 : p.field.levels()[static_cast<std::size_t>(cell)];
    sum += static_cast<double>(p.logs[k][level]);
  }
  return sum;
}

TEST(PointSums, EqualThoseOneByOne) {
  for (const std::size_t points : {1u, 3u, 4u, 5u, 15u, 16u, 17u, 31u, 32u, 47u, 180u}) {
    const Problem p(points);
    const FramedLevels framed(p.field);
    PointSums sums(framed, p.x, p.y, p.logs);
    for (const std::size_t n : {1u, 2u, 15u, 16u, 17u, 63u, 64u}) {
      PlacingPoses at = poses(n);
      useInstructionSet(InstructionSet::kPortable);
      const PointSums::Sums portable = sums.of(at);
      for (std::size_t i = 0; i < n; ++i)
        EXPECT_NEAR(static_cast<double>(portable[i]), expected(p, at, i), 1e-3)
            << points << " points, " << n << " poses";
      for (const InstructionSet set : {InstructionSet::kAvx2, InstructionSet::kAvx512}) {
        if (!hasInstructionSet(set)) continue;
        useInstructionSet(set);
        const PointSums::Sums found = sums.of(at);
        for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(found[i], portable[i]);
      }
      useInstructionSet(std::nullopt);
    }
  }
}

TEST(FramedLevels, AreThoseOfTheFieldAndFarOutside) {
  const Problem p(1);
  const FramedLevels framed(p.field);
  const FieldGrid& grid = p.field.grid();
  for (std::size_t i = 0; i < grid.size(); ++i)
    ASSERT_EQ(framed.levels()[framed.lookup().index(static_cast<float>(grid.centreX(i)),
                                                    static_cast<float>(grid.centreY(i)))],
              p.field.levels()[i]);
  const auto left = static_cast<float>(grid.originX);
  const auto low = static_cast<float>(grid.originY);
  const float nan = std::nanf("");
  for (const auto& [x, y] : std::vector<std::pair<float, float>>{{left - 0.01F, 0.0F},
                                                                 {0.0F, low - 0.01F},
                                                                 {left + 4.41F, 0.0F},
                                                                 {0.0F, low + 3.41F},
                                                                 {-1e6F, 1e6F},
                                                                 {1e6F, -1e6F},
                                                                 {nan, nan},
                                                                 {nan, 0.0F},
                                                                 {-9.0F, nan},
                                                                 {9.0F, nan}})
    EXPECT_EQ(framed.levels()[framed.lookup().index(x, y)], 255) << x << " " << y;
}

}  // namespace
}  // namespace ortung
