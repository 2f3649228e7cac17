// On which floor a robot is told to be, and what is in whose frame. Floors of ten metres lie at
// x = 0, 30 and 60 in the field; all else is computed by hand.
#include <gtest/gtest.h>

#include <map>

#include "LiveFloors.hpp"

namespace ortung::ros2 {
namespace {

Building house() {
  return {{{"ground", 0.0, -5.0, 20.0}, {"first", 30.0, 20.0, 50.0}, {"attic", 60.0, 50.0, 80.0}},
          {}};
}

PoseEstimate at(const Pose2& pose, TrackStatus status = TrackStatus::kTracking) {
  PoseEstimate estimate;
  estimate.pose = pose;
  estimate.status = status;
  return estimate;
}

std::map<std::string, std::string> described(const LiveFloors& floors) {
  DiagnosticArray::Status status;
  floors.describe(status);
  std::map<std::string, std::string> values = {{"message", status.message}};
  for (const auto& [key, value] : status.values) values[key] = value;
  return values;
}

TEST(LiveFloors, LeaveAllAsItIsWhereThereAreNone) {
  LiveFloors floors;
  floors.enter({});
  floors.follow(at({40.0, 1.0, 0.5}), {});
  EXPECT_EQ(floors.name(), "");
  EXPECT_FALSE(floors.frame());
  EXPECT_TRUE(floors.isHere({40.0, 1.0, 0.5}));
  EXPECT_EQ(floors.toField({40.1, 1.0, 0.5}).x, 40.1);
  EXPECT_EQ(floors.fromField({40.1, 1.0, 0.5}).x, 40.1);
  EXPECT_EQ(floors.carried({40.1, 1.0, 0.5}, {})->x, 40.1);
  EXPECT_FALSE(floors.goTo("ground"));
  EXPECT_EQ(described(floors), (std::map<std::string, std::string>{{"message", ""}}));
}

TEST(LiveFloors, StayUntilNearlyAllOfTheBeliefIsElsewhere) {
  LiveFloors floors;
  floors.enter(house());
  // Before any floor is known, poses of others are on the first one, and none is the robot's.
  EXPECT_EQ(floors.toField({2.0, 3.0, 0.0}).x, 2.0);
  EXPECT_FALSE(floors.isHere({2.0, 3.0, 0.0}));
  floors.follow(at({35.0, 1.0, 0.0}, TrackStatus::kLost), {0.03, 0.97, 0.0});
  EXPECT_EQ(floors.name(), "") << "a lost robot is on no floor";
  floors.follow(at({35.0, 1.0, 0.0}, TrackStatus::kUncertain), {0.03, 0.97, 0.0});
  EXPECT_EQ(floors.name(), "first");
  EXPECT_TRUE(floors.isHere({35.0, 1.0, 0.0}));
  EXPECT_FALSE(floors.isHere({5.0, 1.0, 0.0}));
  EXPECT_DOUBLE_EQ(floors.fromField({35.0, 1.0, 0.25}).x, 5.0);
  EXPECT_DOUBLE_EQ(floors.toField({5.0, 1.0, 0.25}).x, 35.0);
  EXPECT_EQ(floors.frame()->name, "first");

  floors.follow(at({65.0, 1.0, 0.0}), {0.0, 0.4, 0.6});
  EXPECT_EQ(floors.name(), "first") << "of the belief, 60 % are elsewhere";
  EXPECT_FALSE(floors.isHere({65.0, 1.0, 0.0})) << "so its pose is of no map that others have";
  EXPECT_EQ(described(floors).at("floors"), "first 0.40, attic 0.60");
  EXPECT_NE(described(floors).at("message").find("open: first 0.40, attic 0.60"),
            std::string::npos);
  floors.follow(at({65.0, 1.0, 0.0}), {1.0});
  EXPECT_EQ(floors.name(), "first") << "shares of another building say nothing";
  floors.follow(at({65.0, 1.0, 0.0}), {0.0, 0.0, 1.0});
  EXPECT_EQ(floors.name(), "attic");
  EXPECT_EQ(described(floors),
            (std::map<std::string, std::string>{{"message", ""}, {"floor", "attic"}}));
}

TEST(LiveFloors, AreTakenFromWhoKnowsThem) {
  LiveFloors floors;
  floors.enter(house());
  EXPECT_FALSE(floors.goTo("cellar"));
  EXPECT_EQ(floors.name(), "");
  EXPECT_TRUE(floors.goTo("attic"));
  EXPECT_EQ(floors.name(), "attic");
  EXPECT_DOUBLE_EQ(floors.toField({1.0, 2.0, 0.0}).x, 61.0);
}

TEST(LiveFloors, KeepTheirPlaceInAnotherBuilding) {
  LiveFloors floors;
  floors.enter(house());
  floors.goTo("first");
  const Pose2 here{34.0, 2.0, 0.5};  // 4 m on the first floor
  // As another building has them, the first floor's map is at x = 100.
  const Building other{{{"cellar", 0.0, -5.0, 50.0}, {"first", 100.0, 50.0, 150.0}}, {}};
  EXPECT_DOUBLE_EQ(floors.carried(here, other)->x, 104.0);
  EXPECT_DOUBLE_EQ(floors.carried(here, other, "cellar")->x, 4.0);
  EXPECT_DOUBLE_EQ(floors.carried(here, house(), "attic")->x, 64.0);
  EXPECT_DOUBLE_EQ(floors.carried(here, {})->x, 4.0) << "a map alone has its own frame";
  EXPECT_FALSE(floors.carried({62.0, 2.0, 0.0}, other)) << "it has no attic";
  floors.enter(other);
  EXPECT_EQ(floors.name(), "first");
  floors.enter({{{"cellar", 0.0, -5.0, 50.0}}, {}});
  EXPECT_EQ(floors.name(), "") << "a building without that floor";
  floors.enter(house(), "attic");
  EXPECT_EQ(floors.name(), "attic");
}

}  // namespace
}  // namespace ortung::ros2
