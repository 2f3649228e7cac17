// What counts as news: frozen scanners, robots that stand, clocks that are set.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "Intake.hpp"
#include "Told.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/motion/OdometryMotion.hpp"

namespace ortung {
namespace {

using test::Told;
using Words = std::vector<std::uint32_t>;

/// n different words.
Words countedFrom(std::uint32_t first, std::size_t n = 16) {
  Words words(n);
  std::iota(words.begin(), words.end(), first);
  return words;
}

/// A robot with odometry and one feature; all that is news is used at once.
struct Robot {
  Robot() {
    container.add(std::make_unique<OdometryData>(SensorId{"base", "odometry", "pose"}));
    feature = &container.add(
        std::make_unique<Told>("scan", [](const SampleView&, std::size_t) { return -1.0F; }));
  }
  /// The robot comes to (x, 0, theta) after @p seconds, and reads. @returns whether that is news
  bool reads(const Words& words, double x, double theta = 0.0, double seconds = 0.1) {
    stamp += fromSeconds(seconds);
    if (tellsOdometry)
      container.set(
          {stamp, {"base", "odometry", "pose"}, OdometryData::encode({{x, 0, theta}, 0, 0, {}})});
    container.set({stamp, feature->id(), words});
    return looks();
  }
  bool looks() {
    const Intake::Look look = intake.look(container, ofBelief, trustsOdometry);
    clockSetTo = look.clockSetTo;
    if (clockSetTo) ofBelief = *clockSetTo;
    for (const auto& [when, news] : look.news) {
      intake.used(news, when, motion.odometryAt(when));
      ofBelief = when;
    }
    return !look.news.empty();
  }

