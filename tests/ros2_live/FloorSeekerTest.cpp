// A belief in a building whose floors differ, and a floor that somebody names while the robot is
// searched for.
#include <gtest/gtest.h>

#include <cmath>

#include "Files.hpp"
#include "FloorSeeker.hpp"
#include "LiftRide.hpp"
#include "Program.hpp"
#include "ortung/run/Localization.hpp"

namespace ortung::ros2 {
namespace {

using testing::DrawnBuilding;
using testing::LiftRide;

class FloorSeekers : public ::testing::Test {
 protected:
  static constexpr std::size_t kFloor = 2;  ///< where the robot is
  static constexpr const char* kOther = "f4";

  void SetUp() override {
    test::writeBytes(folder_ / "building.toml", DrawnBuilding(3).toml());
    test::writeBytes(folder_ / "robot.toml", testing::kRoundRobot);
    const test::Outcome learned =
        test::ortung({"learn", "--world", folder_ / "building.toml", "--robot",
                      folder_ / "robot.toml", "--out", folder_ / "t.ortung"});
    ASSERT_EQ(learned.exitCode, 0) << learned.err;
    world_ = readWorld(folder_ / "building.toml");
    localization_.emplace(
        LocalizationConfig{.robot = folder_ / "robot.toml", .tables = folder_ / "t.ortung"});
    robot_.emplace(*world_, 1);
    robot_->standAt(kFloor, {8.0, DrawnBuilding::kCorridor, 0.0});
    floors_.enter(building());
  }

  const Building& building() const { return localization_->robot().tables.region.building; }

  /// Lets the robot turn.
  void turn(double angle) {
    const auto take = [this](const std::vector<Message>& moment) {
      localization_->take(moment);
      if (localization_->update()) stamp_ = moment.front().stamp;
    };
    robot_->turn(angle, take);
  }

  double shareOf(const std::string& floor) const {
    return localization_->mcl().floorShares()[*building().find(floor)];
  }

  test::TemporaryFolder folder_;
  std::unique_ptr<SimWorld> world_;
  std::optional<Localization> localization_;
  std::optional<LiftRide> robot_;
  LiveFloors floors_;
  Timestamp stamp_ = 0;
};

TEST_F(FloorSeekers, TakeTheSamePlaceOfAFloorOnWhichTheSearchFoundNone) {
  localization_->start({LocalizationStart::Kind::kPose, robot_->truth(), 0.2, 0.1});
  turn(3.0);
  ASSERT_EQ(shareOf(DrawnBuilding::kFloors[kFloor]), 1.0);
  const Pose2 own = building().floors[kFloor].fromField(localization_->mcl().estimate().pose);
  FloorSeeker seeker(floors_);
  seeker.seek(kOther);
  seeker.onEstimate(*localization_);
  EXPECT_EQ(shareOf(kOther), 1.0);
  const auto there = localization_->estimate(stamp_);
  ASSERT_TRUE(there.has_value());
  const Pose2 its = building().floorOf(there->pose.x).fromField(there->pose);
  EXPECT_NEAR(std::hypot(its.x - own.x, its.y - own.y), 0.0, 0.05);
  EXPECT_NEAR(wrapAngle(its.theta - own.theta), 0.0, 0.05);
}

TEST_F(FloorSeekers, LeaveABeliefThatIsOnTheFloorAlready) {
  localization_->start({LocalizationStart::Kind::kPose, robot_->truth(), 0.2, 0.1});
  turn(3.0);
  const Pose2 before = localization_->estimate(stamp_)->pose;
  FloorSeeker seeker(floors_);
  seeker.seek(DrawnBuilding::kFloors[kFloor]);
  seeker.onEstimate(*localization_);
  const Pose2 after = localization_->estimate(stamp_)->pose;
  EXPECT_EQ(after.x, before.x);
  EXPECT_EQ(after.theta, before.theta);
}

TEST_F(FloorSeekers, LeaveABeliefInABuildingWithoutSuchAFloor) {
  localization_->start({LocalizationStart::Kind::kPose, robot_->truth(), 0.2, 0.1});
  turn(3.0);
  FloorSeeker seeker(floors_);
  seeker.seek("attic");
  seeker.onEstimate(*localization_);
  EXPECT_EQ(shareOf(DrawnBuilding::kFloors[kFloor]), 1.0);
}

}  // namespace
}  // namespace ortung::ros2
