#include <cmath>
#include <thread>

#include "RoomRun.hpp"
#include "ortung/formats/TrackData.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/run/Localization.hpp"

namespace ortung::test {
namespace {

using Localizing = RoomRun;

bool same(const PoseEstimate& a, const PoseEstimate& b) {
  return a.stamp == b.stamp && a.pose.x == b.pose.x && a.pose.y == b.pose.y &&
         a.pose.theta == b.pose.theta && a.covariance == b.covariance && a.samples == b.samples;
}

TEST_F(Localizing, FollowsASource) {
  Localization localization(fromRecord());
  std::size_t estimates = 0;
  while (const auto estimate = localization.next()) {
    ++estimates;
    ASSERT_TRUE(localization.feeder().truth());
    EXPECT_LT(distance(estimate->pose, *localization.feeder().truth()), 0.15);  // cells of 0.1 m
    EXPECT_GT(localization.updateMilliseconds(), 0.0);
  }
  EXPECT_GT(estimates, 10U);
  EXPECT_EQ(localization.feeder().moments(), 41U);
}

TEST_F(Localizing, ReadingsOfTheProgramGiveWhatASourceGives) {
  Localization pulled(fromRecord());
  Localization pushed(config());
  std::size_t estimates = 0;
  for (const auto& moment : moments) {
    pushed.container().set(moment);
    const auto own = pushed.update();
    if (!own) continue;
    const auto other = pulled.next();
    ASSERT_TRUE(other);
    EXPECT_TRUE(same(*own, *other)) << "at " << own->stamp << " us";
    ++estimates;
  }
  EXPECT_FALSE(pulled.next());
  EXPECT_GT(estimates, 10U);
}

TEST_F(Localizing, TakesWhatIsOpenedAlready) {
  auto robot = openRobot(robotFile, tables);
  Localization opened(std::move(robot), std::make_unique<RecordSource>(recordFile), config());
  Localization named(fromRecord());
  while (const auto estimate = named.next()) {
    const auto other = opened.next();
    ASSERT_TRUE(other);
    EXPECT_TRUE(same(*estimate, *other));
  }
}

TEST_F(Localizing, ReadingsMayComeFromOtherThreads) {
  Localization localization(config());
  // Where odometry began must be seen; of all that follows, as much as the threads happen to.
  localization.container().set(moments[0]);
  EXPECT_TRUE(localization.update());
  std::thread device([&] {
    for (const auto& moment : moments) localization.container().set(moment);
  });
  const Timestamp last = moments.back()[0].stamp;
  std::size_t estimates = 0;
  bool isLast = false;
  while (!isLast) {
    {
      const auto lock = localization.container().read();
      isLast = localization.container().find({.type = "LRF"})->stamp() == last;
    }
    if (localization.update()) ++estimates;
  }
  device.join();
  EXPECT_GE(estimates, 1U);
  EXPECT_EQ(localization.mcl().estimate().stamp, last);
  EXPECT_LT(distance(localization.mcl().estimate().pose, truth), 0.15);
}

TEST_F(Localizing, ARefusedMomentIsNamedWithSourceAndTime) {
  moments[3][1].words.pop_back();
  record("room-1");
  Localization localization(fromRecord());
  EXPECT_EQ(messageOf<std::runtime_error>([&] {
              while (localization.next()) {
              }
            }),
            "record:" + recordFile.string() +
                ": reading at 300000 us: LMS200/LRF/180DegreeScan: found 30 words, expected 31");
}

TEST_F(Localizing, ReadingsOfAnotherWorldAreRefusedUnlessAskedFor) {
  learn("room-2");
  const std::string facts = "record:" + recordFile.string() +
                            ": comes from the world room-1, but " + tables.string() +
                            " was learned in the world room-2 ('room')";
  EXPECT_EQ(messageOf<WorldMismatch>([&] { Localization refused(fromRecord()); }),
            facts + "; learn the tables in the same world, or set anyWorld");
  LocalizationConfig any = fromRecord();
  any.anyWorld = true;
  Localization localization(any);
  EXPECT_EQ(localization.worldMismatch(), facts);
  EXPECT_TRUE(localization.next());
  learn("room-1");
  EXPECT_EQ(Localization(fromRecord()).worldMismatch(), "");
}

TEST_F(Localizing, StartsAtTheFirstTruth) {
  LocalizationConfig config = fromRecord();
  config.start = {LocalizationStart::Kind::kTruth, {}, 0.05, 0.05};
  Localization localization(config);
  EXPECT_FALSE(localization.isStarted());
  const auto estimate = localization.next();
  ASSERT_TRUE(estimate);
  EXPECT_TRUE(localization.isStarted());
  EXPECT_LT(distance(estimate->pose, start), 0.1);

  config.source = "";
  Localization own(config);
  own.container().set(std::span(moments[0]).first(2));
  EXPECT_FALSE(own.update()) << "no truth yet";
  own.container().set(moments[0]);
  EXPECT_TRUE(own.update());
}

// Robots can stand up to 1.8 m and 1.3 m from the middle: this is 1 m more.
TEST_F(Localizing, APoseMayBeSetOffTheMapByThreeSigmaInXAndY) {
  Localization localization(config());
  const auto refusal = [&](const Pose2& pose, double sigmaX, double sigmaY) {
    return messageOf<std::invalid_argument>([&] {
      localization.setPose(pose, {sigmaX * sigmaX, 0, 0, 0, sigmaY * sigmaY, 0, 0, 0, 0.01});
    });
  };
  const Pose2 aside{0.0, 2.3, 0.0}, ahead{2.8, 0.0, 0.0};
  const std::string taken = messageOf<std::invalid_argument>([] {});
  EXPECT_EQ(refusal(aside, 0.01, 0.4), taken);
  EXPECT_EQ(refusal(ahead, 0.4, 0.01), taken);
  EXPECT_EQ(refusal(aside, 0.25, 0.25), taken) << "together";
  EXPECT_NE(refusal(aside, 0.01, 0.2).find("the pose set (0.00, 2.30) m is off the map"),
            std::string::npos);
  EXPECT_NE(refusal(ahead, 0.2, 0.01).find("the pose set (2.80, 0.00) m is off the map"),
            std::string::npos);
}

TEST_F(Localizing, TruthThatNeverComesIsAnErrorAtTheEnd) {
  for (auto& moment : moments) moment.pop_back();
  record("room-1");
  LocalizationConfig config = fromRecord();
  config.start.kind = LocalizationStart::Kind::kTruth;
  Localization localization(config);
  EXPECT_FALSE(localization.next([] { return false; })) << "stopped before the end";
  EXPECT_EQ(messageOf<std::runtime_error>([&] { localization.next(); }),
            "record:" + recordFile.string() +
                ": has no ground truth to start from, expected a feature of type groundTruth");
}

TEST_F(Localizing, StopsWhenItsCallerSaysSo) {
  Localization localization(fromRecord());
  int asked = 0;
  while (localization.next([&] { return ++asked <= 5; })) {
  }
  EXPECT_EQ(localization.feeder().moments(), 5U);
}

TEST_F(Localizing, BeginsAnewWhereItIsTold) {
  Localization localization(fromRecord());
  while (localization.next()) {
  }
  localization.start({LocalizationStart::Kind::kPose, start, 0.01, 0.01});
  EXPECT_TRUE(localization.isStarted());
  EXPECT_NEAR(localization.mcl().samples().x.front(), start.x, 0.05);  // five sigmas
  for (const double wrong : {-1.0, std::nan("")}) {
    EXPECT_THROW(localization.start({LocalizationStart::Kind::kPose, start, wrong, 0.0}),
                 std::invalid_argument);
    EXPECT_THROW(localization.start({LocalizationStart::Kind::kPose, start, 0.0, wrong}),
                 std::invalid_argument);
  }
}

TEST_F(Localizing, AStartOffTheMapIsAnErrorThatNamesTheMap) {
  using Kind = LocalizationStart::Kind;
  LocalizationConfig config = fromRecord();
  config.start = {Kind::kPose, {50, 3, 0}, 0.3, 0.1};
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { Localization refused(config); }),
            "start: (50.00, 3.00) m is off the map, which reaches from (-2.00, -1.50) to "
            "(2.00, 1.50) m");
  // Beside the wall by less than three sigmas: the pose is not known so well.
  config.start.pose = {2.5, 0, 0};
  EXPECT_NO_THROW(Localization fine(config));
  config.start.sigmaPosition = 0.1;
  EXPECT_THROW(Localization refused(config), std::invalid_argument);
  config.start.pose = {1.9, 0, 0};  // in the field, but 0.1 m from the wall with a radius of 0.2 m
  EXPECT_NO_THROW(Localization fine(config));
  config.start.sigmaPosition = 0.0;
  EXPECT_EQ(
      messageOf<std::invalid_argument>([&] { Localization refused(config); }),
      "start: (1.90, 0.00) m is where the robot can't stand, nor within 0.10 m of it (3 sigma)");
  config.start.pose = {std::nan(""), 0, 0};
  EXPECT_THROW(Localization refused(config), std::invalid_argument);
}

