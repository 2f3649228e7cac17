#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "FakeRoom.hpp"
#include "FakeRun.hpp"
#include "GlobalStart.hpp"
#include "Resampling.hpp"
#include "SearchedHall.hpp"
#include "ortung/base/Workers.hpp"

namespace ortung {
namespace {

using test::hall;
using test::Hill;
using test::Hills;
using test::kPi;
using test::told;

/// A start by one reading.
struct Start {
  explicit Start(std::shared_ptr<const Weigher> reading, const MclConfig& c = {})
      : config(c), start(config, region, search, workers) {
    start.begin({1, {}, 7, {{nullptr, 0, std::move(reading)}}});
  }
  SampleSet drawn(double milliseconds = 1e9) {
    while (!start.work(milliseconds)) {
    }
    return start.take();
  }

  MclConfig config;
  FieldRegion region = hall();
  PoseSearch search{region};
  Workers workers{1};
  GlobalStart start;
};

/// One distance to a post: as probable all around it, in any heading.
std::shared_ptr<const Weigher> range() {
  return told([](double x, double y, double) {
    const double residual = (std::hypot(x - 6.0, y - 5.0) - 2.5) / 0.15;
    return -0.5 * residual * residual;
  });
}

std::string bitsOf(const SampleSet& set) {
  std::string bits;
  for (const auto* values : {&set.x, &set.y, &set.theta, &set.logWeight})
    bits.append(reinterpret_cast<const char*>(values->data()), values->size() * sizeof(float));
  return bits;
}

double shareNear(const SampleSet& set, const Pose2& top, double metres, double radians) {
  const std::vector<double> weights = normalized(set.logWeight);
  double share = 0.0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    const bool isNear = std::hypot(set.x[i] - top.x, set.y[i] - top.y) < metres &&
                        std::abs(wrapAngle(set.theta[i] - top.theta)) < radians;
    share += isNear ? weights[i] : 0.0;
  }
  return share;
}

/// A sharp reading, which two poses explain.
std::shared_ptr<const Weigher> twoHills() {
  return std::make_shared<const Hills>(
      std::vector<Hill>{{{3.17, 8.24, -1.01}, 0.0}, {{8.43, 1.72, 1.53}, -0.5}});
}

TEST(GlobalStart, DrawsTheSameBitsWithAnyThreadsAndInAnySlices) {
  for (const bool isVague : {false, true}) {
    SCOPED_TRACE(isVague ? "vague" : "sharp");
    const std::shared_ptr<const Weigher> reading = isVague ? range() : twoHills();
    MclConfig config;
    config.maxSamples = 5000;
    const std::string expected = bitsOf(Start(reading, config).drawn());
    for (const unsigned threads : {2U, 7U}) {
      config.threads = threads;
      EXPECT_EQ(bitsOf(Start(reading, config).drawn()), expected) << threads << " threads";
    }
    for (const double milliseconds : {0.013, 0.31, 4.0})
      EXPECT_EQ(bitsOf(Start(reading, config).drawn(milliseconds)), expected) << milliseconds;
  }
}

/// Counts what is weighed.
class Counted final : public Weigher {
 public:
  explicit Counted(std::shared_ptr<const Weigher> its) : its_(std::move(its)) {}
  mutable std::atomic<std::size_t> weighed = 0;

