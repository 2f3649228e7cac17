// Places that compete with the belief: what it takes until they win.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "ExactMotion.hpp"
#include "FakeRoom.hpp"
#include "Resampling.hpp"
#include "Rivals.hpp"
#include "ortung/base/Workers.hpp"

namespace ortung {
namespace {

constexpr double kPi = std::numbers::pi;
/// Places that look alike, from one of them.
const std::vector<Pose2> kAlike{{0, -3, 0}, {0, -2, 0}, {0, -1, 0}, {0, 1, 0}};
constexpr double kFloor = -30.0;  ///< ln p of readings that fit nowhere

TEST(Lead, NoReadingCountsMoreThanFourNatsAndNoneFromTheSamePlace) {
  Lead lead;
  lead.count(1000.0, 1.0);
  EXPECT_EQ(lead.nats(), 4.0);
  lead.count(1000.0, 0.25);
  EXPECT_EQ(lead.nats(), 5.0);
  lead.count(1000.0, 0.0);
  EXPECT_EQ(lead.nats(), 5.0);
  lead.count(-1.5, 7.0);
  EXPECT_EQ(lead.nats(), 3.5);
  lead.count(-1000.0, 1.0);
  EXPECT_EQ(lead.nats(), -0.5);
  lead.atLeast(0.0);
  EXPECT_EQ(lead.nats(), 0.0);
}

TEST(Lead, FourReadingsAreEnoughAndThreeHopeless) {
  Lead lead;
  for (int i = 0; i < 3; ++i) lead.count(1000.0, 1.0);
  EXPECT_FALSE(lead.isEnough());
  lead.count(1000.0, 1.0);
  EXPECT_TRUE(lead.isEnough());
  Lead behind;
  for (int i = 0; i < 2; ++i) behind.count(-1000.0, 1.0);
  EXPECT_FALSE(behind.isHopeless());
  behind.count(-1000.0, 1.0);
  EXPECT_TRUE(behind.isHopeless());
}

TEST(Lead, TwoReadingsAreEnoughForAPlaceThatIsHardlyConfused) {
  EXPECT_EQ(mostNatsFor(1), 9.0);
  EXPECT_NEAR(mostNatsFor(2), 9.0 - std::log(2.0), 1e-12);
  EXPECT_EQ(mostNatsFor(1000), 4.0) << "as if nothing was known of others";
  for (const int places : {1, 2, 3}) {
    Lead lead(mostNatsFor(places));
    for (int i = 0; i < 2; ++i) lead.count(1000.0, 1.0);
    EXPECT_EQ(lead.isEnough(), places < 3) << places;
  }
  Lead lead(9.0);
  lead.count(-1000.0, 1.0);
  EXPECT_EQ(lead.nats(), -9.0);
}

TEST(Lead, OfTheSamePlaceIsKeptUnlessItIsAgainstIt) {
  Lead before;
  before.count(3.0, 1.0);
  Lead lead(9.0);
  lead.count(8.0, 1.0);
  lead.add(before);
  EXPECT_EQ(lead.nats(), 11.0);
  before.count(-1000.0, 1.0);
  lead.add(before);
  EXPECT_EQ(lead.nats(), 11.0);
  lead.forget();
  EXPECT_EQ(lead.nats(), 0.0);
  lead.count(1000.0, 1.0);
  EXPECT_EQ(lead.nats(), 9.0) << "it still counts as much";
}

/// ln p of a reading that fits at some places.
/// @param misfit what beams cost that people hide [nats]
float fitAt(float x, float y, float theta, const std::vector<Pose2>& places, double misfit = 0.0) {
  double best = kFloor;
  for (const Pose2& there : places) {
    const double way = std::hypot(x - there.x, y - there.y) / 0.1;
    const double turn = wrapAngle(theta - there.theta) / 0.1;
    best = std::max(best, -misfit - 0.5 * (way * way + turn * turn));
  }
  return static_cast<float>(best);
}

class FitsAt : public Weigher {
 public:
  FitsAt(std::vector<Pose2> there, double misfit) : there_(std::move(there)), misfit_(misfit) {}

