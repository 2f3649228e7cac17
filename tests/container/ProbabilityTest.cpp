#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "AllFormats.hpp"
#include "FakeRoom.hpp"
#include "Files.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/formats/Words.hpp"

namespace ortung {
namespace {

using test::allFormats;
using test::batchOfOne;
using test::distanceToPost;
using test::kPi;
using test::kPostX;
using test::kPostY;
using test::learnEverywhere;
using test::modelled;
using test::Room;
using test::somePoses;
using Words = std::vector<std::uint32_t>;

const SensorId kId{"M", "T", "F"};
// The model's table has 128 entries a sigma: its slope is at most 0.61 / sigma.
constexpr double kTableStep = 0.61 / 256;

class Learned : public ::testing::Test {
 protected:
  const Room room_;
  const FieldRegion region_ = room_.region(0.1, 0.2);
  const Pose2 mount_{0.12, -0.05, 0.4};
  const Pose2 sensor_{0.25, 0.35, 0.7};  ///< on the centre of a cell
  const Pose2 robot_ = sensor_ * inverse(mount_);
};

TEST_F(Learned, ScalarFollowsTheSensorModel) {
  const ScalarData::Config config{
      .model = {.sigma = 0.1, .sigmaPerMetre = 0.02, .outliers = 0.07, .exponent = 0.8}};
  ScalarData data(kId, mount_, config);
  learnEverywhere(data, region_, 0.1,
                  [](const Pose2& s) { return ScalarData::encode(distanceToPost(s)); });
  const double expected = distanceToPost(sensor_);
  for (const double off : {0.0, 0.05, -0.1, 0.2, -0.3, 2.0}) {
    const double reading = std::round(1000 * (expected + off)) / 1000;
    data.setData(1, ScalarData::encode(reading));
    const double p = modelled(reading - expected, 0.1 + 0.02 * reading, 0.07, 0.8);
    // Half a level of the table, 0.5 mm, is 0.005 sigma.
    EXPECT_NEAR(data.getProbability(robot_), p, kTableStep + 0.61 * 0.005) << off;
  }
}

TEST_F(Learned, BearingFollowsTheSensorModelAcrossTheSeam) {
  const BearingData::Config config{.model = {.sigma = 0.05, .outliers = 0.1}};
  BearingData data(kId, mount_, config);
  learnEverywhere(data, region_, 0.1, [](const Pose2& s) {
    return BearingData::encode(test::bearingTo(s, kPostX, kPostY));
  });
  for (double turn = -7.0; turn < 7.0; turn += 0.37) {
    const Pose2 robot{robot_.x, robot_.y, turn};
    const Pose2 sensor = robot * mount_;
    const double off = 0.06 * std::sin(11 * turn);
    data.setData(1, BearingData::encode(test::bearingTo(sensor, kPostX, kPostY) + off));
    const double residual =
        wrapAngle(words::toAngle(data.getData()[0]) - test::bearingTo(sensor, kPostX, kPostY));
    // What lies between centres bends by 0.012 sigma at most, 1.3 m from the post.
    EXPECT_NEAR(data.getProbability(robot), modelled(residual, 0.05, 0.1), kTableStep + 0.01)
        << turn;
  }
}

TEST_F(Learned, LandmarksMultiplyRangeAndBearingOfAllInSight) {
  const std::vector<test::Point> posts = {{7, kPostX, kPostY}, {3, -2.0, 1.5}};
  const LandmarksData::Config config{.identities = {3, 7},
                                     .range = {.sigma = 0.2, .outliers = 0.05},
                                     .bearing = {.sigma = 0.1, .outliers = 0.06, .exponent = 0.5}};
  LandmarksData data(kId, mount_, config);
  learnEverywhere(data, region_, 0.1,
                  [&](const Pose2& s) { return test::landmarkWords(posts, s, 20.0); });
  LandmarksData::Reading reading;
  double p = 1.0;
  for (const test::Point& post : posts) {
    const double range = std::hypot(post.x - sensor_.x, post.y - sensor_.y);
    reading.push_back(
        {post.identity, range + 0.15, test::bearingTo(sensor_, post.x, post.y) - 0.08});
    p *= modelled(0.15, 0.2, 0.05) * modelled(0.08, 0.1, 0.06, 0.5);
  }
  reading.push_back({99, 1.0, 1.0});  // not in its list: says nothing
  data.setData(1, LandmarksData::encode(reading));
  EXPECT_NEAR(data.getProbability(robot_), p, 0.005);
  const std::vector<double> expected = data.expectation(robot_);
  ASSERT_EQ(expected.size(), 4u);
  EXPECT_NEAR(expected[0], std::hypot(-2.0 - sensor_.x, 1.5 - sensor_.y), 0.0011)
      << "in the list's order: 3 first";
  EXPECT_NEAR(expected[3], test::bearingTo(sensor_, kPostX, kPostY), 2e-4);
}

TEST_F(Learned, ConeKnowsAllFourCases) {
  const ConeData::Config config{
      .maxRange = 3.0,
      .model = {.sigma = 0.1, .sigmaPerMetre = 0.0, .outliers = 0.1, .maxRangeMass = 0.3}};
  ConeData data(kId, {}, config);
  learnEverywhere(data, region_, kPi / 36, [&](const Pose2& s) {
    return Words{ConeData::encode(room_.range(s.x, s.y, s.theta), 3.0)};
  });
  const Pose2 seesWall{2.05, 0.05, 0.0};   // 1.95 m in front of it
  const Pose2 seesNone{-2.95, 0.05, 0.0};  // 6.95 m
  EXPECT_NEAR(data.expectation(seesWall)[0], 1.95, 0.02);
  EXPECT_EQ(data.expectation(seesNone)[0], 3.0);
  const auto probability = [&](double reading, const Pose2& pose) {
    data.setData(1, Words{ConeData::encode(reading, 3.0)});
    return data.getProbability(pose);
  };
  // 254 levels over 3 m at sigma 0.1 m: at most 6 a sigma, so half a level is 0.083 sigma.
  EXPECT_NEAR(probability(1.95, seesWall), 1.0, 0.02);
  EXPECT_NEAR(probability(2.10, seesWall), modelled(0.15, 0.1, 0.1), 0.61 * 0.09);
  EXPECT_NEAR(probability(INFINITY, seesWall), 0.3, 1e-6);
  EXPECT_NEAR(probability(1.95, seesNone), 0.1, 1e-6);
  EXPECT_NEAR(probability(INFINITY, seesNone), 1.0, 1e-6);
  EXPECT_EQ(probability(NAN, seesWall), kNoExpectation) << "an invalid reading says nothing";
}

/// Where a range lies among the levels of a scale, not rounded.
double placeOf(const RangeScale& scale, double range) {
  if (range >= scale.maxRange()) return RangeScale::kNothing;
  const auto at = [&](int level) { return scale.range(static_cast<std::uint8_t>(level)); };
  int level = 0;
  while (level < 254 && at(level + 1) <= range) ++level;
  return level < 254 ? level + (range - at(level)) / (at(level + 1) - at(level)) : level;
}

/// The scan's formula in double precision: how many levels a range is off what is between cells and
/// directions. If the levels around differ much, either end may be seen, too, or 8 levels on from
/// it.
double levelsOff(const Room& room, const FieldGrid& grid, const RangeScale& scale,
                 const Pose2& beam, double step, double range) {
  const auto split = [](double place, double& share) {
    share = place - std::floor(place);
    return std::floor(place);
  };
  double shareX = 0.0;
  double shareY = 0.0;
  double shareTurn = 0.0;
  const double column = split((beam.x - grid.originX) / grid.cell - 0.5, shareX);
  const double row = split((beam.y - grid.originY) / grid.cell - 0.5, shareY);
  const double direction = split(beam.theta / step, shareTurn);
  double mean = 0.0;
  double least = 255.0;
  double most = 0.0;
  for (const int right : {0, 1})
    for (const int up : {0, 1})
      for (const int turn : {0, 1}) {
        const double level = scale.level(
            room.range(grid.originX + (column + right + 0.5) * grid.cell,
                       grid.originY + (row + up + 0.5) * grid.cell, (direction + turn) * step));
        mean += level * (right != 0 ? shareX : 1 - shareX) * (up != 0 ? shareY : 1 - shareY) *
                (turn != 0 ? shareTurn : 1 - shareTurn);
        least = std::min(least, level);
        most = std::max(most, level);
      }
  const double seen = placeOf(scale, range);
  const double off = std::abs(seen - mean);
  if (most - least <= 24.0) return off;
  const double within = std::min(seen - least, most - seen);
  return std::min(off, within < 0.0 ? -within : std::max(0.0, within - 8.0));
}

double scanProbability(const Room& room, const FieldGrid& grid, const Pose2& sensor,
                       const ScanData::Config& c, const std::vector<float>& ranges) {
  const RangeScale scale(c.maxRange, c.resolution);
  double sum = 0.0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (std::isnan(ranges[i])) continue;
    const auto range = static_cast<double>(ranges[i]);
    const double angle = sensor.theta + c.firstAngle + static_cast<double>(i) * c.angleStep;
    const double off =
        levelsOff(room, grid, scale, {sensor.x, sensor.y, angle}, c.angleStep, range);
    const double known = std::min(range, c.maxRange);
    // What the table rounds to levels is as good as noise of that size.
    const double sigma = std::hypot(scale.levelsPerSigma(known, c.model.sigmaAt(known)), 0.29);
    const double p = modelled(off / sigma, 1.0, c.model.outliers);
    sum += std::log(std::isinf(range) ? std::max(p, c.model.maxRangeMass) : p);
  }
  return std::exp(c.model.exponent * sum);
}

/// A scan whose noise is @p sigma and grows by @p sigmaPerMetre.
ScanData::Config scanOfNoise(double sigma, double sigmaPerMetre) {
  return {.beams = 181,
          .firstAngle = -kPi / 2,
          .angleStep = kPi / 180,
          .maxRange = 6.0,
          .model = {.sigma = sigma,
                    .sigmaPerMetre = sigmaPerMetre,
                    .outliers = 0.1,
                    .maxRangeMass = 0.25,
                    .exponent = 0.05}};
}

TEST_F(Learned, RaysMultiplyTheBeamsOfAScan) {
  // Noise that grows as the table's levels do, faster, slower, not at all; finer and coarser.
  const std::vector<std::pair<double, double>> noises = {{0.05, 0.01}, {0.1, 0.02}, {0.02, 0.05},
                                                         {0.2, 0.01},  {0.1, 0.0},  {0.03, 0.0}};
  for (const auto& [sigma, sigmaPerMetre] : noises) {
    const ScanData::Config config = scanOfNoise(sigma, sigmaPerMetre);
    const bool isLikeTheTable = sigmaPerMetre == 0.2 * sigma;
    ScanData data(kId, mount_, config);
    learnEverywhere(data, region_, kPi / 180,
                    [&](const Pose2& s) { return test::scanWords(room_, s, config); });
    Random random(3);
    for (int i = 0; i < 200; ++i) {
      const Pose2 sensor{room_.width * (random.uniform() - 0.5),
                         room_.height * (random.uniform() - 0.5), 7.0 * random.uniform()};
      if (!room_.contains(sensor.x, sensor.y, 0.06)) continue;  // between centres of cells
      const Pose2 seenFrom{sensor.x + 2.0 * sigma * random.gaussian(), sensor.y,
                           sensor.theta + 0.02 * random.gaussian()};
      if (!room_.contains(seenFrom.x, seenFrom.y)) continue;
      Words words = test::scanWords(room_, seenFrom, config);
      for (std::uint32_t& word : words)
        word = random.below(10) == 0 ? 0 : random.below(10) == 0 ? 9999 : word;
      data.setData(1, words);
      const double expected =
          scanProbability(room_, region_.grid, sensor, config, data.reading().ranges);
      // A beam's cost is rounded to 1/250 of the floor's: ln 10 / 250 nats, by half; and a level's
      // part or a weight to its neighbour. Where one table of costs serves beams of different
      // sigmas, differences are rounded to its entries and steps to an eighth of an octave, which
      // is less than 0.08 nats a beam, even where a level is wider than a sigma.
      const double stepping = isLikeTheTable ? 0.0 : 181 * 0.08;
      EXPECT_NEAR(std::log(data.getProbability(sensor * inverse(mount_))), std::log(expected),
                  0.05 * (181 * 0.5 * std::log(10.0) / 250 + 0.3 + stepping))
          << sigma << " " << sigmaPerMetre;
    }
  }
}

/// Learns with one noise, weighs with another: what a table holds does not depend on it.
TEST_F(Learned, NoiseMayChangeWithoutNewTables) {
  const ScanData::Config config = scanOfNoise(0.05, 0.01);
  const ScanData::Config other = scanOfNoise(0.15, 0.0);
  ScanData learned(kId, mount_, config);
  ScanData noisier(kId, mount_, other);
  EXPECT_EQ(learned.learningKey(), noisier.learningKey());
  const auto words = [&](const Pose2& s) { return test::scanWords(room_, s, config); };
  learnEverywhere(learned, region_, kPi / 180, words);
  learnEverywhere(noisier, region_, kPi / 180, words);
  const test::TemporaryFolder folder;
  TableWriter first(folder / "first");
  learned.saveTables(first, "");
  first.commit();
  TableWriter second(folder / "second");
  noisier.saveTables(second, "");
  second.commit();
  EXPECT_EQ(test::readBytes(folder / "first"), test::readBytes(folder / "second"));
  ScanData loaded(kId, mount_, other);
  loaded.loadTables(std::make_shared<TableFile>(folder / "first"), "", region_.grid);
  const Pose2 seenFrom = sensor_ * Pose2{0.1, 0.0, 0.0};
  for (ScanData* data : {&learned, &noisier, &loaded}) data->setData(1, words(seenFrom));
  EXPECT_EQ(loaded.getProbability(robot_), noisier.getProbability(robot_));
  EXPECT_GT(loaded.getProbability(robot_), learned.getProbability(robot_));

  ConeData::Config cone;
  const ConeData narrow(kId, mount_, cone);
  cone.model.sigma *= 3.0;
  EXPECT_EQ(narrow.learningKey(), ConeData(kId, mount_, cone).learningKey());
}

TEST_F(Learned, EndPointsMultiplyTheirDistancesToTheWalls) {
  const ScanData::Config config{
      .beams = 91,
      .firstAngle = -kPi / 2,
      .angleStep = kPi / 90,
      .maxRange = 9.0,
      .perception = ScanData::Perception::kEndPoints,
      .endPointCell = 0.05,
      .model = {.sigma = 0.2, .sigmaPerMetre = 0.0, .outliers = 0.1, .exponent = 0.2}};
  ScanData data(kId, mount_, config);
  learnEverywhere(data, region_, kPi / 180,
                  [&](const Pose2& s) { return test::scanWords(room_, s, config); });
  // It keeps no ranges, but surfaces: to a few millimetres what Room says in closed form.
  const std::vector<double> expected = data.expectation(robot_);
  ASSERT_EQ(expected.size(), 91U);
  for (int i = 0; i < 91; ++i)
    EXPECT_NEAR(
        expected[static_cast<std::size_t>(i)],
        room_.range(sensor_.x, sensor_.y, sensor_.theta + config.firstAngle + i * config.angleStep),
        0.02)
        << i;
  EXPECT_TRUE(data.expectation({100, 0, 0}).empty());
  data.setData(1, test::scanWords(room_, sensor_, config));
  for (const double off : {0.0, 0.1, 0.3}) {
    const Pose2 moved = robot_ * Pose2{off, 0, 0};
    const Pose2 sensor = moved * mount_;
    double sum = 0.0;
    for (int i = 0; i < 91; ++i) {
      const double range = static_cast<double>(data.reading().ranges[static_cast<std::size_t>(i)]);
      const double angle = sensor.theta + config.firstAngle + i * config.angleStep;
      const double x = std::abs(sensor.x + range * std::cos(angle));
      const double y = std::abs(sensor.y + range * std::sin(angle));
      const bool inside = x < room_.width / 2 && y < room_.height / 2;
      const double wall = inside ? std::min(room_.width / 2 - x, room_.height / 2 - y)
                                 : std::hypot(std::max(0.0, x - room_.width / 2),
                                              std::max(0.0, y - room_.height / 2));
      // Beyond the field's margin, two cells, there is only the floor.
      const bool known = x < room_.width / 2 + 0.1 && y < room_.height / 2 + 0.1;
      sum += std::log(known ? modelled(wall, 0.2, 0.1) : 0.1);
    }
    // An end point lies up to 0.7 cells beside its cell's centre and so does the mark: 0.05 m of
    // 0.2 m is 0.25 sigma, which costs a residual of up to 1.5 sigma 0.4 nats a beam at most; they
    // average out to a fraction of that.
    EXPECT_NEAR(std::log(data.getProbability(moved)), 0.2 * sum, 0.2 * 91 * 0.1) << off;
  }
}

TEST_F(Learned, ASetIsWeighedLikeItsPosesOneByOne) {
  const std::vector<Pose2> poses = somePoses(region_.grid, mount_, 3000);
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> theta;
  for (const Pose2& p : poses) {
    x.push_back(static_cast<float>(p.x));
    y.push_back(static_cast<float>(p.y));
    theta.push_back(static_cast<float>(p.theta));
  }
  const auto all = allFormats(room_, region_, mount_, sensor_);
  for (std::size_t f = 0; f < all.size(); ++f) {
    std::vector<float> batch(poses.size(), 1.0F);
    all[f]->getProbability(SampleView{x, y, theta}, batch);
    const float floor = batchOfOne(*all[f], {1e6, 1e6, 0});
    std::size_t differing = 0;
    std::size_t expecting = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const double p = all[f]->getProbability(poses[i]);
      const double one = p == kNoExpectation ? static_cast<double>(floor) : std::log(p);
      expecting += p == kNoExpectation ? 0 : 1;
      // Residuals next to the border of two entries of the model's table may fall on either side.
      const double tolerance = 0.02 * std::max(1.0, std::abs(one));
      differing += std::abs(static_cast<double>(batch[i]) - 1.0 - one) > tolerance ? 1 : 0;
    }
    EXPECT_GT(expecting, poses.size() / 4) << "format " << f;
    // Directions half-way between two of the table may go to either: rare.
    EXPECT_LE(differing, poses.size() / 500) << "format " << f;
  }
}

