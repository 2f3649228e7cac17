// A robot that localizes itself and serves its container: clients subscribe to where it is.
#include <atomic>
#include <cmath>

#include "../run/RoomRun.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/core/ReadingLine.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/formats/ProtectionData.hpp"
#include "ortung/formats/TrackData.hpp"
#include "ortung/server/ServedContainer.hpp"

namespace ortung::test {
namespace {

using PublishedEstimate = RoomRun;

/// A robot that publishes, served, and a client that subscribes to one of its features.
struct Listening {
  Listening(LocalizationConfig config, const std::string& feature)
      : localization((config.publish = true, config)) {
    client.ask("HELLO ortung/1 role=viewer");
    client.ask("SUBSCRIBE " + feature + " robot=1");
  }
  static ServedContainer::Config served() {
    ServedContainer::Config config;
    config.period = 0.002;
    return config;
  }

  Localization localization;
  std::atomic<Timestamp> clock{0};
  ServedContainer world{localization.container(), [this] { return clock.load(); }, served()};
  RunningBoard board{world, {}};
  TestClient client{board.port()};
};

TEST_F(PublishedEstimate, ReachesClientsThatSubscribeToIt) {
  Listening listening(config(), "mcl/LOCALIZATION/pose");
  auto& [localization, clock, world, board, client] = listening;
  PoseFixData heard({"mcl", "LOCALIZATION", "pose"}, {});
  std::size_t estimates = 0;
  for (const auto& moment : moments) {
    clock = moment[0].stamp;
    localization.container().set(moment);
    const auto estimate = localization.update();
    if (!estimate) continue;
    // A look at the robot between its readings and the estimate has told others, or nothing new.
    const auto reading = parseLine(client.lineWith("mcl/LOCALIZATION/pose"));
    ASSERT_TRUE(reading);
    EXPECT_EQ(reading->stamp, estimate->stamp);
    heard.setData(reading->stamp, reading->words);
    ASSERT_EQ(heard.reading().size(), 1U);
    EXPECT_LT(distance(heard.reading()[0].pose, estimate->pose), 0.001);
    EXPECT_NEAR(heard.reading()[0].covariance[0], estimate->covariance[0],
                1e-3 * estimate->covariance[0]);
    ++estimates;
  }
  EXPECT_GT(estimates, 10U);
}

// What clients are told of the status is what the program itself gets, with the same stamp.
TEST_F(PublishedEstimate, TellsHowFarItCanBeReliedOn) {
  Listening listening(config(), "mcl/LOCALIZATION/status");
  auto& [localization, clock, world, board, client] = listening;
  TrackData heard;
  std::size_t tracking = 0;
  const auto hear = [&] {
    const auto reading = parseLine(client.lineWith("mcl/LOCALIZATION/status"));
    if (reading) heard.setData(reading->stamp, reading->words);
    return reading.has_value();
  };
  for (const auto& moment : moments) {
    clock = moment[0].stamp;
    localization.container().set(moment);
    const auto estimate = localization.update();
    if (!estimate) continue;
    ASSERT_TRUE(hear());
    EXPECT_EQ(heard.stamp(), estimate->stamp);
    EXPECT_EQ(heard.reading().status, estimate->status);
    EXPECT_EQ(heard.reading().reason, estimate->reason);
    EXPECT_NEAR(heard.reading().quality, estimate->quality, 1e-4);
    EXPECT_NEAR(heard.reading().share, estimate->share, 1e-4);
    const auto bound = localization.container().get<ProtectionData>({.feature = "protection"});
    ASSERT_TRUE(bound);
    if (estimate->status == TrackStatus::kTracking) {
      EXPECT_NEAR(bound->metres, estimate->protection.metres, 2e-6);
      EXPECT_NEAR(bound->radians, estimate->protection.radians, 2e-6);
    }
    EXPECT_EQ(std::isinf(bound->metres), std::isinf(estimate->protection.metres));
    if (estimate->status == TrackStatus::kTracking) ++tracking;
  }
  EXPECT_GT(tracking, 10U);
  // The scanner is unplugged, odometry goes on: told once, though there is no new estimate.
  Message odometry = moments.back()[0];
  std::size_t silent = 0;
  while (silent < 100 && heard.reading().reason != TrackReason::kNoReading) {
    odometry.stamp += 100'000;
    clock = odometry.stamp;
    localization.container().set(odometry);
    ASSERT_FALSE(localization.update());
    ++silent;
    const auto now = localization.container().get<TrackData>({"mcl", "LOCALIZATION", "status"});
    ASSERT_TRUE(now);
    if (now->reason == TrackReason::kNoReading) {
      ASSERT_TRUE(hear());
    }
  }
  EXPECT_EQ(heard.stamp(), odometry.stamp);
  const SensorData* bound =
      localization.container().findExactly({"mcl", "LOCALIZATION", "protection"});
  ASSERT_NE(bound, nullptr);
  EXPECT_EQ(bound->stamp(), odometry.stamp) << "it is told together with the status";
  EXPECT_NE(heard.reading().status, TrackStatus::kTracking);
  EXPECT_LE(silent, 20U) << "within 2 s";
}

}  // namespace
}  // namespace ortung::test
