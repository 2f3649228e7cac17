#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "FakeRoom.hpp"
#include "FieldSearch.hpp"
#include "SearchedHall.hpp"
#include "ortung/base/Workers.hpp"
#include "ortung/core/BlurrableWeigher.hpp"

namespace ortung {
namespace {

using test::hall;
using test::Hill;
using test::Hills;
using test::kPi;
using test::told;

using Readings = std::vector<std::shared_ptr<const Weigher>>;

std::vector<FieldSearch::Place> found(const FieldRegion& region, Readings readings,
                                      const FieldSearch::Settings& settings = {},
                                      double milliseconds = 1e9) {
  FieldSearch search(region, settings);
  search.begin(std::move(readings));
  while (!search.work(milliseconds)) {
  }
  return {search.places().begin(), search.places().end()};
}

void expectNear(const Pose2& pose, const Pose2& truth, double metres, double radians) {
  EXPECT_NEAR(pose.x, truth.x, metres);
  EXPECT_NEAR(pose.y, truth.y, metres);
  EXPECT_NEAR(wrapAngle(pose.theta - truth.theta), 0.0, radians);
}

TEST(FieldSearch, FindsTheTopsOfAllHillsBestFirst) {
  const std::vector<Hill> hills = {{{3.17, 8.24, -1.01}, -0.5},
                                   {{8.43, 1.72, 1.53}, 0.0},
                                   {{8.43, 1.72, -1.63}, -1.0},  // the same place, turned around
                                   {{5.06, 5.01, kPi}, -2.0},    // where headings wrap
                                   {{2.06, 0.04, 0.3}, -3.0}};   // in a corner
  const auto places = found(hall(), {std::make_shared<Hills>(hills)});
  ASSERT_GE(places.size(), hills.size());
  const std::size_t order[] = {1, 0, 2, 3, 4};
  for (std::size_t k = 0; k < hills.size(); ++k) {
    SCOPED_TRACE(k);
    const Hill& hill = hills[order[k]];
    expectNear(places[k].pose, hill.top, 0.006, 0.004);
    EXPECT_NEAR(places[k].logProbability, hill.logHeight, 0.05) << "of the reading, unblurred";
  }
}

// As far from all poses of the cover as can be: there the reading knows nothing but its floor.
TEST(FieldSearch, FindsAHillThatNoPoseOfTheCoverMeets) {
  const Pose2 top{6.6, 5.1, (5.5 / 16.0) * kPi};
  const auto places = found(hall(), {std::make_shared<Hills>(std::vector<Hill>{{top, 0.0}},
                                                             PoseResolution{0.03, 0.02}, -12.0)});
  ASSERT_FALSE(places.empty());
  expectNear(places[0].pose, top, 0.006, 0.004);
}

TEST(FieldSearch, NamesEveryPlaceOnceAndOnlyWhereTheRobotCanStand) {
  const FieldRegion region = hall();
  // Better towards the wall; everywhere it is as good in any heading.
  const auto places = found(region, {told([](double x, double, double) { return -x; })});
  ASSERT_EQ(places.size(), FieldSearch::Settings().places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Pose2& pose = places[i].pose;
    EXPECT_EQ(region.standable[static_cast<std::size_t>(region.grid.cellAt(pose.x, pose.y))], 1);
    EXPECT_NEAR(places[i].logProbability, -pose.x, 1e-5);
    EXPECT_LT(pose.x, 2.5);
    if (i > 0) {
      EXPECT_LE(places[i].logProbability, places[i - 1].logProbability);
    }
    for (std::size_t j = 0; j < i; ++j) {
      const Pose2& other = places[j].pose;
      const double way = std::hypot(pose.x - other.x, pose.y - other.y);
      EXPECT_TRUE(way >= 0.5 || std::abs(wrapAngle(pose.theta - other.theta)) >= 0.35);
    }
  }
}

// Bumps everywhere, of which no two are alike.
double bumps(double x, double y, double theta) {
  return 5.0 * (std::sin(3.1 * x + 0.3 * y) + std::sin(2.7 * y - 0.2 * x) +
                std::cos(3.0 * theta + 0.1 * x * y)) +
         0.1 * x;
}

TEST(FieldSearch, FindsTheSameBitsWithAnyThreadsAndInAnySlices) {
  const FieldRegion region = hall();
  const auto search = [&](unsigned threads, double milliseconds) {
    FieldSearch::Settings settings;
    Workers workers(threads);
    settings.workers = &workers;
    settings.survivors = 300;
    return found(region, {told(bumps)}, settings, milliseconds);
  };
  const auto expected = search(1, 1e9);
  ASSERT_GT(expected.size(), 30U);
  const auto expectSame = [&](const std::vector<FieldSearch::Place>& places) {
    ASSERT_EQ(places.size(), expected.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      EXPECT_EQ(places[i].pose.x, expected[i].pose.x);
      EXPECT_EQ(places[i].pose.y, expected[i].pose.y);
      EXPECT_EQ(places[i].pose.theta, expected[i].pose.theta);
      EXPECT_EQ(places[i].logProbability, expected[i].logProbability);
    }
  };
  for (const unsigned threads : {2U, 3U, 7U}) expectSame(search(threads, 1e9));
  for (const double milliseconds : {0.0007, 0.013, 0.31}) expectSame(search(3, milliseconds));
}

// Nothing of what was seen is all that a plateau has to offer: then the order of poses decides, and
// that must be the same, too.
TEST(FieldSearch, DecidesBetweenEqualsAlikeInAnySlices) {
  const FieldRegion region = hall();
  const auto flat = [](double, double, double) { return -1.0; };
  const auto whole = found(region, {told(flat)});
  Workers workers(3);
  const auto sliced = found(region, {told(flat)}, {.workers = &workers}, 0.017);
  ASSERT_EQ(whole.size(), sliced.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(whole[i].pose.x, sliced[i].pose.x);
    EXPECT_EQ(whole[i].pose.y, sliced[i].pose.y);
    EXPECT_EQ(whole[i].pose.theta, sliced[i].pose.theta);
  }
}

TEST(FieldSearch, KeepsToItsBudgetAndItsForecast) {
  const FieldRegion region = hall();
  const auto hills = std::make_shared<Hills>(std::vector<Hill>{{{7.3, 4.1, 2.9}, 0.0}});
  FieldSearch search(region, {});
  EXPECT_EQ(search.nominalMilliseconds(), 0.0);
  search.begin({hills});
  std::size_t calls = 0;
  std::size_t before = 0;
  while (!search.isDone()) {
    search.work(0.5);  // 5000 poses of 100 ns
    EXPECT_LE(hills->weighed() - before, 5001U);
    EXPECT_GT(hills->weighed(), before) << "it gets on";
    before = hills->weighed();
    ++calls;
  }
  EXPECT_GT(calls, 10U);
  EXPECT_LE(static_cast<double>(before) * 1e-4, 1.0001 * search.nominalMilliseconds());
  EXPECT_GT(static_cast<double>(before) * 1e-4, 0.3 * search.nominalMilliseconds());
  search.begin({hills});
  search.work(0.0);
  EXPECT_EQ(hills->weighed() - before, 1U) << "without a budget, one pose";
}

// Between two questions there are a few poses, or a few of those that are chosen; the search gets
// on nevertheless, and finds the same.
TEST(FieldSearch, StopsAfterAFewPosesOnceItsTimeIsOver) {
  const FieldRegion region = hall();
  const auto bits = told(bumps);
  const auto hills = std::make_shared<Hills>(std::vector<Hill>{{{7.3, 4.1, 2.9}, 0.0}});
  FieldSearch search(region, {});
  search.begin({bits, hills});
  const auto both = found(region, {bits, hills});
  std::size_t before = hills->weighed();
  std::size_t idle = 0;
  while (!search.work(1e9, [] { return true; })) {
    const std::size_t weighed = hills->weighed() - before;
    EXPECT_LE(weighed, kTimedPoses);
    if (weighed == 0) ++idle;
    before = hills->weighed();
  }
  EXPECT_GT(idle, 30U) << "choosing is divided, too";
  ASSERT_EQ(search.places().size(), both.size());
  for (std::size_t i = 0; i < both.size(); ++i) {
    EXPECT_EQ(search.places()[i].pose.x, both[i].pose.x);
    EXPECT_EQ(search.places()[i].logProbability, both[i].logProbability);
  }
}

TEST(FieldSearch, HoldsItsReadingsUntilItIsDone) {
  const FieldRegion region = hall();
  auto hills = std::make_shared<const Hills>(std::vector<Hill>{{{7.3, 4.1, 2.9}, 0.0}});
  const std::weak_ptr<const Hills> watched = hills;
  FieldSearch search(region, {});
  search.begin({std::move(hills)});
  search.work(0.1);
  EXPECT_FALSE(watched.expired()) << "the feature has its next reading by now";
  search.work(1e9);
  EXPECT_TRUE(watched.expired());
  ASSERT_FALSE(search.places().empty());
  expectNear(search.places()[0].pose, {7.3, 4.1, 2.9}, 0.006, 0.004);
}

TEST(FieldSearch, BeginsAnewAtAnyTime) {
  const FieldRegion region = hall();
  FieldSearch search(region, {});
  search.begin({std::make_shared<Hills>(std::vector<Hill>{{{7.3, 4.1, 2.9}, 0.0}})});
  search.work(1.0);
  search.begin({std::make_shared<Hills>(std::vector<Hill>{{{4.6, 2.2, 0.2}, 0.0}})});
  search.work(1e9);
  ASSERT_FALSE(search.places().empty());
  expectNear(search.places()[0].pose, {4.6, 2.2, 0.2}, 0.006, 0.004);
}

// Poses that were not good enough for the readings before may well be for these, whose probability
// is smaller everywhere.
TEST(FieldSearch, BeginsAnewWithoutTheThresholdOfTheSearchBefore) {
  const FieldRegion region = hall();
  FieldSearch search(region, {});
  search.begin({told([](double x, double, double) { return -0.1 * x; })});
  search.work(1.0);  // 20,000 of 50 ns: the best of them were chosen by now
  ASSERT_FALSE(search.isDone());
  const std::shared_ptr<const Weigher> poor =
      std::make_shared<Hills>(std::vector<Hill>{{{7.3, 4.1, 2.9}, -60.0}});
  search.begin({poor});
  search.work(1e9);
  const auto expected = found(region, {poor});
  ASSERT_EQ(search.places().size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(search.places()[i].logProbability, expected[i].logProbability);
  expectNear(search.places()[0].pose, {7.3, 4.1, 2.9}, 0.006, 0.004);
}

/// Around a pose a reading is more probable than at it.
class Raised final : public BlurrableWeigher {
 public:
  explicit Raised(std::shared_ptr<const BlurrableWeigher> sharp, float by)
      : sharp_(std::move(sharp)), by_(by) {}
  std::shared_ptr<const BlurrableWeigher> blurred(const PoseResolution& spread) const override {
    return std::make_shared<Raised>(sharp_->blurred(spread), 2000.0F);
  }
  double nominalNanoseconds() const override { return 100.0; }

 private:
  void weigh(const SampleView& poses, std::span<float> out) const override {
    sharp_->getProbability(poses, out);
    for (float& log : out) log += by_;
  }
  std::shared_ptr<const BlurrableWeigher> sharp_;
  float by_;
};

TEST(FieldSearch, EachStageHasAThresholdOfItsOwn) {
  const auto hill = std::make_shared<Hills>(std::vector<Hill>{{{7.3, 4.1, 2.9}, -60.0}});
  const auto places = found(hall(), {std::make_shared<Raised>(hill, 0.0F)});
  ASSERT_FALSE(places.empty());
  expectNear(places[0].pose, {7.3, 4.1, 2.9}, 0.006, 0.004);
  EXPECT_NEAR(places[0].logProbability, -60.0, 0.05);
}

// A cover that is as fine as can be is divided no more: what climbs is weighed by the readings
// themselves, and so are the places, as with a coarse one.
TEST(FieldSearch, PlacesAreThoseOfTheReadingsThemselvesHoweverFineTheCoverIs) {
  FieldRegion region{{.originX = 0, .originY = 0, .cell = 0.05, .columns = 40, .rows = 40}, {}, {}};
  region.open.assign(region.grid.size(), 1);
  region.standable = region.open;
  const Pose2 top{1.232, 0.791, 0.43};
  for (const double spacing : {0.05, 0.1, 0.2, 0.4}) {
    SCOPED_TRACE(spacing);
    const auto hill = std::make_shared<Hills>(std::vector<Hill>{{top, -60.0}});
    const auto places = found(region, {std::make_shared<Raised>(hill, 0.0F)},
                              {.spacing = spacing, .headings = 64, .places = 1});
    ASSERT_EQ(places.size(), 1U);
    expectNear(places[0].pose, top, 0.006, 0.004);
    EXPECT_NEAR(places[0].logProbability, -60.0, 0.05);
  }
}

TEST(FieldSearch, MultipliesReadingsOfWhichNoneTellsThePlace) {
  const Pose2 truth{6.6, 3.3, 0.9};
  const auto squared = [](double residual) { return -0.5 * residual * residual; };
  const auto places = found(
      hall(),
      {told([&](double x, double, double) { return squared((x - truth.x) / 0.2); }),
       told([&](double, double y, double) { return squared((y - truth.y) / 0.2); }),
       told([&](double, double, double t) { return squared(wrapAngle(t - truth.theta) / 0.1); })});
  ASSERT_FALSE(places.empty());
  expectNear(places[0].pose, truth, 0.006, 0.004);
  EXPECT_NEAR(places[0].logProbability, 0.0, 0.01);
}

TEST(FieldSearch, OutlivesWhateverPluginsAnswer) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const FieldRegion region = hall();
  for (const double nonsense : {kNan, kInfinity, -kInfinity, 1e30, -1e30}) {
    SCOPED_TRACE(nonsense);
    for (const auto& place :
         found(region, {told([=](double, double, double) { return nonsense; })})) {
      EXPECT_TRUE(std::isfinite(place.pose.x + place.pose.y + place.pose.theta));
      EXPECT_LE(std::abs(place.logProbability), 1e4);
    }
    const auto places = found(region, {told([=](double x, double y, double) {
                                return y < 5.0 ? nonsense : -10.0 * std::abs(x - 4.44);
                              })});
    ASSERT_FALSE(places.empty());
    if (nonsense < 1e4) {
      EXPECT_NEAR(places[0].pose.x, 4.44, 0.006);
    }
  }
  FieldSearch search(region, {});
  bool fails = true;
  search.begin({told([&](double, double, double) -> double {
    if (fails) throw std::runtime_error("plugin");
    return 0.0;
  })});
  EXPECT_THROW(search.work(1.0), std::runtime_error);
  fails = false;
  EXPECT_TRUE(search.work(1e9)) << "it goes on where it was";
}

TEST(FieldSearch, FindsNothingWhereThereIsNothing) {
  FieldRegion region = hall();
  EXPECT_TRUE(found(region, {}).empty());
  EXPECT_TRUE(found(region, {nullptr}).empty());
  std::fill(region.standable.begin(), region.standable.end(), std::uint8_t{0});
  EXPECT_TRUE(found(region, {told(bumps)}).empty());
  EXPECT_TRUE(found(FieldRegion{}, {told(bumps)}).empty());
}

TEST(FieldSearch, SearchesTheHeadingsOfASingleCell) {
  for (const double cell : {0.02, 0.1, 1.0}) {
    SCOPED_TRACE(cell);
    FieldRegion region{
        {.originX = 3, .originY = -2, .cell = cell, .columns = 1, .rows = 1}, {}, {}};
    region.open = region.standable = {1};
    const double x = 3 + 0.5 * cell;
    const auto places = found(
        region, {std::make_shared<Hills>(std::vector<Hill>{{{x, -2 + 0.5 * cell, -2.13}, 0.0}})});
    ASSERT_FALSE(places.empty());
    expectNear(places[0].pose, {x, -2 + 0.5 * cell, -2.13}, 0.006, 0.004);
  }
}

TEST(FieldSearch, RefusesSettingsThatMakeNoSense) {
  const FieldRegion region = hall();
  for (const FieldSearch::Settings& wrong : {FieldSearch::Settings{.spacing = 0.0},
                                             {.spacing = std::nan("")},
                                             {.headings = 0},
                                             {.survivors = 0},
                                             {.places = 0},
                                             {.apartMetres = -1.0},
                                             {.apartRadians = std::nan("")}})
    EXPECT_THROW(FieldSearch(region, wrong), std::invalid_argument);
}

/// A scanner in an empty room, which from two poses looks the same.
class ScanSearch : public testing::TestWithParam<ScanData::Perception> {
 protected:
  const test::Room room_{9.3, 6.1};
  const FieldRegion region_ = room_.region(0.1, 0.2);
  const Pose2 truth_{1.32, -0.71, 0.43};