TEST_F(Localizing, ATruthOffTheMapIsAnErrorThatNamesTheSource) {
  for (auto& moment : moments) moment.back().words = PoseData::encode({7, 8, 0});
  record("room-1");
  LocalizationConfig config = fromRecord();
  config.start.kind = LocalizationStart::Kind::kTruth;
  Localization localization(config);
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { localization.next(); }),
            "record:" + recordFile.string() +
                ": the first ground truth (7.00, 8.00) m is off the map, which reaches from "
                "(-2.00, -1.50) to (2.00, 1.50) m");
}

TEST_F(Localizing, WithoutOdometryItFollowsByItsScannerAlone) {
  for (auto& moment : moments) moment.erase(moment.begin());
  record("room-1");
  Localization localization(fromRecord());
  while (localization.next()) {
  }
  EXPECT_FALSE(localization.mcl().hasOdometry());
  EXPECT_LT(distance(localization.mcl().estimate().pose, truth), 0.15);
}

TEST_F(Localizing, TellsThePoseAtAnyTime) {
  LocalizationConfig config = fromRecord();
  config.start.kind = LocalizationStart::Kind::kTruth;
  Localization localization(config);
  EXPECT_FALSE(localization.estimate(0)) << "it waits for the truth";
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(localization.advance());
    localization.followOdometry();  // of this moment, before its scan is weighed
    const Timestamp between = localization.feeder().stamp() - 50'000;
    const auto then = localization.estimate(between);
    if (i > 1) {
      ASSERT_TRUE(then);
      EXPECT_EQ(then->stamp, between);
      const Pose2 half = start * inverse(start) * *localization.feeder().truth() *
                         Pose2{-0.9 * 0.0175, 0, -0.0175};
      EXPECT_LT(distance(then->pose, half), 0.15);
    }
    localization.update();
  }
}

