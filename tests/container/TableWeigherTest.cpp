// Samples by tables over the position, many at a time, are weighed as table and sensor model say
// one by one: with every instruction set, in blocks of any size, where nothing is known, and
// outside. Tables of a list of landmarks together give the same bits as one by one.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "TableWeigher.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

constexpr double kPerMetre = 5.0;
constexpr double kPerRadian = 10.0;

struct Landmark {
  double x = 0.0;
  double y = 0.0;
  PositionTable range{30.0};
  BearingTable bearing{};
};

/// Landmarks as they are seen from the grid's cells; @p holes share of the cells that know nothing
std::vector<Landmark> landmarksOver(const FieldGrid& grid, double holes) {
  Random random(4);
  std::vector<Landmark> landmarks{
      {.x = -3.0, .y = 0.4}, {.x = 2.5, .y = -1.0}, {.x = 0.1, .y = 0.1}};
  for (Landmark& landmark : landmarks) {
    landmark.range.start(grid);
    landmark.bearing.start(grid);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (random.uniform(0.0, 1.0) < holes) continue;
      const double dx = landmark.x - grid.centreX(i);
      const double dy = landmark.y - grid.centreY(i);
      landmark.range.learn(grid.centreX(i), grid.centreY(i), std::hypot(dx, dy));
      landmark.bearing.learn(grid.centreX(i), grid.centreY(i), std::atan2(dy, dx));
    }
  }
  return landmarks;
}

std::vector<Landmark> unlearnedLandmarks(const FieldGrid& grid, std::size_t n) {
  std::vector<Landmark> landmarks(n);
  for (Landmark& landmark : landmarks) {
    landmark.range.start(grid);
    landmark.bearing.start(grid);
  }
  return landmarks;
}

struct Samples {
  std::vector<float> x, y, theta;
};

/// Samples on the grid and up to a cell beyond it.
Samples samplesOver(const FieldGrid& grid, std::size_t n) {
  Random random(n);
  const auto along = [&](double origin, int cells) {
    return static_cast<float>(origin + grid.cell * random.uniform(-1.0, cells + 1.0));
  };
  Samples samples;
  for (std::size_t i = 0; i < n; ++i) {
    samples.x.push_back(along(grid.originX, grid.columns));
    samples.y.push_back(along(grid.originY, grid.rows));
    samples.theta.push_back(static_cast<float>(random.uniform(-7.0, 7.0)));
  }
  return samples;
}

constexpr double kRange = 2.7;    // [m]
constexpr double kBearing = 0.6;  // [rad]

std::vector<float> weighed(const std::vector<Landmark>& landmarks, const GaussianTable& gaussian,
                           const Samples& samples) {
  TableWeigher weigher(landmarks[0].range.cells().grid());
  std::vector<float> logs(samples.x.size(), 0.5F);  // something is there before
  weigher.start({samples.x.data(), samples.y.data(), samples.theta.data()}, logs.size(),
                logs.data());
  for (const Landmark& landmark : landmarks) {
    weigher.addDistance(landmark.range, gaussian, static_cast<float>(kRange),
                        static_cast<float>(kPerMetre));
    weigher.addBearing(landmark.bearing, gaussian, static_cast<float>(kBearing),
                       static_cast<float>(kPerRadian));
  }
  weigher.finish();
  return logs;
}

LandmarkLevels listOf(const std::vector<Landmark>& landmarks) {
  std::vector<LandmarkLevels::Tables> tables;
  for (const Landmark& landmark : landmarks) tables.push_back({landmark.range, landmark.bearing});
  return LandmarkLevels(tables);
}

std::vector<float> weighedTogether(const std::vector<Landmark>& landmarks,
                                   const GaussianTable& gaussian, const Samples& samples) {
  const LandmarkLevels levels = listOf(landmarks);
  EXPECT_FALSE(levels.isEmpty());
  TableWeigher weigher(landmarks[0].range.cells().grid());
  std::vector<float> logs(samples.x.size(), 0.5F);
  weigher.start({samples.x.data(), samples.y.data(), samples.theta.data()}, logs.size(),
                logs.data(), &levels);
  for (std::size_t i = 0; i < landmarks.size(); ++i)
    weigher.addLandmark(i, static_cast<float>(landmarks[i].range.metresPerLevel()),
                        {gaussian, static_cast<float>(kRange), static_cast<float>(kPerMetre)},
                        {gaussian, static_cast<float>(kBearing), static_cast<float>(kPerRadian)});
  weigher.finish();
  return logs;
}

/// What tables and model say of one sample.
double expected(const std::vector<Landmark>& landmarks, const SensorModel& model, double x,
                double y, double theta) {
  const auto logOf = [&](double sigmas) {
    const bool isFar = std::isnan(sigmas) || std::abs(sigmas) >= 8.0;
    return isFar ? model.logFloor() : model.logProbability(sigmas);
  };
  double sum = 0.5;
  for (const Landmark& landmark : landmarks) {
    sum += logOf((kRange - static_cast<double>(landmark.range.at(x, y))) * kPerMetre);
    const double direction = static_cast<double>(landmark.bearing.at(x, y));
    sum += logOf(std::remainder(kBearing + theta - direction, kTurn) * kPerRadian);
  }
  return sum;
}