TEST_F(Learned, ASampleWithoutExpectationNeverWins) {
  const auto all = allFormats(room_, region_, mount_, sensor_);
  const std::vector<Pose2> poses = somePoses(region_.grid, mount_, 500);
  const std::vector<Pose2> readings = somePoses(region_.grid, {}, 20);
  for (std::size_t f = 0; f < all.size(); ++f) {
    SensorData& data = *all[f];
    const float floor = batchOfOne(data, {1e6, 1e6, 0});
    const float notANumber = batchOfOne(data, {std::nan(""), std::nan(""), std::nan("")});
    EXPECT_EQ(notANumber, floor) << "format " << f;
    EXPECT_LT(floor, 0.0F) << "format " << f;
    for (const Pose2& pose : poses) {
      const float weight = batchOfOne(data, pose);
      ASSERT_GE(weight, floor - 1e-5F * std::abs(floor)) << "format " << f;
      ASSERT_LE(weight, 0.0F) << "format " << f;
      const double p = data.getProbability(pose);
      ASSERT_TRUE(p == kNoExpectation || (p >= 0.0 && p <= 1.0)) << "format " << f;
    }
    EXPECT_EQ(data.getProbability(Pose2{1e6, 1e6, 0}), kNoExpectation) << "format " << f;
  }
}

