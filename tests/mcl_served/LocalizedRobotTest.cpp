// A robot that localizes itself, and what clients of its board tell it.
#include "../run/RoomRun.hpp"
#include "FakeRobots.hpp"
#include "ortung/formats/SamplesData.hpp"
#include "ortung/mcl_served/LocalizedRobot.hpp"

namespace ortung::test {
namespace {

class LocalizedRobotRun : public RoomRun {
 protected:
  std::shared_ptr<Localization> open() {
    LocalizationConfig config = this->config();
    config.publish = true;
    return std::make_shared<Localization>(config);
  }
  void go(Localization& localization, LocalizedRobot& robot, std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      robot.obey();
      localization.container().set(moments[i]);
      localization.update();
    }
  }
};

TEST_F(LocalizedRobotRun, GoesWhereItIsToldToBe) {
  const auto localization = open();
  LocalizedRobot robot(localization);
  const Asking client(robot);
  EXPECT_EQ(client.words("LOCALIZE"), "robot=1 state=searching progress=1") << "no reading yet";
  go(*localization, robot, 0, 20);
  EXPECT_TRUE(client.words("LOCALIZE").starts_with("robot=1 state=running progress=1 "));
  const Pose2 told{-1.0, 0.5, 0.0};
  ASSERT_GT(distance(localization->mcl().estimate().pose, told), 1.0);
  EXPECT_TRUE(
      client.words("LOCALIZE x_m=-1 y_m=0.5 sigma_m=0.05 sigma_deg=1").starts_with("robot=1"));
  robot.obey();
  const auto now = localization->estimate(moments[19].front().stamp);
  ASSERT_TRUE(now);
  EXPECT_LT(distance(now->pose, told), 0.1) << "and no reading has spoken against it yet";
  client.words("LOCALIZE anywhere");
  go(*localization, robot, 20, 40);
  EXPECT_EQ(client.words("LOCALIZE on").substr(0, 14), "robot=1 state=");
  EXPECT_TRUE(client.words("LOCALIZE off").starts_with("ERR live"));
  EXPECT_TRUE(client.words("LOCALIZE x_m=50 y_m=0").starts_with("ERR argument the pose (50.00"));
  EXPECT_TRUE(client.words("LOCALIZE robot=2").starts_with("ERR no-robot"));
}

TEST_F(LocalizedRobotRun, ShowsItsMapsToPlayersTooAndSamplesToWhoWantsThem) {
  const auto localization = open();
  LocalizedRobot robot(localization);
  go(*localization, robot, 0, 10);
  const Asking client(robot);
  const auto reply = client.ask("HEATMAP */LRF/*", BoardCommand::Role::kPlayer);
  EXPECT_EQ(reply.bytes.size(), localization->robot().tables.region.grid.size());
  const auto* samples = dynamic_cast<const SamplesData*>(
      localization->container().findExactly({"mcl", "LOCALIZATION", "samples"}));
  EXPECT_EQ(samples->sequence(), 0U);
  robot.want(std::vector{samples->id()});
  go(*localization, robot, 10, 15);
  EXPECT_GT(samples->sequence(), 0U);
}

}  // namespace
}  // namespace ortung::test
