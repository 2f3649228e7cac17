#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "PoseSearch.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {
namespace {

/// 10 x 10 m of which the left 2 m are a wall.
FieldRegion hall() {
  FieldRegion region{
      {.originX = 0, .originY = 0, .cell = 0.1, .columns = 100, .rows = 100}, {}, {}};
  for (std::size_t cell = 0; cell < region.grid.size(); ++cell) {
    region.standable.push_back(region.grid.centreX(cell) > 2.0 ? 1 : 0);
  }
  region.open = region.standable;
  return region;
}

struct Hill {
  Pose2 top;
  double height;  ///< of p
};

constexpr double kSigmaMetres = 0.03;
constexpr double kSigmaRadians = 0.02;

/// A sum of Gaussian hills, of which hardly any pose drawn evenly meets one.
PoseSearch::Weigh hills(std::vector<Hill> all) {
  return [all = std::move(all)](const SampleSet& set, std::vector<float>& out) {
    out.resize(set.size());
    for (std::size_t i = 0; i < set.size(); ++i) {
      double best = -1e4;
      for (const Hill& hill : all) {
        const double way = std::hypot(set.x[i] - hill.top.x, set.y[i] - hill.top.y) / kSigmaMetres;
        const double turn = wrapAngle(set.theta[i] - hill.top.theta) / kSigmaRadians;
        best = std::max(best, std::log(hill.height) - 0.5 * (way * way + turn * turn));
      }
      out[i] = static_cast<float>(best);
    }
  };
}

double shareNear(const SampleSet& set, const Pose2& top) {
  double count = 0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    count += std::hypot(set.x[i] - top.x, set.y[i] - top.y) < 5 * kSigmaMetres ? 1 : 0;
  }
  return count / static_cast<double>(set.size());
}

TEST(PoseSearch, FindsANeedleAndSpreadsAsItsGaussianDoes) {
  const FieldRegion region = hall();
  const Pose2 top{7.3, 4.1, 2.9};
  const SampleSet set = PoseSearch(region).draw(4000, 2, hills({{top, 1.0}}), Random(1)).samples;
  double mean = 0, square = 0, turns = 0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    mean += (set.x[i] - top.x) / 4000;
    square += (set.x[i] - top.x) * (set.x[i] - top.x) / 4000;
    turns += std::pow(wrapAngle(set.theta[i] - top.theta), 2) / 4000;
    EXPECT_EQ(set.logWeight[i], 0.0F) << "b reached 1, nothing is left";
  }
  EXPECT_NEAR(mean, 0.0, 0.004);
  EXPECT_NEAR(std::sqrt(square), kSigmaMetres, 0.004);
  EXPECT_NEAR(std::sqrt(turns), kSigmaRadians, 0.003);
}

// A hill so wide that the few Metropolis steps do not reach across: its width must come out of the
// whole annealing, which holds only if each step keeps to p^b of its own b.
TEST(PoseSearch, SpreadsAsAWideGaussianDoes) {
  const FieldRegion region = hall();
  const Pose2 top{6.0, 5.0, 0.5};
  const auto wide = [&](const SampleSet& set, std::vector<float>& out) {
    out.resize(set.size());
    for (std::size_t i = 0; i < set.size(); ++i) {
      const double dx = (set.x[i] - top.x) / 0.25;
      const double dy = (set.y[i] - top.y) / 0.25;
      const double turn = wrapAngle(set.theta[i] - top.theta) / 0.1;
      out[i] = static_cast<float>(-0.5 * (dx * dx + dy * dy + turn * turn));
    }
  };
  double square = 0, turns = 0;
  constexpr int kSeeds = 10;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const SampleSet set = PoseSearch(region).draw(2000, 3, wide, Random(seed)).samples;
    for (std::size_t i = 0; i < set.size(); ++i) {
      square += std::pow(set.x[i] - top.x, 2) / (2000 * kSeeds);
      turns += std::pow(wrapAngle(set.theta[i] - top.theta), 2) / (2000 * kSeeds);
    }
  }
  EXPECT_NEAR(std::sqrt(square), 0.25, 0.01);
  EXPECT_NEAR(std::sqrt(turns), 0.1, 0.004);
}

TEST(PoseSearch, SharesItsSamplesByTheMassOfTheHills) {
  const FieldRegion region = hall();
  const Pose2 high{3.1, 8.2, -1.0}, low{8.4, 1.7, 1.5};
  double share = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const SampleSet set =
        PoseSearch(region).draw(2000, 5, hills({{high, 0.75}, {low, 0.25}}), Random(seed)).samples;
    share += shareNear(set, high) / 10;
    EXPECT_NEAR(shareNear(set, high) + shareNear(set, low), 1.0, 0.02);
  }
  EXPECT_NEAR(share, 0.75, 0.1);
}

TEST(PoseSearch, StaysWhereTheRobotCanStand) {
  const FieldRegion region = hall();
  const SampleSet set =
      PoseSearch(region).draw(1000, 2, hills({{{2.0, 5.0, 0.0}, 1.0}}), Random(1)).samples;
  for (std::size_t i = 0; i < set.size(); ++i) {
    const std::ptrdiff_t cell = region.grid.cellAt(set.x[i], set.y[i]);
    ASSERT_TRUE(cell >= 0 && region.standable[static_cast<std::size_t>(cell)] != 0)
        << set.x[i] << ", " << set.y[i];
  }
}

TEST(PoseSearch, WithoutAnythingToGoByKeepsTheEvenSpread) {
  const FieldRegion region = hall();
  const auto indifferent = [](const SampleSet& set, std::vector<float>& out) {
    out.assign(set.size(), -3.0F);
  };
  const SampleSet set = PoseSearch(region).draw(4000, 1, indifferent, Random(1)).samples;
  double right = 0;
  for (const float x : set.x) right += x > 6.0F ? 1.0 / 4000 : 0.0;
  EXPECT_NEAR(right, 0.5, 0.03);
}

