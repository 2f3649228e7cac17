#include <cmath>
#include <numbers>

#include "FakeWorld.hpp"
#include "SensorRig.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/ObjectsData.hpp"
#include "ortung/formats/PointsData.hpp"
#include "ortung/formats/PoseFixData.hpp"

/// What cameras do not see: settings of the iconic camera and the laser that says what it sees.
namespace ortung {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;  // [rad]

WorldObject round(const char* kind, double x, double y, double radius) {
  WorldObject object;
  object.kind = kind;
  object.pose = {x, y, 0};
  object.radius = object.halfX = object.halfY = radius;
  object.zHigh = 0.3;
  object.isRound = true;
  return object;
}

/// A post hides the ball behind it from the left edge up to its middle.
TEST(IconicSettings, WhatIsHiddenByMoreThanItsShareIsNotSeen) {
  FakeWorld world(12.0, 8.0);
  world.addObject(round("ball", 4.0, 0.0, 0.2));
  world.addPost({2.0, 0.5, 0.5});  // its edge lies on the line to the ball's middle
  for (const auto& [share, isSeen] :
       {std::pair{0.1, true}, {0.4, true}, {0.6, false}, {0.9, false}}) {
    SensorRig rig("iconic_omnivision", "see = ['ball']\nvisible_share = " + std::to_string(share));
    rig.sense(world, {});
    EXPECT_EQ(rig.get<ObjectsData>().reading().size(), isSeen ? 1u : 0u) << share;
  }
}

TEST(IconicSettings, LinesNearerThanTheSmallestRangeAreNotSeen) {
  FakeWorld world(12.0, 8.0);
  FieldLine line;
  line.x0 = line.x1 = 1.0;
  line.y0 = -4.0;
  line.y1 = 4.0;
  line.width = 0.1;
  world.addLine(line);
  for (const double least : {0.0, 1.5, 2.5}) {
    SensorRig rig("iconic_omnivision",
                  "see = ['lines']\nlines = { rays = 360, max_range_m = 3 }\n"
                  "min_range_m = " +
                      std::to_string(least));
    rig.sense(world, {});
    const PointsData::Reading& points = rig.get<PointsData>().reading();
    // Scan lines a degree apart meet x = 1 at 1 / cos: from the smallest to the greatest range.
    int expected = 0;
    for (int i = -89; i <= 89; ++i) {
      const double range = 1.0 / std::cos(i * kDegree);
      expected += range >= least && range <= 3.0 ? 1 : 0;
    }
    EXPECT_EQ(points.size(), static_cast<std::size_t>(expected)) << least;
    for (const PointsData::Point& point : points) EXPECT_GE(point.range, least - 0.001);
  }
}

TEST(IconicSettings, LinesAreImaginedAsOftenAsTheirShareSays) {
  const FakeWorld world(12.0, 8.0);  // no lines
  for (const double share : {0.0, 0.2}) {
    SensorRig rig("iconic_omnivision",
                  "see = ['lines']\nlines = { rays = 100, max_range_m = 3 }\nfalse_share = " +
                      std::to_string(share));
    Random noise(4);
    Statistics ranges;
    for (int i = 0; i < 100; ++i) {
      rig.sense(world, {}, &noise);
      for (const PointsData::Point& point : rig.get<PointsData>().reading())
        ranges.add(point.range);
    }
    // One chance a scan line, of 10,000: 4 sigma are 0.016; anywhere up to 3 m.
    EXPECT_NEAR(ranges.count() / 10000.0, share, 0.016);
    if (share > 0.0) {
      EXPECT_NEAR(ranges.mean(), 1.5, 0.08);
    }
  }
}

TEST(IconicSettings, PostsAndGoalsAreHiddenByWhatStandsBeforeThem) {
  FakeWorld world(12.0, 8.0);
  world.addLandmark({1, "goal", 5.0, 0.0, 0.5});
  world.addLandmark({1, "post", 0.0, 3.0, 0.5});
  const auto counts = [&](const std::string& more) {
    SensorRig rig("iconic_omnivision", "see = ['goals', 'posts']\n" + more);
    rig.sense(world, {});
    return std::pair{rig.get<LandmarksData>(0).reading().size(),
                     rig.get<LandmarksData>(1).reading().size()};
  };
  EXPECT_EQ(counts(""), std::pair(std::size_t{1}, std::size_t{1}));
  world.addPost({2.0, 0.0, 0.2});
  world.addPost({0.0, 2.5, 0.1});  // its far side is 0.4 m before the post
  EXPECT_EQ(counts(""), std::pair(std::size_t{0}, std::size_t{0}));
  EXPECT_EQ(counts("slack_m = 0.7"),
            std::pair(std::size_t{0}, std::size_t{1}));  // as near: its own
  EXPECT_EQ(counts("occlusion = false"), std::pair(std::size_t{1}, std::size_t{1}));
}

/// A room of which only some walls are known: the scanner sees all.
PoseFixData::Reading fixesIn(const FakeWorld& world, const std::string& more) {
  SensorRig rig("lrf_iconic", "beams = 360\nfov_deg = 360\nmax_range_m = 12\n" + more);
  rig.sense(world, {0.7, 0.4, 0.3});
  return rig.get<PoseFixData>(1).reading();
}

/// With three of four walls known, those beams that end at the fourth count against it.
TEST(LrfIconicSettings, HowMuchOfAScanMustAgree) {
  FakeWorld world(8.0, 5.0);
  world.addWall(4.05, 0, 0.05, 2.6);
  world.addWall(-4.05, 0, 0.05, 2.6);
  world.addWall(0, 2.55, 4.1, 0.05);
  // The unknown wall lies from atan2(-2.9, -4.7) to atan2(-2.9, 3.3): 107 of 360 degrees, and 70 %
  // agree. Three walls ask for 0.115 * 2 more than the setting.
  // Half a turn off, the wall across takes the place of the unknown one.
  EXPECT_EQ(fixesIn(world, "share_matched = 0.4").size(), 2u);
  EXPECT_EQ(fixesIn(world, "share_matched = 0.44").size(), 2u);
  EXPECT_TRUE(fixesIn(world, "share_matched = 0.5").empty());
  EXPECT_TRUE(fixesIn(world, "").empty());
}

/// All four walls of a square: four positions, a quarter turn apart.
TEST(LrfIconicSettings, MorePositionsThanItMayGiveAreNone) {
  FakeWorld world(6.0, 6.0);
  world.addWallsOfRoom();
  EXPECT_EQ(fixesIn(world, "").size(), 4u);
  EXPECT_EQ(fixesIn(world, "most_positions = 4").size(), 4u);
  EXPECT_TRUE(fixesIn(world, "most_positions = 3").empty());
}

/// Walls that are not quite where the field says make positions less sure, all of them alike.
TEST(LrfIconicSettings, WallsThatAreNotSureMakePositionsUnsure) {
  FakeWorld world(6.0, 6.0);
  world.addWallsOfRoom();
  const auto sigma = [&](const std::string& text) {
    const auto fixes = fixesIn(world, text + "\nnoise_sigma_m = 0\nrange_sigma_m = 0.0001");
    return fixes.empty() ? -1.0 : std::sqrt(fixes[0].covariance[0]);
  };
  // Both walls across x err by 0.1 m on their own; the one with more beams weighs more.
  EXPECT_GT(sigma("wall_sigma_m = 0.1"), 0.1 / std::sqrt(2.0));
  EXPECT_LT(sigma("wall_sigma_m = 0.1"), 0.1);
  EXPECT_LT(sigma("wall_sigma_m = 0"), 0.001);
  EXPECT_GT(sigma("wall_sigma_m = 0"), 0.0);
}

/// In the middle of a square with walls that err on their own, what errs for all points of a wall
/// alike does so in closed form; and the field does not turn with the robot that looks at it.
TEST(LrfIconicSettings, HowSureAPositionIsDoesNotDependOnWhereTheScannerLooks) {
  constexpr double kHalf = 3.0;   // of a side [m]
  constexpr double kSigma = 0.1;  // of a wall across itself; of its ends, when it turns [m]
  FakeWorld world(2.0 * kHalf, 2.0 * kHalf);
  world.addWallsOfRoom();
  for (const int turn : {0, 20, 45, 70, 135, -110}) {  // by whole beams, so to the same points
    SensorRig rig("lrf_iconic",
                  "beams = 360\nfov_deg = 360\nmax_range_m = 12\nnoise_sigma_m = 0\n"
                  "range_sigma_m = 0\nwall_sigma_m = 0.1");
    rig.sense(world, {0.0, 0.0, turn * kDegree});
    const PoseFixData::Reading& fixes = rig.get<PoseFixData>(1).reading();
    ASSERT_EQ(fixes.size(), 4u) << turn;
    for (const PoseFixData::Fix& fix : fixes) {
      // Two walls across each axis; the mean of the angles of four. Pieces end a beam before the
      // corners.
      const double ofHeading = kSigma / kHalf / 2.0;
      EXPECT_NEAR(fix.covariance[0], kSigma * kSigma / 2.0, 0.02 * kSigma * kSigma) << turn;
      EXPECT_NEAR(fix.covariance[4], kSigma * kSigma / 2.0, 0.02 * kSigma * kSigma) << turn;
      EXPECT_NEAR(fix.covariance[8], ofHeading * ofHeading, 0.1 * ofHeading * ofHeading) << turn;
      EXPECT_NEAR(fix.covariance[1], 0.0, 0.02 * kSigma * kSigma) << turn;
    }
  }
}

/// A dark wall may give no echo from the last tenth of the scanner's reach; nearer, it has to be
/// seen. Here one stands askew in a corridor, known, and nothing comes back from it. The robot is
/// near the corridor's end, which is so much of what it sees that it fits nowhere else.
TEST(LrfIconicSettings, WallsAtTheEndOfItsReachNeedNotBeSeen) {
  for (const auto& [away, isFine] : {std::pair{5.7, true}, {4.8, false}}) {  // of 6 m
    FakeWorld world(40.0, 5.0);
    world.addWall(-20.05, 0.0, 0.05, 2.6);
    world.addWall(-16.1, 2.55, 4.1, 0.05);
    world.addWall(-16.1, -2.55, 4.1, 0.05);
    WorldObject dark;
    dark.kind = "wall";
    dark.pose = {-18.5 + away, 0.0, 10 * kDegree};
    dark.halfX = 0.01;
    dark.halfY = 2.5;
    dark.zHigh = 1.0;
    world.addObject(dark);
    SensorRig rig("lrf_iconic", "beams = 360\nfov_deg = 360\nmax_range_m = 6");
    rig.sense(world, {-18.5, 0.3, 0.2});
    const PoseFixData::Reading& fixes = rig.get<PoseFixData>(1).reading();
    ASSERT_EQ(fixes.size(), isFine ? 1u : 0u) << away;
    if (!isFine) continue;
    EXPECT_NEAR(fixes[0].pose.x, -18.5, 0.01);
    EXPECT_NEAR(fixes[0].pose.y, 0.3, 0.01);
    EXPECT_NEAR(fixes[0].pose.theta, 0.2, 0.01);
  }
}

/// An obstacle that is no small body and hides most of a wall counts against a position only as far
/// as it is seen; what lies behind a wall says that the place is wrong.
TEST(LrfIconicSettings, APlaceFromWhichOneWouldSeeThroughWallsIsNone) {
  FakeWorld world(8.0, 5.0);
  world.addWallsOfRoom();
  EXPECT_EQ(fixesIn(world, "").size(), 2u);
  world.addWall(-1.0, 0.0, 0.05, 1.0);  // known, but it is not there
  EXPECT_TRUE(fixesIn(world, "").empty());
}

}  // namespace
}  // namespace ortung