  SensorContainer container;
  SensorData* feature = nullptr;
  OdometryMotion motion;
  MclConfig config;  // 0.05 m, 0.03 rad, 0.5 s
  Intake intake{config, motion};
  Timestamp stamp = fromSeconds(1000);
  Timestamp ofBelief = 0;
  bool tellsOdometry = true;
  bool trustsOdometry = true;
  std::optional<Timestamp> clockSetTo;
};

TEST(Intake, TheSameWordsOnAWayAreThoseOfAFrozenScanner) {
  Robot robot;
  EXPECT_TRUE(robot.reads(countedFrom(1000), 0.0));
  EXPECT_EQ(robot.intake.frozen(), nullptr);
  for (int i = 1; i < 5; ++i) {
    EXPECT_FALSE(robot.reads(countedFrom(1000), 0.1 * i));
    EXPECT_EQ(robot.intake.frozen(), robot.feature);
  }
  EXPECT_FALSE(robot.reads(countedFrom(1000), 0.4)) << "standing does not thaw it";
  EXPECT_EQ(robot.intake.frozen(), robot.feature);
  EXPECT_TRUE(robot.reads(countedFrom(1001), 0.5)) << "one other scan does";
  EXPECT_EQ(robot.intake.frozen(), nullptr);
  EXPECT_FALSE(robot.reads(countedFrom(1001), 0.6));
}

TEST(Intake, OneWordOfManyTellsThatTheScannerLives) {
  Robot robot;
  Words words = countedFrom(1000, 181);
  for (int i = 0; i < 20; ++i) {
    words[static_cast<std::size_t>(i) * 9] ^= 1U;
    EXPECT_TRUE(robot.reads(words, 0.1 * i)) << i;
  }
}

TEST(Intake, ATurnFreezesItTooAndCreepingDoesOnceTheWayIsLongEnough) {
  Robot turning;
  turning.reads(countedFrom(1000), 0.0);
  EXPECT_FALSE(turning.reads(countedFrom(1000), 0.0, 0.04, 0.6));
  EXPECT_EQ(turning.intake.frozen(), turning.feature);
  Robot creeping;
  creeping.reads(countedFrom(1000), 0.0);
  for (int i = 1; i <= 8; ++i) {
    EXPECT_EQ(creeping.reads(countedFrom(1000), 0.01 * i, 0.0, 0.6), i < 5) << i;
    EXPECT_EQ(creeping.intake.frozen() != nullptr, i >= 5) << i;
  }
}

TEST(Intake, ARobotThatStandsMayReadTheSameForEver) {
  Robot robot;
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(robot.reads(countedFrom(1000), 0.0, 0.0, 0.6)) << "max_interval_s is over";
    EXPECT_EQ(robot.intake.frozen(), nullptr);
  }
}

// Fifteen words may be repeated by chance, but not over several readings on end.
TEST(Intake, FewWordsMayComeAgainOnAShortWay) {
  Robot robot;
  const Words words = countedFrom(1000, 15);
  for (const double x : {0.0, 0.1, 0.19}) EXPECT_TRUE(robot.reads(words, x));
  EXPECT_FALSE(robot.reads(words, 0.21));
  EXPECT_EQ(robot.intake.frozen(), robot.feature);
  EXPECT_TRUE(robot.reads(countedFrom(1001, 15), 0.3));
  EXPECT_EQ(robot.intake.frozen(), nullptr);
}

TEST(Intake, FewWordsAndThoseThatAreAllEqualMayComeAgain) {
  for (const Words& words :
       {countedFrom(1000, 5), Words(15, 30000), Words(181, 30000), Words(181, 0), Words()}) {
    Robot robot;
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(robot.reads(words, 0.1 * i)) << words.size();
    EXPECT_EQ(robot.intake.frozen(), nullptr) << words.size();
  }
  Words allButOne(181, 30000);
  allButOne.back() = 2000;
  Robot robot;
  robot.reads(allButOne, 0.0);
  EXPECT_FALSE(robot.reads(allButOne, 0.1));
}

TEST(Intake, WithoutOdometryNobodyKnowsWhetherTheRobotMoved) {
  Robot robot;
  robot.tellsOdometry = false;
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(robot.reads(countedFrom(1000), 0.0, 0.0, 0.01)) << i;
  EXPECT_EQ(robot.intake.frozen(), nullptr);
}

TEST(Intake, NewsComesByWayTurnOrTimeWhileOdometryIsTrusted) {
  const auto isNews = [](double x, double theta, double seconds, bool trusts) {
    Robot robot;
    robot.trustsOdometry = trusts;
    robot.reads(countedFrom(1), 0.0);
    return robot.reads(countedFrom(2), x, theta, seconds);
  };
  EXPECT_FALSE(isNews(0.049, 0.029, 0.4, true));
  EXPECT_TRUE(isNews(0.051, 0.0, 0.01, true));
  EXPECT_TRUE(isNews(0.0, 0.031, 0.01, true));
  EXPECT_TRUE(isNews(0.0, -0.031, 0.01, true));
  EXPECT_TRUE(isNews(0.0, 0.0, 0.5, true));
  EXPECT_TRUE(isNews(0.0, 0.0, 0.001, false)) << "it may have moved, whatever odometry says";
}

TEST(Intake, EachReadingIsNewsOnce) {
  for (const bool trusts : {true, false}) {
    Robot robot;
    robot.trustsOdometry = trusts;
    EXPECT_TRUE(robot.reads(countedFrom(1), 0.0));
    EXPECT_FALSE(robot.looks());
    robot.stamp -= fromSeconds(2);
    EXPECT_FALSE(robot.reads(countedFrom(2), 1.0)) << "late";
  }
}

TEST(Intake, ClocksThatAreSetBackByMoreThanFiveSecondsBeginAnew) {
  for (const double back : {4.9, 5.1, 1e9}) {
    Robot robot;
    robot.reads(countedFrom(1), 0.0);
    const bool isFar = back > 5.0;
    EXPECT_EQ(robot.reads(countedFrom(2), 0.0, 0.0, -back), isFar) << back;
    EXPECT_EQ(robot.clockSetTo.has_value(), isFar) << back;
    EXPECT_EQ(robot.clockSetTo.value_or(robot.stamp), robot.stamp) << back;
    EXPECT_EQ(robot.reads(countedFrom(3), 0.0, 0.0, 0.6), isFar) << back;
    EXPECT_FALSE(robot.clockSetTo);
  }
  // Words are forgotten with it: a log that begins anew begins with the same scan.
  Robot robot;
  robot.reads(countedFrom(1), 0.0);
  EXPECT_TRUE(robot.reads(countedFrom(1), 7.0, 0.0, -100.0));
}

/// A feature whose stamp is of the future, read once.
struct Ahead : Robot {
  explicit Ahead(double seconds) {
    other = &container.add(
        std::make_unique<Told>("other", [](const SampleView&, std::size_t) { return -1.0F; }));
    reads(countedFrom(1), 0.0);
    container.set({stamp + fromSeconds(seconds), other->id(), {}});
    looks();
  }
  SensorData* other = nullptr;
};

// Ten looks on end, over 2 s of the readings' time at least.
TEST(Intake, OneStampOfTheFutureIsOverruledByAllThatComeForSomeTime) {
  for (const auto& [period, expected] : {std::pair{0.1, 21}, {0.25, 10}, {1.0, 10}}) {
    Ahead robot(3600.0);
    int readings = 0;
    do {
      robot.reads(countedFrom(static_cast<std::uint32_t>(100 + readings)), 0.1 * readings, 0.0,
                  period);
      ++readings;
    } while (!robot.clockSetTo && readings < 100);
    EXPECT_EQ(readings, expected) << period;
    EXPECT_EQ(robot.ofBelief, robot.stamp) << "what is of the future was passed over";
    EXPECT_TRUE(robot.reads(countedFrom(9000), 50.0));
    EXPECT_FALSE(robot.clockSetTo);
    robot.container.set({robot.stamp + 1000, robot.other->id(), {}});
    EXPECT_TRUE(robot.looks()) << "its clock is right again";
  }
}

TEST(Intake, AFeatureThatIsLateByFarDoesNotSetTheClock) {
  Ahead robot(0.0);
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(robot.reads(countedFrom(static_cast<std::uint32_t>(100 + i)), 0.1 * (i + 1)));
    for (int k = 0; k < 5; ++k) {
      robot.container.set({robot.stamp - fromSeconds(10.0 - 0.02 * k), robot.other->id(), {}});
      EXPECT_FALSE(robot.looks());
      ASSERT_FALSE(robot.clockSetTo);
    }
  }
}

}  // namespace
}  // namespace ortung