 private:
  void weigh(const SampleView& poses, std::span<float> out) const override {
    weighed += poses.size();
    its_->getProbability(poses, out);
  }
  std::shared_ptr<const Weigher> its_;
};

TEST(GlobalStart, DrawsTheSameBitsIfItsTimeIsOverAfterEachFewPoses) {
  for (const bool isVague : {false, true}) {
    SCOPED_TRACE(isVague ? "vague" : "sharp");
    const std::shared_ptr<const Weigher> reading = isVague ? range() : twoHills();
    MclConfig config;
    config.maxSamples = 5000;
    Start sliced(reading, config);
    while (!sliced.start.work(1e9, [] { return true; })) continue;
    const std::size_t size = sliced.start.size();
    const SampleSet drawn = sliced.start.take();
    EXPECT_EQ(bitsOf(drawn), bitsOf(Start(reading, config).drawn()));
    EXPECT_GE(size, drawn.size());
  }
}

TEST(GlobalStart, KeepsToItsBudget) {
  const auto hill = told([](double x, double y, double t) {
    const double turn = wrapAngle(t + 1.0) / 0.06;
    return -0.5 * (std::pow((x - 4.0) / 0.06, 2) + std::pow((y - 3.0) / 0.06, 2) + turn * turn);
  });
  for (const bool isVague : {false, true}) {
    SCOPED_TRACE(isVague ? "vague" : "sharp");
    const auto counted = std::make_shared<Counted>(isVague ? range() : hill);
    Start start(counted);
    std::size_t calls = 0;
    std::size_t before = 0;
    do {
      before = counted->weighed;
      ++calls;
      // 10,000 poses of 50 ns, or fewer of those that are drawn; six edges of each place.
    } while (!start.start.work(0.5) && counted->weighed - before <= 10000U + 300U && calls < 1000);
    EXPECT_LE(counted->weighed - before, 10000U + 300U);
    EXPECT_GT(calls, 5U);
    EXPECT_LT(calls, isVague ? 200U : 40U);
    EXPECT_GT(start.start.take().size(), 1000U);
    EXPECT_FALSE(start.start.isBegun());
  }
}

// What a hill weighs is the integral of p: its height times its width.
TEST(GlobalStart, DrawsEachPlaceByItsIntegral) {
  const std::vector<Hill> hills = {{{3.17, 8.24, -1.01}, -1.0},
                                   {{8.43, 1.72, 1.53}, 0.0},
                                   {{8.43, 1.72, -1.63}, -2.0},
                                   {{5.06, 5.01, kPi}, -12.0}};  // that bad it is no place
  const SampleSet set = Start(std::make_shared<Hills>(hills)).drawn();
  const double sum = 1.0 + std::exp(-1.0) + std::exp(-2.0);
  EXPECT_NEAR(shareNear(set, hills[0].top, 0.2, 0.15), std::exp(-1.0) / sum, 0.05);
  EXPECT_NEAR(shareNear(set, hills[1].top, 0.2, 0.15), 1.0 / sum, 0.05);
  EXPECT_NEAR(shareNear(set, hills[2].top, 0.2, 0.15), std::exp(-2.0) / sum, 0.05);
  EXPECT_EQ(shareNear(set, hills[3].top, 0.2, 0.15), 0.0);
  EXPECT_LT(set.size(), 2500U) << "sharp readings need few";
}

// Six and nine nats worse: one reading does not decide, so each has a share of e^-4 of the best.
TEST(GlobalStart, OneReadingCountsFourNatsAtMost) {
  const std::vector<Hill> hills = {{{3.17, 8.24, -1.01}, -6.0},
                                   {{8.43, 1.72, 1.53}, 0.0},
                                   {{8.43, 6.02, -1.63}, -9.0},
                                   {{2.86, 2.51, 0.4}, -1.0}};
  const SampleSet set = Start(std::make_shared<Hills>(hills)).drawn();
  const double sum = 1.0 + std::exp(-1.0) + 2.0 * std::exp(-4.0);
  EXPECT_NEAR(shareNear(set, hills[0].top, 0.2, 0.15), std::exp(-4.0) / sum, 0.006);
  EXPECT_NEAR(shareNear(set, hills[1].top, 0.2, 0.15), 1.0 / sum, 0.05);
  EXPECT_NEAR(shareNear(set, hills[2].top, 0.2, 0.15), std::exp(-4.0) / sum, 0.006);
  EXPECT_NEAR(shareNear(set, hills[3].top, 0.2, 0.15), std::exp(-1.0) / sum, 0.05);
}

/// Share, mean and variances of what is within a box, by all poses of a fine grid.
struct Moments {
  double share = 0.0;
  Pose2 mean;
  double xx = 0.0, yy = 0.0, tt = 0.0;
};
template <class Add>
Moments momentsOf(const Add& addAll) {
  double sum = 0.0;
  Moments m;
  addAll([&](double x, double y, double t, double w) {
    sum += w;
    m.mean.x += w * x;
    m.mean.y += w * y;
    m.mean.theta += w * t;
    m.xx += w * x * x;
    m.yy += w * y * y;
    m.tt += w * t * t;
  });
  for (double* v : {&m.mean.x, &m.mean.y, &m.mean.theta, &m.xx, &m.yy, &m.tt}) *v /= sum;
  m.xx -= m.mean.x * m.mean.x;
  m.yy -= m.mean.y * m.mean.y;
  m.tt -= m.mean.theta * m.mean.theta;
  return m;
}

// Hills of all widths, some cut off by the wall at x = 2 m: such as rings around what was found
// hold, and such as they do not.
TEST(GlobalStart, SpreadsAsFarAsTheReadingsFit) {
  for (const double sigma : {0.03, 0.06, 0.1, 0.2, 0.4, 1.0}) {
    for (const double top : {2.1, 5.0}) {
      if (top < 3.0 && sigma < 0.2) continue;  // maps may err by so much
      SCOPED_TRACE(std::to_string(sigma) + " m at " + std::to_string(top));
      const auto log = [&](double x, double y, double t) {
        const double turn = wrapAngle(t - 0.5) / (0.7 * sigma);
        return -0.5 *
               (std::pow((x - top) / sigma, 2) + std::pow((y - 5.0) / sigma, 2) + turn * turn);
      };
      const SampleSet set = Start(told(log)).drawn();
      const Moments found = momentsOf([&](const auto& add) {
        const std::vector<double> weights = normalized(set.logWeight);
        for (std::size_t i = 0; i < set.size(); ++i)
          add(set.x[i], set.y[i], wrapAngle(set.theta[i] - 0.5), weights[i]);
      });
      const Moments expected = momentsOf([&](const auto& add) {
        const double step = 0.1 * sigma;
        for (double x = 2.0 + 0.5 * step; x < 10.0; x += step)
          for (double y = 5.0 - 4 * sigma; y < 5.0 + 4 * sigma; y += step)
            for (double t = -4 * 0.7 * sigma; t < 4 * 0.7 * sigma; t += 0.5 * sigma)
              if (std::abs(x - top) < 4 * sigma) add(x, y, t, std::exp(log(x, y, t + 0.5)));
      });
      EXPECT_NEAR(found.mean.x, expected.mean.x, 0.15 * sigma);
      EXPECT_NEAR(found.mean.y, expected.mean.y, 0.15 * sigma);
      EXPECT_NEAR(found.mean.theta, expected.mean.theta, 0.1 * sigma);
      EXPECT_NEAR(found.xx / expected.xx, 1.0, 0.15);
      EXPECT_NEAR(found.yy / expected.yy, 1.0, 0.15);
      EXPECT_NEAR(found.tt / expected.tt, 1.0, 0.15);
    }
  }
}

// All around the post alike, in all headings.
TEST(GlobalStart, DrawsVagueReadingsAllOverTheFloor) {
  const SampleSet set = Start(range()).drawn();
  EXPECT_EQ(set.size(), MclConfig().maxSamples);
  const std::vector<double> weights = normalized(set.logWeight);
  double shares[8] = {};
  double turns[8] = {};
  double off = 0.0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    const double direction = std::atan2(set.y[i] - 5.0F, set.x[i] - 6.0F);
    const auto eighth = [](double angle) {
      return std::min(7, static_cast<int>((wrapAngle(angle) / kPi + 1.0) * 4.0));
    };
    shares[eighth(direction)] += weights[i];
    turns[eighth(static_cast<double>(set.theta[i]))] += weights[i];
    off += weights[i] * std::pow(std::hypot(set.x[i] - 6.0F, set.y[i] - 5.0F) - 2.5, 2);
  }
  for (const double share : shares) EXPECT_NEAR(share, 0.125, 0.03);
  for (const double share : turns) EXPECT_NEAR(share, 0.125, 0.03);
  EXPECT_NEAR(std::sqrt(off), 0.15, 0.015);
}

