#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "Files.hpp"
#include "MadeSource.hpp"
#include "ortung/study/Cases.hpp"

namespace ortung::test {
namespace {

constexpr Timestamp kSecond = 1'000'000;
constexpr Timestamp kTenth = 100'000;
constexpr Timestamp kBegin = 77 * kSecond;

/// 400 s on a circle of 10 m radius at 0.5 m/s, ten times a second. Odometry has a frame of its
/// own, and a scan of one word, its number, comes every second.
class Log : public testing::Test {
 protected:
  static constexpr double kRadius = 10.0;

  Log() {
    std::vector<Message> messages;
    for (int i = 0; i <= 4000; ++i) {
      const Timestamp now = kBegin + i * kTenth;
      messages.push_back({now, kOdometryId, OdometryData::encode({odometryAt(i), 0.5, 0.05, {}})});
      if (i % 10 == 0) messages.push_back({now, kSonarId, {static_cast<std::uint32_t>(i)}});
      messages.push_back({now, kTruthId, PoseData::encode(truthAt(i))});
    }
    recording = recordingOf(messages);
  }
  static std::shared_ptr<const Recording> recordingOf(const std::vector<Message>& messages) {
    Ended source(messages);
    return std::make_shared<Recording>("made", source);
  }
  static Pose2 truthAt(int i) {
    const double angle = 0.005 * i;
    return {kRadius * std::cos(angle), kRadius * std::sin(angle),
            wrapAngle(angle + std::numbers::pi / 2)};
  }
  static Pose2 odometryAt(int i) { return Pose2{4, 5, 1} * (inverse(truthAt(0)) * truthAt(i)); }

  struct Ended : MadeSource {
    using MadeSource::MadeSource;
    double progress() const override { return 0.5; }
  };
  std::vector<Message> played(const std::shared_ptr<const Splice>& splice) const {
    const auto source = play(splice, robot.container);
    std::vector<Message> messages;
    for (Message message; source->next(message);) messages.push_back(message);
    EXPECT_DOUBLE_EQ(source->progress(), 1.0);
    EXPECT_EQ(source->worldFingerprint(), "made");
    return messages;
  }
  static Pose2 truthOf(const Message& message) {
    PoseData data(message.id);
    data.setData(message.stamp, message.words);
    return data.reading();
  }
  static Pose2 odometryOf(const Message& message) {
    OdometryData data(message.id);
    data.setData(message.stamp, message.words);
    return data.reading().pose;
  }