void expectAsOneByOne(const FieldGrid& grid, double holes, std::size_t n) {
  const SensorModel model{.sigma = 1.0, .outliers = 0.1};
  const GaussianTable gaussian(model);
  const std::vector<Landmark> landmarks = landmarksOver(grid, holes);
  const Samples samples = samplesOver(grid, n);
  useInstructionSet(InstructionSet::kPortable);
  const std::vector<float> portable = weighed(landmarks, gaussian, samples);
  for (std::size_t i = 0; i < n; ++i) {
    // Six entries of a table in steps of 1/128 sigma, whose slope is at most 0.8 per sigma.
    EXPECT_NEAR(static_cast<double>(portable[i]),
                expected(landmarks, model, static_cast<double>(samples.x[i]),
                         static_cast<double>(samples.y[i]), static_cast<double>(samples.theta[i])),
                0.03)
        << i << " of " << n;
  }
  for (const InstructionSet set : {InstructionSet::kPortable, InstructionSet::kAvx2,
                                   InstructionSet::kAvx512, InstructionSet::kNeon}) {
    if (!hasInstructionSet(set)) continue;
    useInstructionSet(set);
    EXPECT_EQ(weighed(landmarks, gaussian, samples), portable) << static_cast<int>(set);
    EXPECT_EQ(weighedTogether(landmarks, gaussian, samples), portable) << static_cast<int>(set);
  }
  useInstructionSet(std::nullopt);
}

TEST(TableWeigher, WeighsBlocksOfAnySizeAsOneByOne) {
  for (const std::size_t n : {1u, 2u, 3u, 7u, 16u, 33u, 64u, 255u, 256u})
    expectAsOneByOne({-4.0, -2.0, 0.25, 32, 16}, 0.0, n);
}

TEST(TableWeigher, TakesTheOwnCellWhereOneAroundKnowsNothing) {
  for (const double holes : {0.02, 0.5, 1.0})
    expectAsOneByOne({-4.0, -2.0, 0.25, 32, 16}, holes, 256);
}

TEST(TableWeigher, KnowsGridsOfOneColumnRowOrCell) {
  for (const double holes : {0.0, 0.3}) {
    expectAsOneByOne({-4.0, -2.0, 0.25, 1, 16}, holes, 100);
    expectAsOneByOne({-4.0, -2.0, 0.25, 32, 1}, holes, 100);
    expectAsOneByOne({-4.0, -2.0, 0.25, 1, 1}, holes, 100);
  }
}

TEST(LandmarkLevels, AreNoneWhereNobodyLearnedOrIfTheyWouldBeTooLarge) {
  EXPECT_TRUE(LandmarkLevels().isEmpty());
  EXPECT_TRUE(listOf({{.x = 0.0, .y = 0.0}}).isEmpty());
  const FieldGrid small{0.0, 0.0, 0.1, 1000, 800};
  const FieldGrid large{0.0, 0.0, 0.1, 1000, 2000};
  EXPECT_FALSE(listOf(unlearnedLandmarks(small, 1)).isEmpty());
  EXPECT_TRUE(listOf(unlearnedLandmarks(large, 1)).isEmpty());
  EXPECT_TRUE(listOf(unlearnedLandmarks(small, 2)).isEmpty());
}

// Where one landmark of two was never seen, only that one is unknown.
TEST(LandmarkLevels, AreWholeWhereFourCellsKnowAllLandmarks) {
  const FieldGrid grid{0.0, 0.0, 1.0, 4, 3};
  std::vector<Landmark> landmarks = unlearnedLandmarks(grid, 2);
  for (Landmark& landmark : landmarks) {
    for (std::size_t cell = 0; cell < grid.size(); ++cell) {
      if (&landmark == &landmarks[1] && cell == 6) continue;  // the third of the second row
      landmark.range.learn(grid.centreX(cell), grid.centreY(cell), 1.0);
      landmark.bearing.learn(grid.centreX(cell), grid.centreY(cell), 1.0);
    }
  }
  const LandmarkLevels levels = listOf(landmarks);
  const std::vector<std::uint8_t> expected{1, 0, 0, 1, 1, 0, 0, 1, 1, 1, 1, 1};
  EXPECT_EQ(std::vector<std::uint8_t>(levels.isWhole(), levels.isWhole() + grid.size()), expected);
}

TEST(TableWeigher, GivesTheFloorWhereNobodyLearned) {
  const SensorModel model{.sigma = 1.0, .outliers = 0.1};
  const GaussianTable gaussian(model);
  const PositionTable empty(30.0);
  TableWeigher weigher(empty.cells().grid());
  const float place = 0.0F;
  float log = 0.0F;
  weigher.start({&place, &place, &place}, 1, &log);
  weigher.addDistance(empty, gaussian, 1.0F, 1.0F);
  weigher.finish();
  EXPECT_FLOAT_EQ(log, static_cast<float>(model.logFloor()));
}

}  // namespace
}  // namespace ortung