TEST_F(Learned, ThePoseThatWasReadWinsAgainstOthers) {
  for (const auto& data : allFormats(room_, region_, mount_, sensor_)) {
    const float truth = batchOfOne(*data, robot_);
    EXPECT_GT(truth, batchOfOne(*data, robot_ * Pose2{0.7, 0.3, 0.8})) << data->wordsHelp();
  }
}

TEST_F(Learned, OddAnglesDoNotReadOutsideOfTheTables) {
  for (const auto& data : allFormats(room_, region_, {}, sensor_)) {
    for (const float theta : {NAN, INFINITY, -INFINITY, 1e30F, -1e30F}) {
      const float x = 0.25F;
      float weight = 0.0F;
      data->getProbability(SampleView{{&x, 1}, {&x, 1}, {&theta, 1}}, {&weight, 1});
      EXPECT_LE(weight, 0.0F) << data->wordsHelp();
      data->getProbability(Pose2{0.25, 0.25, static_cast<double>(theta)});
      data->expectation(Pose2{0.25, 0.25, static_cast<double>(theta)});
    }
  }
}

TEST_F(Learned, TheContainerMultipliesItsFeatures) {
  SensorContainer container;
  double product = 1.0;
  float sum = 0.0F;
  int number = 0;
  for (const double post : {1.1, -2.0, 0.4}) {
    const auto words = [post](const Pose2& s) {
      return ScalarData::encode(std::hypot(post - s.x, 0.9 - s.y));
    };
    SensorData& data = container.add(
        std::make_unique<ScalarData>(SensorId{"cam", "camera", std::to_string(number++)}, Pose2{},
                                     ScalarData::Config{.model = {.sigma = 0.5}}));
    learnEverywhere(data, region_, 0.1, words);
    data.setData(1, words(sensor_ * Pose2{0.3, 0.2, 0}));
    product *= data.getProbability(sensor_);
    sum += batchOfOne(data, sensor_);
  }
  SensorData& unread = container.add(std::make_unique<ScalarData>(
      SensorId{"cam", "camera", "unread"}, Pose2{}, ScalarData::Config{}));
  EXPECT_FALSE(unread.canWeigh());
  EXPECT_GT(product, 0.0);
  EXPECT_NEAR(container.getProbability(sensor_), product, 1e-6 * product);
  const float x = static_cast<float>(sensor_.x);
  const float y = static_cast<float>(sensor_.y);
  const float theta = 0.0F;
  float weight = 0.0F;
  container.getProbability(SampleView{{&x, 1}, {&y, 1}, {&theta, 1}}, {&weight, 1});
  EXPECT_NEAR(weight, sum, 1e-5);
}

TEST(SensorModel, IsOneForAPerfectMatchAndItsFloorFarAway) {
  const SensorModel model{.sigma = 0.1, .outliers = 0.05, .exponent = 0.3};
  const GaussianTable table(model);
  EXPECT_EQ(table(0.0F), 0.0F);
  for (float sigmas = -12.0F; sigmas < 12.0F; sigmas += 0.01F) {
    const double p = modelled(static_cast<double>(sigmas), 1.0, 0.05, 0.3);
    ASSERT_NEAR(std::exp(static_cast<double>(table(sigmas))), p, kTableStep) << sigmas;
  }
  for (const float far : {8.1F, -1e30F, INFINITY, NAN})
    EXPECT_EQ(table(far), static_cast<float>(model.logFloor()));
}

TEST(SensorData, NeedsASensibleHeadingStep) {
  const FieldRegion region = Room{}.region(0.5, 0.2);
  ConeData data(kId, {}, {});
  for (const double step : {0.0, -1.0, 7.0, std::nan(""), 1e-300, 1e-12}) {
    EXPECT_THROW(data.beginLearning(region, step), std::invalid_argument) << step;
  }
}

}  // namespace
}  // namespace ortung