  std::unique_ptr<ScanData> learned(const Pose2& mount) const {
    ScanData::Config config{.beams = 240, .firstAngle = -2.0, .angleStep = kPi / 180};
    config.maxRange = 12.0;
    config.perception = GetParam();
    if (config.perception == ScanData::Perception::kEndPoints)
      config.model = {.sigma = 0.05, .outliers = 0.2, .exponent = ScanData::kEndPointExponent};
    auto scan = std::make_unique<ScanData>(SensorId{"Room", "LRF", "Scan"}, mount, config);
    const auto words = [&](const Pose2& sensor) { return test::scanWords(room_, sensor, config); };
    test::learnEverywhere(*scan, region_, kPi / 180, words);
    scan->setData(1, words(truth_ * mount));
    return scan;
  }
};

TEST_P(ScanSearch, FindsBothPosesThatLookTheSame) {
  const auto scan = learned({0.2, -0.1, 0.7});
  const auto places = found(region_, {scan->weigher()});
  ASSERT_GE(places.size(), 3U);
  const Pose2 turned{-truth_.x, -truth_.y, truth_.theta + kPi};
  const bool isFirst = distance(places[0].pose, truth_) < 1.0;
  expectNear(places[isFirst ? 0 : 1].pose, truth_, 0.11, 0.03);
  expectNear(places[isFirst ? 1 : 0].pose, turned, 0.11, 0.03);
  EXPECT_LT(places[2].logProbability, places[1].logProbability - 2.0) << "no third one";
}

TEST_P(ScanSearch, ABlurredReadingIsOnTheScaleOfTheWholeAndFlatter) {
  const auto scan = learned({});
  const std::shared_ptr<const Weigher> sharp = scan->weigher();
  const auto* blurrable = dynamic_cast<const BlurrableWeigher*>(sharp.get());
  ASSERT_NE(blurrable, nullptr);
  const auto blurred = blurrable->blurred({0.06, 0.04});
  EXPECT_LE(blurred->nominalNanoseconds(), blurrable->nominalNanoseconds());
  const float floor = test::batchOfOne(*sharp, {100, 100, 0});
  EXPECT_NEAR(test::batchOfOne(*blurred, {100, 100, 0}), floor, -1e-3F * floor);
  const float top = test::batchOfOne(*sharp, truth_);
  EXPECT_NEAR(test::batchOfOne(*blurred, truth_), 0.0F, 0.3F - top);
  const Pose2 beside{truth_.x + 0.15, truth_.y - 0.1, truth_.theta + 0.09};
  EXPECT_GT(test::batchOfOne(*blurred, beside), 0.6F * test::batchOfOne(*sharp, beside));
  const Pose2 elsewhere{-3.0, 1.5, 2.0};
  EXPECT_LT(test::batchOfOne(*blurred, elsewhere), 2.0F * test::batchOfOne(*blurred, beside));
}

INSTANTIATE_TEST_SUITE_P(Perceptions, ScanSearch,
                         testing::Values(ScanData::Perception::kRays,
                                         ScanData::Perception::kEndPoints),
                         [](const auto& tested) {
                           return tested.param == ScanData::Perception::kRays ? "rays"
                                                                              : "endpoints";
                         });

}  // namespace
}  // namespace ortung
