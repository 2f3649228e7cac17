#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "Files.hpp"
#include "MadeSource.hpp"
#include "ortung/study/Disturbed.hpp"

namespace ortung::test {
namespace {

constexpr Timestamp kSecond = 1'000'000;
constexpr Timestamp kBegin = 5 * kSecond;  ///< no run begins at 0
const Pose2 kFirst{3, -2, 0.5};            ///< nor at the origin

/// Twenty seconds, each with odometry, a distance (its number) and ground truth. The robot goes a
/// circle: 0.4 m and 0.1 rad a second.
class DisturbedRun : public testing::Test {
 protected:
  static constexpr double kWay = 0.4;
  static constexpr double kTurn = 0.1;

  DisturbedRun() {
    for (int i = 0; i < 20; ++i) {
      const Timestamp now = kBegin + i * kSecond;
      const auto words =
          OdometryData::encode({kFirst * arc(kWay * i, kTurn * i), kWay, kTurn, {9}});
      messages.push_back({now, kOdometryId, words});
      messages.push_back({now, kSonarId, {static_cast<std::uint32_t>(1000 + i)}});
      messages.push_back({now, kTruthId, PoseData::encode({0.1 * i, 0, 0})});
    }
  }

  /// Where an arc ends that begins at the origin.
  static Pose2 arc(double way, double turn) {
    if (turn == 0.0) return {way, 0, 0};
    return {way / turn * std::sin(turn), way / turn * (1 - std::cos(turn)), turn};
  }
  static OdometryData::Reading read(const Message& message) {
    OdometryData data(message.id);
    data.setData(message.stamp, message.words);
    return data.reading();
  }
  std::vector<OdometryData::Reading> odometry(const std::string& fault) const {
    std::vector<OdometryData::Reading> readings;
    for (const Message& m : only(robot.disturb(messages, {fault}), kOdometryId))
      readings.push_back(read(m));
    return readings;
  }
  /// Words are millimetres and hundredths of degrees, and each reading that is altered adds up
  /// those of the ones before it.
  static void expectNear(const Pose2& a, const Pose2& b, int second) {
    EXPECT_NEAR(a.x, b.x, 0.012) << second;
    EXPECT_NEAR(a.y, b.y, 0.012) << second;
    EXPECT_NEAR(wrapAngle(a.theta - b.theta), 0.0, 0.0012) << second;
  }
  static std::vector<std::uint32_t> sonar(const std::vector<Message>& given) {
    std::vector<std::uint32_t> words;
    for (const Message& m : only(given, kSonarId)) words.push_back(m.words.at(0) - 1000);
    return words;
  }

