// Buildings: a floor is to its robots what it is as a world of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "WorldFiles.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/sim/Learner.hpp"

namespace ortung::test {
namespace {

/// What stands on a floor, with a line for each table.
std::string thingsOf(int number, const std::string& floor) {
  const std::string x = std::to_string(number);
  std::string text = "[[rectangle]]\ncenter_m = [0, -3]\nsize_m = [8, 0.2]\n" + floor;
  text += "[[rectangle]]\ncenter_m = [0, 3]\nsize_m = [8, 0.2]\n" + floor;
  text += "[[ellipse]]\ncenter_m = [" + x + ", 1]\nsize_m = [0.5, 0.8]\n" + floor;
  text += "[[triangle]]\ncorners_m = [-3, 0, -2, 0, -2.5, " + x + ".5]\n" + floor;
  text += "[[landmark]]\nkind = \"lamp\"\nidentity = " + x + "\nposition_m = [1, 2]\n" + floor;
  return text;
}

/// Floors whose ends along x are open, so that rays leave them.
std::string threeFloors() {
  std::string text;
  for (int i = 0; i < 3; ++i) text += "[[floor]]\nname = \"f" + std::to_string(i) + "\"\n";
  for (int i = 0; i < 3; ++i) text += thingsOf(i, "floor = \"f" + std::to_string(i) + "\"\n");
  return text + "[[lift]]\nname = \"A\"\nposition_m = [1, -1]\nheading_deg = 90\n";
}

class BuildingWorld : public ::testing::Test {
 protected:
  const std::unique_ptr<SimWorld> world_ = worldOf(threeFloors());
  const FieldRegion region_ = world_->region(0.1, {0.2});
  const Building& building_ = region_.building;
};

TEST_F(BuildingWorld, HasFloorsApartAndLiftsOnThem) {
  ASSERT_EQ(building_.floors.size(), 3u);
  EXPECT_NO_THROW(building_.check());
  EXPECT_EQ(building_.floors[0].shift, 0.0);
  for (const Floor& floor : building_.floors)
    EXPECT_EQ(floor.shift, std::round(floor.shift)) << "cells lie alike";
  ASSERT_EQ(building_.lifts.size(), 1u);
  ASSERT_EQ(building_.lifts[0].stops.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const LiftStop& stop = building_.lifts[0].stops[i];
    EXPECT_EQ(stop.floor, i);
    EXPECT_EQ(stop.pose.x, building_.floors[i].shift + 1.0);
    EXPECT_EQ(stop.pose.y, -1.0);
    EXPECT_NEAR(stop.pose.theta, std::numbers::pi / 2.0, 1e-12);
  }
}

/// Rays, cones and sights of all floors, against worlds that consist of one.
TEST_F(BuildingWorld, AFloorIsSeenAsAWorldOfItsOwn) {
  Random random(3, 0);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto alone = worldOf(thingsOf(static_cast<int>(i), ""));
    const Floor& floor = building_.floors[i];
    for (int k = 0; k < 200; ++k) {
      const double x = random.uniform(-3.9, 3.9);
      const double y = random.uniform(-2.8, 2.8);
      std::vector<float> here(90);
      std::vector<float> there(90);
      RayFan fan{x, y, 0.3, random.uniform(0, 6), 0.07, random.uniform(-0.01, 0.01), 60.0};
      alone->castFan(fan, 0, there);
      fan.x += floor.shift;
      world_->castFan(fan, 0, here);
      for (std::size_t beam = 0; beam < here.size(); ++beam)
        ASSERT_NEAR(here[beam], there[beam], 2e-4F) << "floor " << i << ", beam " << beam;
      const double x1 = random.uniform(-3.9, 3.9);
      const double y1 = random.uniform(-2.8, 2.8);
      EXPECT_EQ(world_->isVisible(x + floor.shift, y, 0.3, x1 + floor.shift, y1, 0.3, 0, 0.0),
                alone->isVisible(x, y, 0.3, x1, y1, 0.3, 0, 0.0));
      EXPECT_EQ(world_->isFree(x + floor.shift, y, {0.2}), alone->isFree(x, y, {0.2}));
    }
  }
}

/// With a reach beyond the next floor cones are made of rays, which differ by a few centimetres.
TEST_F(BuildingWorld, ConesMeetTheirOwnFloorAlone) {
  const auto alone = worldOf(thingsOf(1, ""));
  const Floor& floor = building_.floors[1];
  Random random(4, 0);
  for (int k = 0; k < 100; ++k) {
    ConeFan fan{random.uniform(-3, 3), random.uniform(-2.5, 2.5), 0.3, random.uniform(0, 6), 0.5};
    fan.maxRange = k % 2 == 0 ? 4.0 : 40.0;
    std::vector<float> here(12);
    std::vector<float> there(12);
    alone->castCones(fan, 0, there);
    fan.x += floor.shift;
    world_->castCones(fan, 0, here);
    for (std::size_t i = 0; i < here.size(); ++i)
      EXPECT_NEAR(here[i], there[i], k % 2 == 0 ? 2e-4F : 0.1F) << k << ", cone " << i;
  }
}

TEST_F(BuildingWorld, NobodySeesAnotherFloor) {
  const Floor& first = building_.floors[0];
  const Floor& second = building_.floors[1];
  EXPECT_FALSE(world_->isVisible(first.shift + 3.5, -1, 0.3, second.shift - 3.5, -1, 0.3, 0, 0.0));
  float range = 0.0F;
  world_->castFan({first.shift + 3.5, -1, 0.3, 0.0, 0.1, 0.0, 100.0}, 0, {&range, 1});
  EXPECT_EQ(range, 100.0F);
}

/// Robots of one floor see each other, and not those of the next.
TEST_F(BuildingWorld, WhatMovesIsOnOneFloor) {
  Primitive round;
  round.shape = Primitive::Shape::kEllipse;
  round.halfX = round.halfY = 0.25;
  MovingBody body;
  body.pieces = {round};
  const auto world = world_->another();
  const RobotNumber number = world->addBody(body, building_.floors[1].toField({3, -1, 0}));
  const auto rangeOn = [&](std::size_t floor) {
    float range = 0.0F;
    const Pose2 from = building_.floors[floor].toField({0, -1, 0});
    world->castFan({from.x, from.y, 0.3, 0.0, 0.1, 0.0, 100.0}, 0, {&range, 1});
    return range;
  };
  EXPECT_NEAR(rangeOn(1), 2.75F, 0.01F);
  EXPECT_EQ(rangeOn(0), 100.0F);
  world->moveBody(number, building_.floors[0].toField({2, -1, 0}));
  EXPECT_NEAR(rangeOn(0), 1.75F, 0.01F);
  EXPECT_EQ(rangeOn(1), 100.0F);
}

TEST_F(BuildingWorld, RobotsStandOnEachFloorAndNowhereBetween) {
  std::vector<int> cells(3);
  for (std::size_t i = 0; i < region_.standable.size(); ++i) {
    if (region_.standable[i] == 0) continue;
    const double x = region_.grid.centreX(i);
    const std::size_t floor = building_.floorAt(x);
    EXPECT_LE(std::abs(x - building_.floors[floor].shift), 4.0);
    ++cells[floor];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const FieldRegion alone = worldOf(thingsOf(static_cast<int>(i), ""))->region(0.1, {0.2});
    EXPECT_EQ(cells[i], std::accumulate(alone.standable.begin(), alone.standable.end(), 0));
  }
}

TEST_F(BuildingWorld, LandmarksAreWhereTheirFloorIs) {
  ASSERT_EQ(world_->landmarks().size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(world_->landmarks()[i].x, building_.floors[i].shift + 1.0);
}

/// A closed room on each floor is left out, as in a world of one.
TEST(BuildingArea, EachFloorHasItsMainPart) {
  std::string text;
  for (const char* name : {"a", "b"}) {
    const std::string floor = std::string("floor = \"") + name + "\"\n";
    text += std::string("[[floor]]\nname = \"") + name + "\"\n";
    for (const char* box :
         {"center_m = [0, -3]\nsize_m = [12, 0.2]\n", "center_m = [0, 3]\nsize_m = [12, 0.2]\n",
          "center_m = [-6, 0]\nsize_m = [0.2, 6.2]\n", "center_m = [6, 0]\nsize_m = [0.2, 6.2]\n",
          "center_m = [4, 0]\nsize_m = [0.2, 6.2]\n"})
      text += std::string("[[rectangle]]\n") + box + floor;
  }
  const auto world = worldOf(text);
  const LearnArea area = learnArea(*world, 0.1, {0.2});
  const Building& building = area.region.building;
  std::vector<int> cells(2);
  for (std::size_t i = 0; i < area.region.standable.size(); ++i) {
    if (area.region.standable[i] == 0) continue;
    const double x = area.region.grid.centreX(i);
    const std::size_t floor = building.floorAt(x);
    EXPECT_LT(x - building.floors[floor].shift, 4.0) << "the closed room";
    ++cells[floor];
  }
  EXPECT_GT(cells[0], 4000);
  EXPECT_EQ(cells[0], cells[1]);
  EXPECT_NEAR(area.leftOut, 2 * 1.4 * 5.4, 1.0);
  // A part that is asked for is the only one.
  const double shift = building.floors[1].shift;
  const LearnArea one = learnArea(*world, 0.1, {0.2}, std::array{shift, 0.0});
  for (std::size_t i = 0; i < one.region.standable.size(); ++i)
    if (one.region.standable[i] != 0) EXPECT_EQ(building.floorAt(one.region.grid.centreX(i)), 1u);
}

TEST(BuildingFiles, WhatIsWrongIsSaidByName) {
  const std::string floors =
      "[[floor]]\nname = \"g\"\n[[floor]]\nname = \"one\"\n"
      "[[rectangle]]\nfloor = \"g\"\ncenter_m = [0, 0]\nsize_m = [1, 1]\n";
  const std::string both =
      floors + "[[rectangle]]\nfloor = \"one\"\ncenter_m = [0, 0]\nsize_m = [1, 1]\n";
  const std::string lift = "[[lift]]\nname = \"A\"\nposition_m = [0, 0]\n";
  EXPECT_EQ(refusalOf(both + lift), "");
  const auto refused = [](const std::string& text, const std::string& says) {
    const std::string why = refusalOf(text);
    EXPECT_NE(why.find(says), std::string::npos) << why;
  };
  refused(floors, "nothing else is on this floor");
  refused(both + "[[rectangle]]\ncenter_m = [0, 0]\nsize_m = [1, 1]\n", "floor");
  refused(both + "[[landmark]]\nfloor = \"two\"\nkind = \"a\"\nidentity = 1\nposition_m = [0, 0]\n",
          "expected one of g, one");
  refused(both + "[[floor]]\nname = \"g\"\n", "as another floor's is");
  refused(both + "[[floor]]\nname = \"a b\"\n", "name");
  refused(both + "[world]\nx_m = [0, 1]\n", "does not fit a building");
  refused(both + lift + "floor = \"g\"\n", "stops at 1 floors");
  refused(both + lift + lift, "stops twice on floor 'g'");
  refused(both + lift + "floor = \"g\"\n" + lift + "floor = \"one\"\nradius_m = 2\n", "radius_m");
  refused(both + "[[lift]]\nname = \"A\"\nposition_m = [500, 0]\n",
          "lift 'A' is at (500.00, 0.00) m of floor 'g'");
  refused(both + "[[lift]]\nname = \"A\"\nposition_m = [0, 1.5]\n", "of floor 'g'");
  refused(both + "[[lift]]\nname = \"A\"\nposition_m = [0, 0]\nspeed = 1\n", "speed");
  const std::string one = "[[rectangle]]\ncenter_m = [0, 0]\nsize_m = [1, 1]\n";
  refused(one + lift, "lift");
  refused(one + "floor = \"g\"\n", "floor");
}

TEST(BuildingFiles, StopsMayBeElsewhereOnEachFloor) {
  const auto world = worldOf(
      "[[floor]]\nname = \"g\"\n[[floor]]\nname = \"one\"\n"
      "[[rectangle]]\nfloor = \"g\"\ncenter_m = [0, 0]\nsize_m = [9, 9]\n"
      "[[rectangle]]\nfloor = \"one\"\ncenter_m = [0, 0]\nsize_m = [9, 9]\n"
      "[[lift]]\nname = \"A\"\nfloor = \"one\"\nposition_m = [2, 3]\nheading_deg = 180\n"
      "[[lift]]\nname = \"A\"\nfloor = \"g\"\nposition_m = [-1, 0]\n");
  const Building building = world->region(0.5, {0.1}).building;
  ASSERT_EQ(building.lifts.size(), 1u);
  EXPECT_EQ(building.lifts[0].stops[0].floor, 1u);
  EXPECT_EQ(building.lifts[0].stops[0].pose.x, building.floors[1].shift + 2.0);
  EXPECT_EQ(building.lifts[0].stops[1].pose.x, -1.0);
}

TEST(BuildingFiles, TheFingerprintKnowsFloors) {
  const std::string things =
      "[[rectangle]]\nfloor = \"g\"\ncenter_m = [0, 0]\nsize_m = [1, 1]\n"
      "[[rectangle]]\nfloor = \"one\"\ncenter_m = [0, 0]\nsize_m = [1, 1]\n";
  const std::string floors = "[[floor]]\nname = \"g\"\n[[floor]]\nname = \"one\"\n";
  const std::string lift = "[[lift]]\nname = \"A\"\nposition_m = [0, 0]\n";
  EXPECT_NE(worldOf(floors + things)->fingerprint(),
            worldOf("[[rectangle]]\ncenter_m = [0, 0]\nsize_m = [1, 1]\n"
                    "[[rectangle]]\ncenter_m = [11, 0]\nsize_m = [1, 1]\n")
                ->fingerprint());
  // Tables hold names and lifts, so those of another lift are not of this world.
  const auto base = worldOf(floors + things + lift)->fingerprint();
  EXPECT_NE(worldOf(floors + things)->fingerprint(), base);
  EXPECT_NE(worldOf(floors + things + lift + "radius_m = 2\n")->fingerprint(), base);
  EXPECT_NE(worldOf(floors + things + lift + "heading_deg = 2\n")->fingerprint(), base);
}

}  // namespace
}  // namespace ortung::test