 private:
  void weigh(const SampleView& poses, std::span<float> out) const override {
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] += fitAt(poses.x[i], poses.y[i], poses.theta[i], there_, misfit_);
  }
  std::vector<Pose2> there_;
  double misfit_;
};

/// A robot drives through a hall; readings tell where it is, the belief is elsewhere.
struct Drive {
  Drive() {
    for (int i = 0; i < 50; ++i) {
      recovery.follow(0.9);
      recovery.followBest(0.95);
    }
  }
  /// The robot comes @p metres on, and readings fit where it is, or @p seen if that is given.
  std::optional<Rivals::Takeover> reading(double metres, const Pose2& believed,
                                          const std::optional<Pose2>& seen = {}) {
    truth.x += metres;
    stamp += 100'000;
    for (Hypothesis* rival : rivals.hypotheses()) {
      if (rival == nullptr) continue;
      rival->move(0, [metres](const MovableSamples& some, std::size_t) {
        for (float& x : some.x) x += static_cast<float>(metres);
      });
    }
    std::vector<Pose2> there{seen.value_or(truth)};
    for (const Pose2& apart : alike)
      there.push_back({there[0].x + apart.x, there[0].y + apart.y, there[0].theta + apart.theta});
    Evidence reading;
    reading.weigh = [&](const SampleSet& set, std::vector<float>& out) {
      out.resize(set.size());
      for (std::size_t i = 0; i < set.size(); ++i) out[i] = logProbability(set, i, there);
    };
    SampleSet belief;
    belief.resize(1);
    belief.x[0] = static_cast<float>(believed.x);
    belief.y[0] = static_cast<float>(believed.y);
    belief.theta[0] = static_cast<float>(believed.theta);
    const double evidence = logProbability(belief, 0, there);
    recovery.follow(1.0 - evidence / kFloor);
    recovery.followBest(1.0 - evidence / kFloor);
    ++readings;
    reading.fit = [&](const SampleSet& set) {
      double sum = 0.0;
      const std::vector<double> weights = normalized(set.logWeight);
      for (std::size_t i = 0; i < set.size(); ++i)
        sum += weights[i] * (1.0 - static_cast<double>(logProbability(set, i, there)) / kFloor);
      return sum;
    };
    const Rivals::Moment moment{stamp,    believed,
                                evidence, ofBelief.value_or(1.0 - evidence / kFloor),
                                metres,   static_cast<std::uint64_t>(readings),
                                truth,    {std::make_shared<FitsAt>(there, misfit)}};
    return rivals.follow(moment, recovery, reading);
  }
  bool hasElsewhere() { return rivals.hypotheses()[1] != nullptr; }
  float logProbability(const SampleSet& set, std::size_t i, const std::vector<Pose2>& there) const {
    return fitAt(set.x[i], set.y[i], set.theta[i], there, misfit);
  }