  const MadeRobot robot;
  std::shared_ptr<const Recording> recording;
};

TEST_F(Log, RecordingKnowsTheTruthAndTheWay) {
  ASSERT_EQ(recording->truth().size(), 4001u);
  EXPECT_NEAR(recording->truth().back().travelled, 200.0, 0.2);
  EXPECT_EQ(recording->truth()[10].stamp, kBegin + kSecond);
  EXPECT_EQ(recording->messages()[recording->truth()[10].message].id, kOdometryId);
  EXPECT_EQ(carriedFar(*recording), 8.0);
  std::vector<Message> small;
  for (const Pose2& pose : {Pose2{1, 1, 0}, Pose2{4, 1, 0}, Pose2{4, 5, 0}})
    small.push_back({static_cast<Timestamp>(small.size()), kTruthId, PoseData::encode(pose)});
  EXPECT_NEAR(carriedFar(*recordingOf(small)), 5.0 / 3, 1e-9);  // a third of its diagonal
}

TEST_F(Log, PieceByItselfIsPlayedAsItWas) {
  const auto splice = std::make_shared<Splice>(recording, std::vector<Piece>{{100, 5000}});
  EXPECT_EQ(played(splice), std::vector<Message>(recording->messages().begin() + 100,
                                                 recording->messages().begin() + 5000));
  EXPECT_TRUE(splice->joins().empty());
}

// Moments of 0, 0.3, 5.3 and 5.6 s; two of them have two readings, and two truths.
TEST_F(Log, PiecesFollowEachOtherAsTheLogWentOn) {
  std::vector<Message> messages;
  for (const Timestamp stamp : {0, 300'000, 5'300'000, 5'600'000}) {
    messages.push_back({stamp, kSonarId, {1}});
    messages.push_back({stamp, kScanId, {1}});
    messages.push_back({stamp, kTruthId, PoseData::encode({})});
    messages.push_back({stamp, kTruthId, PoseData::encode({1, 0, 0})});
  }
  const auto made = recordingOf(messages);
  EXPECT_EQ(made->truth().size(), 4u) << "one a moment";
  EXPECT_EQ(made->truth().back().travelled, 0.0) << "the first one";
  const auto joins = [&](const std::vector<Piece>& pieces) { return Splice(made, pieces).joins(); };
  EXPECT_EQ(joins({{0, 4}, {12, 16}}), std::vector<Timestamp>{300'000}) << "as long as it took";
  EXPECT_EQ(joins({{0, 8}, {0, 4}}), std::vector<Timestamp>{1'300'000}) << "1 s at most";
  EXPECT_EQ(joins({{12, 16}, {0, 4}}), std::vector<Timestamp>{5'700'000}) << "the log ends there";
  EXPECT_EQ(Splice(made, {{0, 16}}).readings(robot.container, 300'000, 5'600'000), 2u)
      << "moments, not readings";
  for (const Piece& wrong : {Piece{3, 3}, Piece{4, 3}, Piece{0, 17}})
    EXPECT_THROW(Splice(made, {wrong}), std::invalid_argument);
  EXPECT_THROW(Splice(made, {}), std::invalid_argument);
}

TEST_F(Log, KidnapIsFarAndUnseenByOdometry) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    const auto splice = kidnapped(recording, seed);
    ASSERT_EQ(splice->joins().size(), 1u);
    const Timestamp join = splice->joins().front();
    const std::vector<Message> messages = played(splice);
    EXPECT_TRUE(std::ranges::is_sorted(messages, {}, &Message::stamp));
    const auto truth = only(messages, kTruthId);
    const auto odometry = only(messages, kOdometryId);
    ASSERT_EQ(truth.size(), odometry.size());
    EXPECT_GE(join - messages.front().stamp, 19 * kSecond);
    EXPECT_LE(join - messages.front().stamp, 61 * kSecond);
    EXPECT_GE(messages.back().stamp - join, 29 * kSecond);
    EXPECT_LE(messages.back().stamp - join, 301 * kSecond);
    for (std::size_t i = 1; i < truth.size(); ++i) {
      EXPECT_EQ(truth[i].stamp - truth[i - 1].stamp, kTenth) << "time goes on";
      const Pose2 moved = inverse(truthOf(truth[i - 1])) * truthOf(truth[i]);
      const Pose2 told = inverse(odometryOf(odometry[i - 1])) * odometryOf(odometry[i]);
      if (truth[i].stamp == join) {
        EXPECT_GE(distance({}, moved), carriedFar(*recording) - 0.05);
        EXPECT_NEAR(distance({}, told), 0.0, 0.002) << "who is carried does not drive";
        EXPECT_NEAR(told.theta, 0.0, 0.0002);
      } else {
        EXPECT_NEAR(told.x, moved.x, 0.004);
        EXPECT_NEAR(told.y, moved.y, 0.004);
        EXPECT_NEAR(told.theta, moved.theta, 0.0006);
      }
    }
    // Ten moments a second, one in ten of which has a scan.
    const double seconds = toSeconds(messages.back().stamp - join);
    EXPECT_NEAR(
        static_cast<double>(splice->readings(robot.container, join, messages.back().stamp + 1)),
        seconds, 1.0);
  }
}

TEST_F(Log, CasesDependOnTheSeedAlone) {
  std::set<std::size_t> beginnings;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(played(kidnapped(recording, seed)), played(kidnapped(recording, seed)));
    beginnings.insert(wokenUp(recording, seed)->pieces().front().begin);
    EXPECT_EQ(wokenUp(recording, seed)->pieces().front().begin,
              wokenUp(recording, seed)->pieces().front().begin);
  }
  EXPECT_GT(beginnings.size(), 15u);
}

TEST_F(Log, WakeUpLeavesWayToGo) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const auto splice = wokenUp(recording, seed, 150.0);
    ASSERT_EQ(splice->pieces().size(), 1u);
    const auto truth = only(played(splice), kTruthId);
    EXPECT_GE(truth.size(), 2990u) << "150 m at 0.5 m/s";
    EXPECT_EQ(truth.back().stamp, kBegin + 400 * kSecond);
  }
}

// The way between two is the larger one of 15 m (30 s) and what has an exponential distribution
// with a mean of 10 m: 17.2 m in the mean, so there are 11.6 at most in the 200 m of the log. It
// may end before, wherever the last one led to.
TEST_F(Log, TeleportsComeAtTheirRateUntilTheLogsTimeIsOver) {
  double joins = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto splice = teleported(recording, seed, 0.1);
    const auto truth = only(played(splice), kTruthId);
    EXPECT_LE(truth.size(), 4002u + 10u);
    joins += static_cast<double>(splice->joins().size());
    for (std::size_t i = 1; i < splice->joins().size(); ++i)
      EXPECT_GE(splice->joins()[i] - splice->joins()[i - 1], 29 * kSecond);
    for (std::size_t i = 1; i < truth.size(); ++i) {
      const bool isJoin = std::ranges::count(splice->joins(), truth[i].stamp) > 0;
      const double step = distance(truthOf(truth[i - 1]), truthOf(truth[i]));
      if (isJoin) {
        EXPECT_GE(step, carriedFar(*recording) - 0.06);
      } else {
        EXPECT_LE(step, 0.06);
      }
    }
  }
  EXPECT_GT(joins / 40, 3.0);
  EXPECT_LT(joins / 40, 11.6);
  EXPECT_TRUE(teleported(recording, 1, 1e-6)->joins().empty());
}

TEST_F(Log, WhatCanNotBeMadeIsSaid) {
  const auto refused = [](const std::vector<Message>& messages, auto make) {
    const auto recorded = recordingOf(messages);
    return messageOf<std::invalid_argument>([&] { make(recorded); });
  };
  const auto kidnap = [](const auto& r) { kidnapped(r, 1); };
  const auto wakeUp = [](const auto& r) { wokenUp(r, 1); };
  const std::vector<Message> blind = only(recording->messages(), kOdometryId);
  EXPECT_NE(refused(blind, kidnap).find("made: has less than 10 s of ground truth"),
            std::string::npos);
  EXPECT_NE(refused({}, wakeUp).find("less than 10 s"), std::string::npos);
  std::vector<Message> standing = only(recording->messages(), kTruthId);
  for (Message& message : standing) message.words = standing.front().words;
  EXPECT_NE(refused(standing, wakeUp).find("0.000000 m travelled"), std::string::npos);
  EXPECT_NE(refused(standing, kidnap).find("could be carried 0.000000 m"), std::string::npos);
  EXPECT_THROW(teleported(recording, 1, 0.0), std::invalid_argument);
  MadeSource endless({});
  EXPECT_NE(
      messageOf<std::invalid_argument>([&] { Recording("sim:x", endless); }).find("has no end"),
      std::string::npos);
}

}  // namespace
}  // namespace ortung::test