// The mean of p over all poses, in closed form: the hill's volume over that of what is searched.
TEST(PoseSearch, EstimatesHowWellAllPosesFit) {
  const FieldRegion region = hall();
  const Pose2 top{6.0, 5.0, 0.5};
  constexpr double kMetres = 0.1;
  constexpr double kRadians = 0.08;
  const auto hill = [&](const SampleSet& set, std::vector<float>& out) {
    out.resize(set.size());
    for (std::size_t i = 0; i < set.size(); ++i) {
      const double dx = (set.x[i] - top.x) / kMetres;
      const double dy = (set.y[i] - top.y) / kMetres;
      const double turn = wrapAngle(set.theta[i] - top.theta) / kRadians;
      out[i] = static_cast<float>(std::max(-0.5 * (dx * dx + dy * dy + turn * turn), -60.0) - 3.0);
    }
  };
  const double volume = std::pow(2.0 * std::numbers::pi, 1.5) * kMetres * kMetres * kRadians;
  const PoseSearch search(region);
  const double floor = static_cast<double>(search.cells()) * region.grid.cell * region.grid.cell;
  const PoseSearch::Ring ring{{6.2, 4.9, 0.4}, 1.0, 0.6};
  double everywhere = 0.0;
  double nearby = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    everywhere += search.draw(1000, 50, hill, Random(seed)).logEvidence / 10.0;
    nearby += search.draw(400, 10, hill, Random(seed), ring).logEvidence / 10.0;
  }
  EXPECT_NEAR(everywhere, std::log(volume / (floor * 2.0 * std::numbers::pi)) - 3.0, 0.3);
  EXPECT_NEAR(nearby, std::log(volume / (std::numbers::pi * 2.0 * ring.turn)) - 3.0, 0.2);
}

TEST(PoseSearch, StaysWithinItsRingWhereverThatIs) {
  const FieldRegion region = hall();
  const PoseSearch::Ring ring{{2.0, 5.0, 3.0}, 0.7, 0.4};  // where no robot can stand, by the map
  const auto outwards = [](const SampleSet& set, std::vector<float>& out) {
    out.resize(set.size());
    for (std::size_t i = 0; i < set.size(); ++i) out[i] = 20.0F * set.x[i];
  };
  const SampleSet set = PoseSearch(region).draw(1000, 4, outwards, Random(1), ring).samples;
  for (std::size_t i = 0; i < set.size(); ++i) {
    EXPECT_LE(std::hypot(set.x[i] - 2.0, set.y[i] - 5.0), 0.7 + 1e-5);
    EXPECT_LE(std::abs(wrapAngle(set.theta[i] - 3.0)), 0.4 + 1e-5);
  }
  const SampleSet even = PoseSearch::around(ring, 20000, Random(2));
  double inner = 0.0;
  double left = 0.0;
  for (std::size_t i = 0; i < even.size(); ++i) {
    inner += std::hypot(even.x[i] - 2.0, even.y[i] - 5.0) < 0.35 ? 1.0 / 20000 : 0.0;
    left += wrapAngle(even.theta[i] - 3.0) > 0.2 ? 1.0 / 20000 : 0.0;
  }
  EXPECT_NEAR(inner, 0.25, 0.01);
  EXPECT_NEAR(left, 0.25, 0.01);
}

// Hills of 3 to 1 by their masses, of which a search has named the tops; and a third place that has
// nothing.
TEST(PoseSearch, SharesItsSamplesBetweenThePlacesThatWereFound) {
  const FieldRegion region = hall();
  const Pose2 high{3.1, 8.2, -1.0}, low{8.4, 1.7, 1.5};
  const std::vector<PoseSearch::Ring> rings = {
      {{3.13, 8.19, -1.02}, 0.3, 0.2}, {{8.4, 1.72, 1.51}, 0.3, 0.2}, {{5, 5, 0}, 0.3, 0.2}};
  const double volume = std::pow(2.0 * std::numbers::pi, 1.5) * kSigmaMetres * kSigmaMetres *
                        kSigmaRadians;  // of a hill of height 1
  const PoseSearch search(region);
  const double floor = static_cast<double>(search.cells()) * region.grid.cell * region.grid.cell;
  double share = 0.0;
  double evidence = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto drawn =
        search.drawFrom(rings, 2000, 2, hills({{high, 0.75}, {low, 0.25}}), Random(seed));
    ASSERT_EQ(drawn.samples.size(), 2000U);
    share += shareNear(drawn.samples, high) / 10;
    evidence += drawn.logEvidence / 10;
    EXPECT_NEAR(shareNear(drawn.samples, high) + shareNear(drawn.samples, low), 1.0, 0.01);
  }
  EXPECT_NEAR(share, 0.75, 0.03);
  EXPECT_NEAR(evidence, std::log(volume / (floor * 2.0 * std::numbers::pi)), 0.1)
      << "of the whole floor";
}

TEST(PoseSearch, GivesTheSameForTheSameSeed) {
  const FieldRegion region = hall();
  const auto weigh = hills({{{5, 5, 0}, 1.0}});
  const SampleSet a = PoseSearch(region).draw(100, 3, weigh, Random(7)).samples;
  const SampleSet b = PoseSearch(region).draw(100, 3, weigh, Random(7)).samples;
  const SampleSet c = PoseSearch(region).draw(100, 3, weigh, Random(8)).samples;
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.theta, b.theta);
  EXPECT_NE(a.x, c.x);
}

}  // namespace
}  // namespace ortung