  const MadeRobot robot;
  std::vector<Message> messages;
};

TEST_F(DisturbedRun, WithoutFaultsOrOutsideOfTheirTimeNothingChanges) {
  EXPECT_EQ(robot.disturb(messages, {}), messages);
  for (const char* fault : {"odometry=scale:2@20-30", "readings=missing@20",
                            "readings=late:3@25-26", "LMS200/LRF/scan=missing"})
    EXPECT_EQ(robot.disturb(messages, {fault}), messages) << fault;
}

TEST_F(DisturbedRun, GroundTruthIsNeverAltered) {
  const std::vector<Message> truth = only(messages, kTruthId);
  for (const char* fault : {"readings=missing", "readings=frozen", "readings=drop:1",
                            "readings=late:2", "odometry=none"})
    EXPECT_EQ(only(robot.disturb(messages, {fault}), kTruthId), truth) << fault;
}

TEST_F(DisturbedRun, MissingReadingsAreThoseFromItsBeginningAndBeforeItsEnd) {
  EXPECT_EQ(sonar(robot.disturb(messages, {"readings=missing@2-17"})),
            (std::vector<std::uint32_t>{0, 1, 17, 18, 19}));
  EXPECT_EQ(sonar(robot.disturb(messages, {"front/sonar/distance=missing@1"})),
            (std::vector<std::uint32_t>{0}));
  EXPECT_TRUE(only(robot.disturb(messages, {"odometry=none"}), kOdometryId).empty());
  EXPECT_EQ(sonar(robot.disturb(messages, {"odometry=none"})).size(), 20u);
}

TEST_F(DisturbedRun, FrozenReadingsRepeatTheFirstWithNewStamps) {
  const auto given = robot.disturb(messages, {"readings=frozen@15-18"});
  EXPECT_EQ(sonar(given), (std::vector<std::uint32_t>{0,  1,  2,  3,  4,  5,  6,  7,  8,  9,
                                                      10, 11, 12, 13, 14, 15, 15, 15, 18, 19}));
  const auto some = only(given, kSonarId);
  for (std::size_t i = 0; i < some.size(); ++i)
    EXPECT_EQ(some[i].stamp, kBegin + static_cast<Timestamp>(i) * kSecond);
  for (const auto& reading : odometry("odometry=zero")) {
    expectNear(reading.pose, kFirst, 0);
    EXPECT_DOUBLE_EQ(reading.translationalVelocity, kWay);
  }
}

TEST_F(DisturbedRun, DropsAShareAsTheSeedSays) {
  std::vector<Message> many;
  for (std::uint32_t i = 0; i < 10000; ++i) many.push_back({i, kSonarId, {i}});
  const auto kept = robot.disturb(many, {"readings=drop:0.8"}, 7);
  EXPECT_NEAR(static_cast<double>(kept.size()), 2000.0, 160.0);  // 4 sigma of the binomial
  EXPECT_EQ(robot.disturb(many, {"readings=drop:0.8"}, 7), kept);
  EXPECT_NE(robot.disturb(many, {"readings=drop:0.8"}, 8), kept);
  EXPECT_EQ(robot.disturb(many, {"readings=drop:0"}), many);
  EXPECT_TRUE(robot.disturb(many, {"readings=drop:1"}).empty());
}

TEST_F(DisturbedRun, LateReadingsKeepTheirWordsAndComeInTheOrderOfStamps) {
  const auto given = robot.disturb(messages, {"readings=late:2.5"});
  EXPECT_EQ(given.size(), messages.size());
  EXPECT_TRUE(std::ranges::is_sorted(given, {}, &Message::stamp));
  const auto some = only(given, kSonarId);
  ASSERT_EQ(some.size(), 20u);
  for (std::size_t i = 0; i < some.size(); ++i) {
    EXPECT_EQ(some[i].stamp, kBegin + static_cast<Timestamp>(i) * kSecond + 2'500'000);
    EXPECT_EQ(some[i].words, std::vector<std::uint32_t>{static_cast<std::uint32_t>(1000 + i)});
  }
  EXPECT_EQ(only(given, kOdometryId), only(messages, kOdometryId));
}

// What is still on its way as the clock is right again would come after newer readings.
TEST_F(DisturbedRun, LateReadingsThatNewerOnesHaveOvertakenNeverCome) {
  const auto some = only(robot.disturb(messages, {"readings=late:3@5-10"}), kSonarId);
  std::vector<std::pair<Timestamp, std::uint32_t>> found;
  for (const Message& m : some)
    found.emplace_back((m.stamp - kBegin) / kSecond, m.words.at(0) - 1000);
  EXPECT_EQ(found, (std::vector<std::pair<Timestamp, std::uint32_t>>{{0, 0},
                                                                     {1, 1},
                                                                     {2, 2},
                                                                     {3, 3},
                                                                     {4, 4},
                                                                     {8, 5},
                                                                     {9, 6},
                                                                     {10, 7},
                                                                     {10, 10},
                                                                     {11, 11},
                                                                     {12, 12},
                                                                     {13, 13},
                                                                     {14, 14},
                                                                     {15, 15},
                                                                     {16, 16},
                                                                     {17, 17},
                                                                     {18, 18},
                                                                     {19, 19}}));
}

TEST_F(DisturbedRun, ScaledWayIsALargerCircle) {
  const auto given = odometry("odometry=scale:1.5");
  for (int i = 0; i < 20; ++i) {
    expectNear(given[static_cast<std::size_t>(i)].pose, kFirst * arc(1.5 * kWay * i, kTurn * i), i);
    EXPECT_NEAR(given[static_cast<std::size_t>(i)].translationalVelocity, 1.5 * kWay, 1e-9);
    EXPECT_NEAR(given[static_cast<std::size_t>(i)].rotationalVelocity, kTurn, 1e-4);
    EXPECT_EQ(given[static_cast<std::size_t>(i)].motionData, std::vector<std::uint32_t>{9});
  }
}

// The chord of a piece is taken for its arc: at 0.1 rad that is 0.1 % of the way.
TEST_F(DisturbedRun, LargerTurnsAreASmallerCircle) {
  const auto given = odometry("odometry=turn:2");
  for (int i = 0; i < 20; ++i)
    expectNear(given[static_cast<std::size_t>(i)].pose, kFirst * arc(kWay * i, 2 * kTurn * i), i);
  EXPECT_NEAR(given[5].rotationalVelocity, 2 * kTurn, 2e-4);
}

TEST_F(DisturbedRun, ReversedWayTurnsTheSameWay) {
  const auto given = odometry("odometry=reverse");
  for (int i = 0; i < 20; ++i)
    expectNear(given[static_cast<std::size_t>(i)].pose, kFirst * arc(-kWay * i, kTurn * i), i);
  EXPECT_NEAR(given[5].translationalVelocity, -kWay, 1e-9);
}

TEST_F(DisturbedRun, SlippingOdometryStandsAndGoesOnFromThere) {
  const auto given = odometry("odometry=slip@4-10");
  for (int i = 0; i < 20; ++i) {
    const int told = i < 4 ? i : std::max(3, i - 6);  // the six seconds that end at 4, ..., 9
    expectNear(given[static_cast<std::size_t>(i)].pose, kFirst * arc(kWay * told, kTurn * told), i);
    EXPECT_NEAR(given[static_cast<std::size_t>(i)].translationalVelocity,
                i >= 4 && i < 10 ? 0.0 : kWay, 1e-9);
  }
}

TEST_F(DisturbedRun, JumpsOnceInTheRobotsFrame) {
  const auto given = odometry("odometry=jump:1,-0.5,90@6");
  for (int i = 0; i < 20; ++i) {
    const Pose2 truth = kFirst * arc(kWay * i, kTurn * i);
    const Pose2 atJump = kFirst * arc(kWay * 6, kTurn * 6);
    const Pose2 expected =
        i < 6 ? truth : atJump * Pose2{1, -0.5, std::numbers::pi / 2} * (inverse(atJump) * truth);
    expectNear(given[static_cast<std::size_t>(i)].pose, expected, i);
  }
}

TEST_F(DisturbedRun, SeveralFaultsWorkOneAfterTheOther) {
  const auto given = robot.disturb(
      messages, {"odometry=scale:2@0-5", "odometry=scale:0.5@0-5", "readings=missing@1"});
  EXPECT_EQ(sonar(given), std::vector<std::uint32_t>{0});
  const auto some = only(given, kOdometryId);
  for (std::size_t i = 0; i < some.size(); ++i)
    expectNear(read(some[i]).pose,
               kFirst * arc(kWay * static_cast<double>(i), kTurn * static_cast<double>(i)), 0);
}

TEST_F(DisturbedRun, HandsOnWhatTheSourceSaysAndNamesFaultsThatMetNothing) {
  const auto source =
      disturbed(std::make_unique<MadeSource>(messages),
                {parseFault("readings=missing@3-4"), parseFault("LMS200/LRF/scan=missing")},
                robot.container, 1);
  for (Message message; source->next(message);) {
  }
  EXPECT_EQ(source->worldFingerprint(), "made");
  EXPECT_EQ(source->remark(), "made up; the fault 'LMS200/LRF/scan=missing' met no reading");
}

// A live source would make whoever localizes wait for the next reading.
TEST_F(DisturbedRun, ReadingsAreGivenAsSoonAsTheyCome) {
  struct Counting : MadeSource {
    Counting(std::vector<Message> messages, std::size_t& taken)
        : MadeSource(std::move(messages)), count(taken) {}
    bool next(Message& message) override {
      ++count;
      return MadeSource::next(message);
    }
    std::size_t& count;
  };
  std::size_t taken = 0;
  const auto source = disturbed(std::make_unique<Counting>(messages, taken),
                                {parseFault("readings=late:2")}, robot.container, 1);
  Message message;
  ASSERT_TRUE(source->next(message));
  EXPECT_EQ(taken, 1u);
}

// Whoever takes the readings says what is wrong with them.
TEST_F(DisturbedRun, WordsThatAreNoneAndTimesThatAreNonePass) {
  const std::vector<Message> hostile = {{std::numeric_limits<Timestamp>::min(), kSonarId, {1}},
                                        {0, kOdometryId, {1, 2}},
                                        {0, kOdometryId, {0, 0, 4000000000, 0, 0}},
                                        {0, kScanId, {1, 2, 3}},
                                        {std::numeric_limits<Timestamp>::max(), kSonarId, {}}};
  EXPECT_EQ(robot.disturb(hostile, {"odometry=scale:2", "readings=crowd", "readings=random:1",
                                    "front/sonar/distance=late:3600"}),
            hostile);
}

}  // namespace
}  // namespace ortung::test