// Where a log has no reading for seconds, a robot would have asked for its pose all the while.
TEST_F(Localizing, AGlobalStartSearchesOnBetweenMomentsThatAreFarApart) {
  const std::string robot = readBytes(robotFile);
  moments = {moments[0], moments[40]};
  record("room-1");
  const auto knownSince = [&](double budget) {
    writeBytes(robotFile, robot + "budget_ms = " + std::to_string(budget) + "\n");
    LocalizationConfig config = fromRecord();
    config.start = {LocalizationStart::Kind::kGlobal};
    Localization localization(config);
    EXPECT_TRUE(localization.advance());
    const bool isAtOnce = localization.update().has_value();
    EXPECT_EQ(localization.estimate(0).has_value(), isAtOnce);
    EXPECT_TRUE(localization.advance());
    localization.followOdometry();
    Timestamp since = isAtOnce ? 0 : 4'000'000;
    for (Timestamp now = 3'950'000; now >= 0; now -= 50'000)
      if (localization.estimate(now)) since = now;
    for (Timestamp now = since; now < 4'000'000; now += 50'000)
      EXPECT_TRUE(localization.estimate(now)) << "once known, it stays so";
    EXPECT_TRUE(localization.update());
    EXPECT_EQ(localization.mcl().estimate().stamp, 4'000'000);
    EXPECT_GE(localization.spentMilliseconds(), localization.updateMilliseconds());
    return since;
  };
  EXPECT_EQ(knownSince(1e6), 0);
  const Timestamp since = knownSince(1.0);
  EXPECT_GE(since, 200'000) << "not before it was found";
  EXPECT_LT(since, 4'000'000) << "nor as late as the next reading";
  EXPECT_EQ(since % 100'000, 0);
  EXPECT_LT(knownSince(3.0), since);
}

TEST_F(Localizing, ItIsPublishedThatTheFieldIsSearched) {
  writeBytes(robotFile, readBytes(robotFile) + "budget_ms = 1\n");
  LocalizationConfig config = fromRecord();
  config.start = {LocalizationStart::Kind::kGlobal};
  config.publish = true;
  Localization localization(config);
  const auto status = [&] {
    return localization.container().get<TrackData>({.feature = "status"});
  };
  ASSERT_TRUE(localization.advance());
  EXPECT_FALSE(localization.update());
  ASSERT_TRUE(status());
  EXPECT_EQ(status()->status, TrackStatus::kLost);
  EXPECT_EQ(status()->reason, TrackReason::kSearching);
  ASSERT_TRUE(localization.next());
  EXPECT_NE(status()->reason, TrackReason::kSearching);
  localization.relocalize();
  EXPECT_FALSE(localization.update());
  EXPECT_EQ(status()->reason, TrackReason::kSearching);
  ASSERT_TRUE(localization.next());
  EXPECT_NE(status()->reason, TrackReason::kSearching);
}

TEST_F(Localizing, TakesSettingsInPlaceOfTheRobotFiles) {
  LocalizationConfig config = fromRecord();
  config.particles = 300;
  config.seed = 5;
  config.threads = 2;
  const Localization localization(config);
  EXPECT_EQ(localization.mclConfig().maxSamples, 300U);
  EXPECT_EQ(localization.mclConfig().minSamples, 300U) << "not more than there are at most";
  EXPECT_EQ(localization.mclConfig().seed, 5U);
  EXPECT_EQ(localization.mclConfig().threads, 2U);
  config.particles = 0;
  EXPECT_THROW(Localization refused(config), std::invalid_argument);
  config = fromRecord();
  config.motion = Parameters("mine");
  config.motion->set("turn_per_trun", 0.1);
  EXPECT_THROW(Localization refused(config), ConfigError);
}

TEST_F(Localizing, WithoutASourceThereIsNothingToPull) {
  Localization localization(config());
  EXPECT_THROW(localization.next(), std::logic_error);
  EXPECT_THROW(localization.feeder(), std::logic_error);
  EXPECT_THROW(localization.source(), std::logic_error);
  EXPECT_FALSE(localization.update());
}

}  // namespace
}  // namespace ortung::test
