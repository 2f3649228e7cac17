#include "FakeWorld.hpp"
#include "SensorRig.hpp"
#include "ortung/formats/PoseData.hpp"

namespace ortung {
namespace {

TEST(GroundTruthPlugin, TellsTheTruePose) {
  const FakeWorld room(4.0, 4.0);
  SensorRig rig("ground_truth", "");
  EXPECT_EQ(toText(rig.data.at(0)->id()), "reference/groundTruth/pose");
  Random noise(1);
  rig.sense(room, {1.25, -0.75, -2.0}, &noise);
  const Pose2 pose = rig.get<PoseData>().reading();
  EXPECT_NEAR(pose.x, 1.25, 0.00051);
  EXPECT_NEAR(pose.y, -0.75, 0.00051);
  EXPECT_NEAR(pose.theta, -2.0, 1e-4);
}

TEST(GroundTruthPlugin, RefusesWrongSettingsByName) {
  expectRefusal("ground_truth", "sigma_m = 1", {"test.toml", "sigma_m"});
}

}  // namespace
}  // namespace ortung