TEST(GlobalStart, GoesOnWhereAPluginHasFailed) {
  std::size_t asked = 0;
  std::size_t fails = 0;
  const auto reading = told([&](double x, double y, double) {
    if (++asked == fails) throw std::runtime_error("plugin");
    return -std::hypot(x - 6.0, y - 5.0);
  });
  const FieldRegion region = hall();
  FieldSearch search(region, {});
  search.begin({reading});
  search.work(1e9);
  const std::size_t bySearch = asked;
  const std::string expected = bitsOf(Start(reading).drawn());
  const std::size_t inAll = asked - bySearch;
  // While it searches, asks beside the places that were found, draws around them, and beside.
  for (const std::size_t when :
       {std::size_t{30000}, bySearch + 10, bySearch + 2000, inAll - 1000}) {
    SCOPED_TRACE(when);
    Start start(reading);
    asked = 0;
    fails = when;
    EXPECT_THROW(start.start.work(1e9), std::runtime_error);
    EXPECT_TRUE(start.start.work(1e9));
    EXPECT_EQ(bitsOf(start.start.take()), expected);
  }
}

test::FakeRun& run() {
  static test::FakeRun run;
  return run;
}

/// A filter that knows nothing, of a robot that begins to drive.
std::unique_ptr<Mcl> startedGlobally(double budgetMs) {
  MclConfig config = run().config();
  config.budgetMs = budgetMs;
  auto mcl = run().mcl(config);
  run().begin(test::FakeRun::onCircle(1, 0.5, 0.3), 5);
  mcl->startGlobal();
  return mcl;
}

