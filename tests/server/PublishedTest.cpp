// A robot that localizes itself and serves its container: clients subscribe to where it is.
#include <atomic>

#include "../run/RoomRun.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/server/ServedContainer.hpp"

namespace ortung::test {
namespace {

using PublishedEstimate = RoomRun;

TEST_F(PublishedEstimate, ReachesClientsThatSubscribeToIt) {
  LocalizationConfig own = config();
  own.publish = true;
  Localization localization(own);
  std::atomic<Timestamp> clock{0};
  ServedContainer::Config served;
  served.period = 0.002;
  ServedContainer world(localization.container(), [&] { return clock.load(); }, served);
  const RunningBoard board(world, {});
  TestClient client(board.port());
  client.ask("HELLO ortung/1 role=viewer");
  client.ask("SUBSCRIBE mcl/LOCALIZATION/pose robot=1");
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

}  // namespace
}  // namespace ortung::test
