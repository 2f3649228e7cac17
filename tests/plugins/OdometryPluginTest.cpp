#include "FakeWorld.hpp"
#include "SensorRig.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/Words.hpp"

namespace ortung {
namespace {

TEST(OdometryPlugin, TellsWhatTheDriveMeasured) {
  const FakeWorld room(4.0, 4.0);
  SensorRig rig("odometry", "period_s = 0.02");
  EXPECT_EQ(toText(rig.data.at(0)->id()), "odometry/odometry/pose");
  EXPECT_EQ(rig.sensor->period(), 0.02);
  RobotState state;
  state.pose = {9.0, 9.0, 3.0};
  state.odometry = {1.234, -0.5, 1.0};
  state.translationalVelocity = 0.75;
  state.rotationalVelocity = -0.5;
  state.lateralVelocity = 0.25;
  rig.sensor->generateData(room, state, nullptr, 17, rig.data);
  const OdometryData::Reading& reading = rig.get<OdometryData>().reading();
  EXPECT_EQ(rig.data[0]->stamp(), 17);
  EXPECT_NEAR(reading.pose.x, 1.234, 0.00051);
  EXPECT_NEAR(reading.pose.y, -0.5, 0.00051);
  EXPECT_NEAR(reading.pose.theta, 1.0, 1e-4);
  EXPECT_NEAR(reading.translationalVelocity, 0.75, 0.00051);
  EXPECT_NEAR(reading.rotationalVelocity, -0.5, 1e-4);
  EXPECT_NEAR(reading.lateralVelocity, 0.25, 0.00051);
}

TEST(OdometryPlugin, PassesOnTheDrivesMotionData) {
  const FakeWorld room(4.0, 4.0);
  SensorRig rig("odometry", "");
  const std::vector<std::uint32_t> inner = {words::fromSignedMetres(0.5), 0, 4294967295u};
  RobotState state;
  state.motionData = inner;
  rig.sensor->generateData(room, state, nullptr, 1, rig.data);
  EXPECT_EQ(rig.get<OdometryData>().reading().motionData, inner);
  EXPECT_EQ(rig.data[0]->getData().size(), 5 + inner.size());
}

TEST(OdometryPlugin, RefusesWrongSettingsByName) {
  expectRefusal("odometry", "period_s = -1", {"test.toml", "period_s", "-1"});
  expectRefusal("odometry", "noise = 1", {"noise"});
}

}  // namespace
}  // namespace ortung