/// Updates until there is an estimate.
int updatesUntilStarted(Mcl& mcl, int most) {
  for (int i = 1; i <= most; ++i) {
    run().drive();
    if (mcl.update(run().container)) return i;
    EXPECT_FALSE(mcl.estimate(run().stamp));
    EXPECT_TRUE(mcl.places().empty());
    EXPECT_FALSE(mcl.belief());
    EXPECT_TRUE(mcl.isSearching());
    EXPECT_EQ(mcl.estimate().reason, TrackReason::kSearching);
    EXPECT_EQ(mcl.estimate().status, TrackStatus::kLost);
  }
  return most + 1;
}

// The robot drives on meanwhile, a third of a turn and more.
TEST(MclGlobalStart, IsSpreadOverUpdatesAndCarriedOnByOdometry) {
  const auto mcl = startedGlobally(1.0);
  EXPECT_FALSE(mcl->isSearching()) << "it waits for a reading";
  const int updates = updatesUntilStarted(*mcl, 200);
  EXPECT_GT(updates, 10);
  EXPECT_LT(updates, 200);
  EXPECT_FALSE(mcl->isSearching());
  EXPECT_EQ(mcl->estimate().stamp, run().stamp) << "the reading of now counts, too";
  EXPECT_LT(distance(mcl->estimate().pose, run().truth), 0.15);
}

TEST(MclGlobalStart, IsDoneInOneUpdateIfTheBudgetPermits) {
  const auto mcl = startedGlobally(1e6);
  EXPECT_EQ(updatesUntilStarted(*mcl, 1), 1);
  EXPECT_LT(distance(mcl->estimate().pose, run().truth), 0.15);
}