  FieldRegion region = test::Room{20, 12}.region(0.25, 0.2);
  PoseSearch search{region};
  MclConfig config;
  test::ExactMotion motion;
  UpdateTime time{config};
  Workers workers{1};
  Rivals rivals{config, region, search, motion, time, workers};
  Recovery recovery{MclConfig{}};
  Pose2 truth{-8, 2, 0.3};
  std::vector<Pose2> alike;  ///< places that look like the robot's, from there
  double misfit = 0.0;       ///< what a reading lacks even where it fits best [nats]
  /// How well readings fit the belief once they have weighed it; nothing: as well as before.
  std::optional<double> ofBelief = {};
  Timestamp stamp = 0;
  int readings = 0;
};

double distanceOf(const SampleSet& set, const Pose2& pose) {
  double sum = 0.0;
  for (std::size_t i = 0; i < set.size(); ++i)
    sum += std::hypot(set.x[i] - pose.x, set.y[i] - pose.y) / static_cast<double>(set.size());
  return sum;
}

TEST(Rivals, APlaceThatAloneExplainsReadingsTakesOverWithTheSecondOne) {
  Drive drive;
  EXPECT_FALSE(drive.reading(0.3, {8, -5, 2})) << "no reading decides alone";
  ASSERT_TRUE(drive.hasElsewhere());
  EXPECT_EQ(drive.rivals.lead(), 9.0);
  const auto takeover = drive.reading(0.3, {8, -5, 2});
  ASSERT_TRUE(takeover);
  EXPECT_EQ(takeover->share, 1.0);
  EXPECT_FALSE(takeover->isConfirmed) << "two readings are few";
  EXPECT_LT(distanceOf(takeover->samples, drive.truth), 0.3);
  EXPECT_FALSE(drive.hasElsewhere()) << "all is told";
}

TEST(Rivals, APlaceThatAloneExplainedOneReadingIsLeftWhenTheNextContradicts) {
  Drive drive;
  drive.reading(0.3, {8, -5, 2}, Pose2{0, -3, 1});
  ASSERT_TRUE(drive.hasElsewhere());
  EXPECT_FALSE(drive.reading(0.3, {8, -5, 2}));  // it fits where the robot is, not there
  const auto takeover = drive.reading(0.3, {8, -5, 2});
  ASSERT_TRUE(takeover) << "the search of the reading before found the robot";
  EXPECT_LT(distanceOf(takeover->samples, drive.truth), 0.3);
}

// Who looks often enough finds a place at last that fits by chance.
TEST(Rivals, AfterReadingsThatFitNowhereTwoSearchesHaveToAgree) {
  Drive drive;
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(drive.reading(0.3, {8, -5, 2}, Pose2{1000, 1000, 0}));
  EXPECT_FALSE(drive.reading(0.3, {8, -5, 2}));
  EXPECT_FALSE(drive.reading(0.05, {8, -5, 2})) << "from the same place they always do";
  const auto takeover = drive.reading(0.3, {8, -5, 2});
  ASSERT_TRUE(takeover);
  EXPECT_LT(distanceOf(takeover->samples, drive.truth), 0.3);
}

// People hide a third of what the scanner sees.
TEST(Rivals, APlaceThatTwoSearchesFindTakesOverThoughReadingsFitWorseThanUsual) {
  Drive drive;
  drive.misfit = 10.0;
  EXPECT_FALSE(drive.reading(0.31, {8, -5, 2})) << "no search decides alone";
  const auto takeover = drive.reading(0.31, {8, -5, 2});
  ASSERT_TRUE(takeover);
  EXPECT_EQ(takeover->share, 1.0);
  EXPECT_FALSE(takeover->isConfirmed);
  EXPECT_LT(distanceOf(takeover->samples, drive.truth), 0.3);
  EXPECT_FALSE(drive.hasElsewhere()) << "all is told";
}

TEST(Rivals, OneSearchAmongMisfitsPutsNobodyAhead) {
  Drive drive;
  drive.misfit = 10.0;
  for (int i = 0; i < 3; ++i) drive.reading(0.31, {8, -5, 2}, Pose2{1000, 1000, 0});
  EXPECT_FALSE(drive.reading(0.31, {8, -5, 2}));
  ASSERT_TRUE(drive.hasElsewhere());
  EXPECT_LE(drive.rivals.lead(), 4.0) << "what a reading counts at most";
}

// A wide belief contains the place: it predicts readings badly, but they fit it well.
TEST(Rivals, APlaceWhereReadingsFitTheBeliefAsWellIsNoOther) {
  Drive drive;
  drive.misfit = 10.0;
  drive.ofBelief = 0.61;  // of the two thirds where the robot is
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(drive.reading(0.31, {8, -5, 2})) << i;
  drive.ofBelief = 0.59;
  EXPECT_FALSE(drive.reading(0.31, {8, -5, 2})) << "the first that counts";
  EXPECT_TRUE(drive.reading(0.31, {8, -5, 2}));
}

TEST(Rivals, APlaceThatComesAlongWithTheRobotCarriesNobodyAway) {
  Drive drive;
  drive.misfit = 10.0;
  for (int i = 0; i < 40; ++i)
    EXPECT_FALSE(drive.reading(0.31, {8, -5, 2}, Pose2{0, -3, 1})) << "a crowd around it, " << i;
}

TEST(Rivals, OfTwoPlacesThatLookAlikeNeitherTakesOverWhileReadingsFitWorseThanUsual) {
  Drive drive;
  drive.misfit = 10.0;
  drive.alike = {{0, -3, 0}};
  for (int i = 0; i < 40; ++i) EXPECT_FALSE(drive.reading(0.31, {8, -5, 2})) << i;
}

TEST(Rivals, OfManyPlacesThatLookAlikeNoneTakesOverBeforeReadingsHaveConfirmedIt) {
  Drive drive;
  drive.alike = kAlike;
  int sinceSearch = 0;
  for (int i = 0; i < 40; ++i) {
    const bool hadRivals = drive.hasElsewhere();
    const auto takeover = drive.reading(0.3, {8, -5, 2});
    sinceSearch += hadRivals ? 1 : 0;
    if (!takeover) continue;
    EXPECT_EQ(sinceSearch, 5);
    EXPECT_EQ(takeover->share, 1.0);
    EXPECT_TRUE(takeover->isConfirmed);
    EXPECT_FALSE(drive.hasElsewhere()) << "all is told";
    return;
  }
  FAIL() << "it never came back";
}

/// How often a robot has to come 0.1 m on until it is found again, after it stood still.
int stepsAfterStanding(const std::vector<Pose2>& alike = {}) {
  Drive drive;
  drive.alike = alike;
  for (int i = 0; i < 200; ++i)
    EXPECT_FALSE(drive.reading(0.0, {8, -5, 2})) << "carried away standing, reading " << i;
  EXPECT_TRUE(drive.hasElsewhere()) << "but there is somebody to compare with";
  for (int i = 1; i < 40; ++i)
    if (drive.reading(0.1, {8, -5, 2})) return i;
  return 40;
}

TEST(Rivals, ReadingsFromOnePlaceCarryNobodyAway) {
  EXPECT_EQ(stepsAfterStanding(), 3) << "slow motion counts by its way, of 0.3 m";
  const int steps = stepsAfterStanding(kAlike);
  EXPECT_GE(steps, 10) << "of 1 m at least";
  EXPECT_LT(steps, 40);
}

TEST(Rivals, ReadingsThatLieForAWhileCarryNobodyAway) {
  for (const int lies : {1, 3, 5}) {
    Drive drive;
    for (int i = 0; i < 60; ++i) {
      // Good readings, and from time to time some that fit elsewhere, each at another place.
      const bool lie = i % 20 < lies;
      const Pose2 elsewhere{8.0 - 3.0 * (i % 5), -5.0 + 2.0 * (i % 3), 2.0 + i};
      const Pose2 next{drive.truth.x + 0.2, drive.truth.y, drive.truth.theta};
      ASSERT_FALSE(drive.reading(0.2, next, lie ? std::optional(elsewhere) : std::nullopt))
          << lies << " lies, reading " << i;
    }
    EXPECT_FALSE(drive.hasElsewhere()) << "the belief was right";
  }
}

TEST(Rivals, WhereOdometryLiedTheSurroundingsTakeOverASharedBelief) {
  for (const double off : {0.6, 1.0}) {
    Drive drive;
    for (const double x : {6.0, 8.0, 10.0}) drive.alike.push_back({x, -3.0, 1.0});
    int taken = 0;
    for (int i = 1; i <= 60 && taken == 0; ++i) {
      const Pose2 believed{drive.truth.x + 0.15, drive.truth.y + off, drive.truth.theta + 0.2};
      const auto takeover = drive.reading(0.15, believed);
      if (!takeover) continue;
      taken = i;
      EXPECT_EQ(takeover->share, 0.9) << "what was believed stays possible";
      EXPECT_LT(distanceOf(takeover->samples, drive.truth), 0.3);
    }
    EXPECT_GE(taken, 5) << off;
    // Its ring begins with 0.5 m and grows by 0.5 m/s; readings come ten times a second.
    EXPECT_LE(taken, 5 + static_cast<int>(std::max(0.0, off - 0.5) / 0.5 * 10.0) + 3) << off;
  }
}

// A heading of its own makes another place, where readings tell the difference.
TEST(Rivals, TheSamePlaceWithAnotherHeadingTakesOver) {
  for (const double off : {kPi, 0.5 * kPi, -2.0}) {
    Drive drive;
    bool isTaken = false;
    for (int i = 0; i < 60 && !isTaken; ++i) {
      const Pose2 believed{drive.truth.x + 0.3, drive.truth.y, drive.truth.theta + off};
      const auto takeover = drive.reading(0.3, believed);
      if (!takeover) continue;
      isTaken = true;
      EXPECT_LT(distanceOf(takeover->samples, drive.truth), 0.3) << off;
      for (const float theta : takeover->samples.theta)
        EXPECT_NEAR(wrapAngle(static_cast<double>(theta) - drive.truth.theta), 0.0, 0.5) << off;
    }
    EXPECT_TRUE(isTaken) << "with a heading that is off by " << off;
  }
}

// Whoever has come to where the belief is has nothing else to say, however far it leads.
TEST(Rivals, WhoMeetsTheBeliefNoLongerCompetes) {
  for (const double turn : {0.0, 0.15, -0.15, 2.0 * kPi}) {
    Drive drive;
    int with = 0;
    for (int i = 0; i < 40 && with < 3; ++i) {
      drive.reading(0.3, {8, -5, 2});
      with += drive.hasElsewhere() ? 1 : 0;
    }
    ASSERT_TRUE(drive.hasElsewhere());
    ASSERT_GT(drive.rivals.lead(), 0.0);
    drive.reading(0.3, {drive.truth.x + 0.4, drive.truth.y, drive.truth.theta + turn});
    EXPECT_FALSE(drive.hasElsewhere()) << turn;
  }
}

TEST(Rivals, NobodyCompetesWhileReadingsFit) {
  Drive drive;
  for (int i = 0; i < 30; ++i) {
    const Pose2 next{drive.truth.x + 0.2, drive.truth.y, drive.truth.theta};
    EXPECT_FALSE(drive.reading(0.2, next));
    EXPECT_FALSE(drive.hasElsewhere());
  }
}

TEST(Rivals, AreForgottenWhenItBeginsAnew) {
  Drive drive;
  drive.reading(0.1, {8, -5, 2});
  ASSERT_TRUE(drive.hasElsewhere());
  drive.rivals.forget();
  EXPECT_FALSE(drive.hasElsewhere());
}

TEST(Rivals, ThoseAroundAreNearThoughTheClockWasSetBack) {
  Drive drive;
  drive.stamp = 1'000'000'000;
  // Each reading speaks for another place near the belief: rivals are dropped and drawn anew.
  for (int i = 0; i < 20; ++i) {
    if (i == 5) drive.stamp = 0;
    drive.reading(0.1, {5, -2, 0}, Pose2{i % 2 ? 4.55 : 5.45, -2, 0});
    const Hypothesis* rival = drive.rivals.hypotheses()[0];
    if (rival == nullptr) continue;
    const SampleSet& around = rival->samples();
    for (std::size_t k = 0; k < around.size(); ++k)
      ASSERT_LT(std::hypot(around.x[k] - 5.0F, around.y[k] + 2.0F), 20.0F) << "reading " << i;
  }
}

}  // namespace
}  // namespace ortung
