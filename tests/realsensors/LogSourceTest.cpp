/// The order of a log's readings, and motion that is computed from poses.

#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "LogTesting.hpp"
#include "Seeded.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/realsensors/LogSource.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;
constexpr double kPi = std::numbers::pi;

/// A log of two features, "m/t/a" and "m/t/b", with one word a reading.
class SmallLog : public LogSource {
 public:
  SmallLog() : a_(addFeature({"m", "t", "a"})), b_(addFeature({"m", "t", "b"})) {}
  SmallLog& add(char feature, Timestamp stamp, std::vector<std::uint32_t> words) {
    LogSource::add(feature == 'a' ? a_ : b_, stamp, words);
    return *this;
  }
  SmallLog& end() {
    finish("small.log");
    return *this;
  }
  std::string robotToml() const override { return ""; }
  void writeWorld(const std::filesystem::path&) const override {}

 private:
  std::uint32_t a_, b_;
};

TEST(LogSource, SortsReadingsByTimeThenByFeature) {
  SmallLog log;
  log.add('b', 20, {1}).add('a', 20, {2, 3}).add('b', -10, {}).add('a', 30, {4}).end();
  EXPECT_EQ(asText(readAll(log)),
            (std::vector<std::string>{"-10 m/t/b", "20 m/t/a 2 3", "20 m/t/b 1", "30 m/t/a 4"}));
}

TEST(LogSource, OfTwoReadingsOfOneTimeTheLaterOneOfTheFileStays) {
  SmallLog log;
  log.add('a', 5, {1}).add('b', 5, {2}).add('a', 5, {3}).add('a', 5, {4}).add('a', 6, {5}).end();
  EXPECT_EQ(asText(readAll(log)),
            (std::vector<std::string>{"5 m/t/a 4", "5 m/t/b 2", "6 m/t/a 5"}));
}

TEST(LogSource, TellsHowFarItIs) {
  SmallLog log;
  log.add('a', 1, {1}).add('a', 2, {1}).add('a', 3, {1}).add('a', 4, {1}).end();
  Message message;
  EXPECT_EQ(log.progress(), 0.0);
  ASSERT_TRUE(log.next(message));
  EXPECT_EQ(log.progress(), 0.25);
  while (log.next(message)) {
  }
  EXPECT_EQ(log.progress(), 1.0);
  EXPECT_EQ(message.stamp, 4) << "the end changes nothing";
}

TEST(LogSource, IsNoLogWithoutAReading) {
  SmallLog log;
  EXPECT_EQ(errorOf([&] { log.end(); }), "small.log: found no reading, expected at least one");
}

/// The odometry that its words mean.
OdometryData::Reading decoded(const std::vector<std::uint32_t>& words) {
  OdometryData data({"odometry", "odometry", "pose"});
  data.setData(0, words);
  return data.reading();
}

// From (1, 2) looking along y: 0.5 m forward and 0.2 m to the left within 0.25 s, turning right by
// 0.1 rad. The sideways part is not a velocity of a robot with two wheels.
TEST(PoseOdometry, DividesTheWayInTheRobotsFrameByTheTime) {
  PoseOdometry odometry;
  const auto first = decoded(odometry.words(1'000'000, {1, 2, kPi / 2}));
  EXPECT_NEAR(first.pose.y, 2.0, 1e-9);
  EXPECT_EQ(first.translationalVelocity, 0.0);
  EXPECT_EQ(first.rotationalVelocity, 0.0);
  const auto second = decoded(odometry.words(1'250'000, {0.8, 2.5, kPi / 2 - 0.1}));
  EXPECT_NEAR(second.translationalVelocity, 2.0, 1e-3);
  EXPECT_NEAR(second.rotationalVelocity, -0.4, 1e-4);
  EXPECT_EQ(second.lateralVelocity, 0.0);
}

TEST(PoseOdometry, KeepsItsVelocityWhereTheClockHardlyMoves) {
  PoseOdometry odometry;
  odometry.words(0, {0, 0, 0});
  EXPECT_NEAR(decoded(odometry.words(1'000, {0.001, 0, 0})).translationalVelocity, 1.0, 1e-9);
  const auto soon = decoded(odometry.words(1'999, {0.5, 0, 1}));  // less than a millisecond later
  EXPECT_NEAR(soon.translationalVelocity, 1.0, 1e-9);
  EXPECT_EQ(soon.rotationalVelocity, 0.0);
  const auto later = decoded(odometry.words(1'001'999, {0.5, 0, 1}));
  EXPECT_EQ(later.translationalVelocity, 0.0) << "it stood since the last pose";
}

TEST(PoseOdometry, TurnsTheShortWayRound) {
  PoseOdometry odometry;
  odometry.words(0, {0, 0, 3.1});
  EXPECT_NEAR(decoded(odometry.words(1'000'000, {0, 0, -3.1})).rotationalVelocity, 2 * kPi - 6.2,
              2e-4);
}

/// A number between two bounds, in thousandths of the distance between them.
double between(double low, double high) {
  return low + (high - low) * 1e-3 * *rc::gen::inRange(0, 1001);
}

// The arc, cut into 20000 straight steps.
RC_GTEST_PROP(AlongArcProperty, IsWhereManySmallStepsLead, ()) {
  const Pose2 start{between(-5, 5), between(-5, 5), between(-3, 3)};
  const double v = between(-2, 2);
  const double w = between(-3, 3);
  const double seconds = between(0, 2);
  constexpr int kSteps = 20000;
  double x = start.x, y = start.y;
  for (int i = 0; i < kSteps; ++i) {
    const double heading = start.theta + w * seconds * (i + 0.5) / kSteps;
    x += v * seconds / kSteps * std::cos(heading);
    y += v * seconds / kSteps * std::sin(heading);
  }
  const Pose2 end = alongArc(start, v, w, seconds);
  RC_ASSERT(std::hypot(end.x - x, end.y - y) < 1e-6);
  RC_ASSERT(std::abs(std::remainder(end.theta - start.theta - w * seconds, 2 * kPi)) < 1e-9);
}

// Places on a circle, 1 degree apart: the chord over n steps has the direction of its middle.
TEST(HeadingsOfWay, AreThoseOfChordsOnACircle) {
  const auto place = [](int degree) {
    const double angle = degree * kPi / 180;
    return Pose2{2 * std::cos(angle), 2 * std::sin(angle), 0};
  };
  std::vector<Pose2> places;
  for (int degree = 0; degree < 90; ++degree) places.push_back(place(degree));
  const double step = 2 * 2 * std::sin(2.5 * kPi / 180) - 1e-9;  // the chord over 5 degrees
  const std::vector<double> headings = headingsOfWay(places, step);
  for (int degree = 0; degree < 85; ++degree) {
    const double middle = 5 * (degree / 5) + 2.5;
    EXPECT_NEAR(headings[static_cast<std::size_t>(degree)], (middle + 90) * kPi / 180, 1e-9)
        << degree;
  }
  EXPECT_EQ(headings[89], headings[84]) << "behind the last step its direction holds";
}

TEST(HeadingsOfWay, OfARobotThatStaysAreZero) {
  const std::vector<Pose2> places(5, Pose2{3, 4, 1});
  EXPECT_EQ(headingsOfWay(places, 0.1), std::vector<double>(5, 0.0));
  EXPECT_EQ(headingsOfWay({places.data(), 1}, 0.1), std::vector<double>(1, 0.0));
}

}  // namespace
}  // namespace ortung