// Whoever has time searches on without a look at the container, and gets the same.
TEST(MclGlobalStart, MayBeSearchedOnBetweenUpdates) {
  MclConfig config = run().config();
  const auto startOf = [&](double budget, bool searchesOn) {
    config.budgetMs = budget;
    const auto mcl = run().mcl(config);
    run().begin(test::FakeRun::onCircle(1, 0.5, 0.3), 5);
    run().stamp = 0;
    mcl->startGlobal();
    mcl->searchOn();  // nothing to search for
    run().drive();
    int calls = 0;
    bool isTold = mcl->update(run().container);
    while (searchesOn && mcl->isSearching() && ++calls < 1000) mcl->searchOn();
    EXPECT_EQ(calls > 5, searchesOn);
    EXPECT_EQ(mcl->estimate().stamp, run().stamp);
    EXPECT_TRUE(mcl->estimate(run().stamp)) << "as soon as it is known";
    if (searchesOn) isTold = mcl->update(run().container);
    EXPECT_TRUE(isTold) << "there is a new estimate";
    EXPECT_FALSE(mcl->update(run().container)) << "once";
    return bitsOf(mcl->samples());
  };
  EXPECT_EQ(startOf(1e6, false), startOf(1.0, true));
}

TEST(MclGlobalStart, IsForgottenWhenAPoseIsSet) {
  const auto mcl = startedGlobally(1.0);
  run().drive();
  EXPECT_FALSE(mcl->update(run().container));
  ASSERT_TRUE(mcl->isSearching());
  mcl->setPose(run().truth, {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01});
  EXPECT_FALSE(mcl->isSearching());
  for (int i = 0; i < 20; ++i) {
    run().drive();
    mcl->update(run().container);
    ASSERT_LT(distance(mcl->estimate(run().stamp)->pose, run().truth), 0.3) << i;
  }
}

// What was read by another clock is of no use, nor is its odometry.
TEST(MclGlobalStart, BeginsAnewWhenTheClockIsSetBack) {
  test::FakeRun own;
  MclConfig config = own.config();
  config.budgetMs = 1.0;
  const auto mcl = own.mcl(config);
  own.begin(test::FakeRun::onCircle(1, 0.5, 0.3), 5);
  own.stamp = fromSeconds(1000);
  mcl->startAt(own.truth, 0.1, 0.1);
  own.drive();
  ASSERT_TRUE(mcl->update(own.container));
  mcl->relocalize();
  own.drive();
  ASSERT_FALSE(mcl->update(own.container));
  ASSERT_TRUE(mcl->isSearching());
  own.stamp = fromSeconds(10);
  own.begin(test::FakeRun::onCircle(-1, -0.5, 2.0), 6);
  int updates = 0;
  do {
    own.drive();
  } while (!mcl->update(own.container) && ++updates < 200);
  EXPECT_LT(mcl->estimate().stamp, fromSeconds(100));
  EXPECT_LT(distance(mcl->estimate().pose, own.truth), 0.2);
}

// Half a turn of the room looks the same to a scanner.
TEST(MclGlobalStart, KeepsAllPlacesOfASymmetricField) {
  test::FakeRun twins(false);
  MclConfig config = twins.config();
  config.budgetMs = 1.0;
  const auto mcl = twins.mcl(config);
  twins.begin(test::FakeRun::onCircle(1.2, 0.5, 0.3), 5);
  mcl->startGlobal();
  int updates = 0;
  do {
    twins.drive();
  } while (!mcl->update(twins.container) && ++updates < 100);
  EXPECT_GT(updates, 5);
  const auto shareAt = [&](const Pose2& pose) {
    double share = 0.0;
    for (const PoseEstimate& place : mcl->places(0.0))
      if (distance(place.pose, pose) < 0.3) share += place.share;
    return share;
  };
  for (int i = 0; i < 30; ++i) {
    const double here = shareAt(twins.truth);
    const double there = shareAt(Pose2{0, 0, kPi} * twins.truth);
    ASSERT_GT(here, 0.1) << i;
    ASSERT_GT(there, 0.1) << i;
    ASSERT_GT(here + there, 0.95) << i;
    twins.drive();
    mcl->update(twins.container);
    ASSERT_NE(mcl->estimate().status, TrackStatus::kTracking) << i;
  }
}

}  // namespace
}  // namespace ortung
