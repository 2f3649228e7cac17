#include <cmath>
#include <numbers>

#include "FakeWorld.hpp"
#include "SensorRig.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/ScalarData.hpp"

namespace ortung {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;  // [rad]
constexpr double kMillimetre = 0.00051;               // words round to the nearest [m]
constexpr double kAngle = 0.0051 * kDegree;           // likewise, 1/100 degree

FakeWorld roomWithPosts() {
  FakeWorld room(12.0, 8.0);
  const double xs[] = {5.0, -5.0, -5.0, 5.0};
  const double ys[] = {3.0, 3.0, -3.0, -3.0};
  for (int i = 0; i < 4; ++i) {
    room.addPost({xs[i], ys[i], 0.1});
    room.addLandmark({static_cast<std::uint32_t>(i + 1), "post", xs[i], ys[i], 0.5});
  }
  room.addLandmark({1, "goal", 5.9, 0.0, 0.5});
  return room;
}

TEST(LandmarksPlugin, MakesADistanceAndABearingForEach) {
  SensorRig rig("landmarks", "identities = [3, 7]\nkind = 'goal'");
  ASSERT_EQ(rig.data.size(), 4u);
  EXPECT_EQ(toText(rig.data[0]->id()), "omnivision/camera/goal3Distance");
  EXPECT_EQ(toText(rig.data[1]->id()), "omnivision/camera/goal3Bearing");
  EXPECT_EQ(toText(rig.data[3]->id()), "omnivision/camera/goal7Bearing");
  EXPECT_NE(dynamic_cast<ScalarData*>(rig.data[0]), nullptr);
  EXPECT_NE(dynamic_cast<BearingData*>(rig.data[1]), nullptr);
}

TEST(LandmarksPlugin, MakesOneListOnDemand) {
  SensorRig rig("landmarks", "features = 'list'");
  ASSERT_EQ(rig.data.size(), 1u);
  EXPECT_EQ(rig.data[0]->id().feature, "posts");
  EXPECT_EQ(rig.get<LandmarksData>().config().identities.size(), 4u);
}

TEST(LandmarksPlugin, RefusesWrongSettingsByName) {
  expectRefusal("landmarks", "identites = [1]", {"test.toml", "identites"});
  expectRefusal("landmarks", "identities = []", {"identities", "1 to 256"});
  expectRefusal("landmarks", "identities = [1, 1]", {"identities", "1 twice"});
  expectRefusal("landmarks", "identities = [1.5]", {"identities", "1.5", "whole"});
  expectRefusal("landmarks", "identities = [-1]", {"identities", "-1"});
  expectRefusal("landmarks", "kind = 'a/b'", {"kind", "a/b"});
  expectRefusal("landmarks", "features = 'some'", {"features", "some", "each", "list"});
  expectRefusal("landmarks", "feature = 'x'", {"feature", "kind"});
  expectRefusal("landmarks", "range_scale = 0", {"range_scale", "0"});
  expectRefusal("landmarks", "range_sigma_m = 0", {"range_sigma_m"});
  expectRefusal("landmarks", "bearing_sigma_deg = 1000", {"bearing_sigma_deg", "1000"});
  expectRefusal("landmarks", "range_bias_m = 0.1", {"range_bias_m", "list"});
  expectRefusal("landmarks", "identified = false", {"identified", "list"});
  expectRefusal("landmarks", "identified = false\nfeatures = 'list'\nslant = true",
                {"identified", "slant"});
  expectRefusal("landmarks", "missed_share = -0.1", {"missed_share", "-0.1"});
}

// The learner must know which is which; a camera that can't tell does not.
TEST(LandmarksPlugin, SaysWhichLandmarkIsWhichToTheLearnerAlone) {
  SensorRig rig("landmarks", "features = 'list'\nidentified = false\nrange_bias_m = 0.5");
  const FakeWorld room = roomWithPosts();
  rig.sense(room, {0.0, 0.0, 0.0});
  const LandmarksData::Reading truth = rig.get<LandmarksData>().reading();
  Random random(1);
  rig.sense(room, {0.0, 0.0, 0.0}, &random);
  const LandmarksData::Reading seen = rig.get<LandmarksData>().reading();
  ASSERT_EQ(truth.size(), 4u);
  ASSERT_EQ(seen.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(truth[i].identity, i + 1);
    EXPECT_NEAR(truth[i].range, std::hypot(5.0, 3.0), kMillimetre);
    EXPECT_EQ(seen[i].identity, LandmarksData::kUnknown);
    EXPECT_NEAR(seen[i].range, std::hypot(5.0, 3.0) + 0.5, 0.5) << "five sigmas";
    EXPECT_GT(seen[i].range, std::hypot(5.0, 3.0) + 0.1);
  }
}

TEST(LandmarksPlugin, MakesDistancesOrBearingsAlone) {
  SensorRig distances("landmarks", "features = 'distances'\nidentities = [1, 2]");
  ASSERT_EQ(distances.data.size(), 2u);
  EXPECT_EQ(distances.data[1]->id().feature, "post2Distance");
  SensorRig bearings("landmarks", "features = 'bearings'\nidentities = [1, 2]");
  ASSERT_EQ(bearings.data.size(), 2u);
  EXPECT_EQ(bearings.data[0]->id().feature, "post1Bearing");
}

TEST(LandmarksPlugin, MeasuresInSpaceAndByAScaleOfItsOwn) {
  FakeWorld room(12.0, 8.0);
  room.addLandmark({1, "post", 4.0, 0.0, 3.5});
  const std::string post = "identities = [1]\npose = { z_m = 0.5 }\n";
  const auto distance = [&](const std::string& more, std::string& key) {
    SensorRig rig("landmarks", post + more);
    rig.sense(room, {0.0, 0.0, 0.0});
    key = rig.data[0]->learningKey();
    return rig.get<ScalarData>(0).reading().value();
  };
  std::string floor;
  std::string space;
  std::string scaled;
  EXPECT_NEAR(distance("", floor), 4.0, kMillimetre);
  EXPECT_NEAR(distance("slant = true", space), 5.0, kMillimetre);  // 4 m, and 3 m up
  EXPECT_NEAR(distance("range_scale = 1.1", scaled), 4.4, kMillimetre);
  EXPECT_NE(space, floor) << "other tables";
  EXPECT_NE(scaled, floor);
  SensorRig list("landmarks", post + "features = 'list'\nslant = true\nrange_scale = 1.1");
  list.sense(room, {0.0, 0.0, 0.0});
  EXPECT_NEAR(list.get<LandmarksData>().reading().at(0).range, 5.5, kMillimetre);
}

TEST(LandmarksPlugin, SeesWhatGeometrySays) {
  const FakeWorld room = roomWithPosts();
  SensorRig rig("landmarks", "pose = { x_m = 0.3, theta_deg = 180 }");
  const Pose2 robot{1.0, -0.5, 0.7};
  rig.sense(room, robot);
  const double x = 1.0 + 0.3 * std::cos(0.7);
  const double y = -0.5 + 0.3 * std::sin(0.7);
  for (std::size_t i = 0; i < 4; ++i) {
    const Landmark& post = room.landmarks()[i];
    const auto distance = rig.get<ScalarData>(2 * i).reading();
    const auto bearing = rig.get<BearingData>(2 * i + 1).reading();
    ASSERT_TRUE(distance && bearing) << i;
    EXPECT_NEAR(*distance, std::hypot(post.x - x, post.y - y), kMillimetre);
    const double expected = std::atan2(post.y - y, post.x - x) - 0.7 - std::numbers::pi;
    EXPECT_NEAR(std::remainder(*bearing - expected, 2.0 * std::numbers::pi), 0.0, kAngle);
  }
}

TEST(LandmarksPlugin, GivesTheListWhatItGivesEach) {
  const FakeWorld room = roomWithPosts();
  SensorRig list("landmarks", "features = 'list'\nmax_range_m = 6");
  list.sense(room, {1.0, 0.0, 0.4});
  const LandmarksData::Reading& posts = list.get<LandmarksData>().reading();
  ASSERT_EQ(posts.size(), 2u);  // sqrt(4^2 + 3^2) = 5 m to the near ones, sqrt(6^2 + 3^2) to others
  EXPECT_EQ(posts[0].identity, 1u);
  EXPECT_EQ(posts[1].identity, 4u);
  EXPECT_NEAR(posts[0].range, 5.0, kMillimetre);
  EXPECT_NEAR(posts[0].bearing, std::atan2(3.0, 4.0) - 0.4, kAngle);
}

TEST(LandmarksPlugin, LooksAndSeesNothingBehindAnObstacle) {
  FakeWorld room = roomWithPosts();
  room.addPost({2.5, 1.5, 0.3});
  SensorRig rig("landmarks", "");
  rig.sense(room, {0.0, 0.0, 0.0});
  EXPECT_FALSE(rig.get<ScalarData>(0).reading());  // post 1 is right behind it
  EXPECT_EQ(rig.data[0]->sequence(), 1u);          // but it has looked
  EXPECT_TRUE(rig.get<ScalarData>(2).reading());
  SensorRig through("landmarks", "occlusion = false");
  through.sense(room, {0.0, 0.0, 0.0});
  EXPECT_TRUE(through.get<ScalarData>(0).reading());
}

TEST(LandmarksPlugin, KeepsToItsFieldOfViewAndRange) {
  const FakeWorld room = roomWithPosts();
  SensorRig rig("landmarks", "fov_deg = 90\nmin_range_m = 3\nmax_range_m = 5.9");
  rig.sense(room, {0.0, 0.0, 0.0});
  EXPECT_TRUE(rig.get<ScalarData>(0).reading());   // post 1 at 31 degrees
  EXPECT_FALSE(rig.get<ScalarData>(2).reading());  // post 2 is behind
  EXPECT_TRUE(rig.get<BearingData>(7).reading());
  rig.sense(room, {-4.0, 0.0, 0.0});
  EXPECT_FALSE(rig.get<ScalarData>(0).reading());  // 9.5 m away
  rig.sense(room, {4.0, 2.0, 45.0 * kDegree});
  EXPECT_FALSE(rig.get<ScalarData>(0).reading());  // 1.4 m away
}

TEST(LandmarksPlugin, TellsKindsApart) {
  const FakeWorld room = roomWithPosts();
  SensorRig rig("landmarks", "kind = 'goal'\nidentities = [1, 2]");
  rig.sense(room, {0.0, 0.0, 0.0});
  EXPECT_NEAR(rig.get<ScalarData>(0).reading().value(), 5.9, kMillimetre);
  EXPECT_FALSE(rig.get<ScalarData>(2).reading());  // the room has no second goal
}

TEST(LandmarksPlugin, HasTheNoiseOfItsModel) {
  const FakeWorld room = roomWithPosts();
  SensorRig rig("landmarks",
                "identities = [1]\nrange_sigma_m = 0.02\nrange_sigma_per_m = 0.01\n"
                "bearing_sigma_deg = 5");
  Random noise(5);
  Statistics ranges;
  Statistics bearings;
  for (int i = 0; i < 4000; ++i) {
    rig.sense(room, {1.0, 0.0, 0.0}, &noise);
    ranges.add(rig.get<ScalarData>(0).reading().value());
    bearings.add(rig.get<BearingData>(1).reading().value());
  }
  // At 5 m sigma is 0.07 m; means within 4 sigma / sqrt(4000), sigmas within 5 %.
  EXPECT_NEAR(ranges.mean(), 5.0, 0.0045);
  EXPECT_NEAR(ranges.sigma(), 0.07, 0.0035);
  EXPECT_NEAR(bearings.mean(), std::atan2(3.0, 4.0), 0.32 * kDegree);
  EXPECT_NEAR(bearings.sigma(), 5.0 * kDegree, 0.25 * kDegree);
}

TEST(LandmarksPlugin, MissesDistanceAndBearingTogether) {
  const FakeWorld room = roomWithPosts();
  SensorRig rig("landmarks", "identities = [1]\nmissed_share = 0.3");
  Random noise(9);
  int missed = 0;
  for (int i = 0; i < 3000; ++i) {
    rig.sense(room, {1.0, 0.0, 0.0}, &noise);
    EXPECT_EQ(rig.get<ScalarData>(0).reading().has_value(),
              rig.get<BearingData>(1).reading().has_value());
    missed += rig.get<ScalarData>(0).reading() ? 0 : 1;
  }
  EXPECT_NEAR(missed / 3000.0, 0.3, 0.034);  // 4 sigma of 3000 draws
}

TEST(LandmarksPlugin, SpreadsFalseSightingsOverItsField) {
  const FakeWorld room = roomWithPosts();
  SensorRig rig("landmarks", "identities = [1]\nfalse_share = 1\nfov_deg = 120\nmax_range_m = 10");
  Random noise(2);
  Statistics ranges;
  for (int i = 0; i < 2000; ++i) {
    rig.sense(room, {1.0, 0.0, 0.0}, &noise);
    ranges.add(rig.get<ScalarData>(0).reading().value());
    EXPECT_LE(std::abs(rig.get<BearingData>(1).reading().value()), 60.01 * kDegree);
  }
  EXPECT_NEAR(ranges.mean(), 5.0, 0.26);  // uniform in [0, 10]
  EXPECT_NEAR(ranges.sigma(), 10.0 / std::sqrt(12.0), 0.15);
}

}  // namespace
}  // namespace ortung
