#include <cmath>
#include <numbers>

#include "FakeWorld.hpp"
#include "SensorRig.hpp"
#include "ortung/formats/ConeData.hpp"

namespace ortung {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;  // [rad]
constexpr double kMillimetre = 0.00051;               // words round to the nearest [m]

TEST(SonarPlugin, PutsItsSonarsOnARing) {
  SensorRig rig("sonar",
                "angles_deg = [0, 90]\nring_radius_m = 0.2\npose = { x_m = 0.1, theta_deg = 90 }");
  ASSERT_EQ(rig.data.size(), 2u);
  EXPECT_EQ(toText(rig.data[1]->id()), "sonar/ultrasonic/sonar1");
  EXPECT_NEAR(rig.data[0]->mount().x, 0.1, 1e-12);
  EXPECT_NEAR(rig.data[0]->mount().y, 0.2, 1e-12);
  EXPECT_NEAR(rig.data[1]->mount().x, -0.1, 1e-12);
  EXPECT_NEAR(std::abs(rig.data[1]->mount().theta), std::numbers::pi, 1e-12);
}

TEST(SonarPlugin, RefusesWrongSettingsByName) {
  expectRefusal("sonar", "angles = [0]", {"test.toml", "angles"});
  expectRefusal("sonar", "angles_deg = []", {"angles_deg", "1 to 64"});
  expectRefusal("sonar", "angles_deg = [400]", {"angles_deg", "400"});
  expectRefusal("sonar", "opening_deg = 0", {"opening_deg", "0"});
  expectRefusal("sonar", "max_range_m = 1e9", {"max_range_m"});
  expectRefusal("sonar", "missed_share = 2", {"missed_share", "2"});
}

TEST(SonarPlugin, MeasuresTheNearestPointWithinItsCone) {
  const FakeWorld room(4.0, 40.0);
  SensorRig rig("sonar", "angles_deg = [0]\nring_radius_m = 0.2\nopening_deg = 20");
  rig.sense(room, {0.0, 0.0, 0.0});
  EXPECT_NEAR(rig.get<ConeData>().reading(), 1.8, kMillimetre);
  // Turned by 8 degrees the wall's foot is still within the cone of 10 degrees: rays are 2 degrees
  // apart, one of them meets it.
  rig.sense(room, {0.0, 0.0, 8.0 * kDegree});
  EXPECT_NEAR(rig.get<ConeData>().reading(), 2.0 - 0.2 * std::cos(8.0 * kDegree), 0.001);
  // By 40 degrees the nearest is at the cone's edge, 30 degrees off the wall's normal.
  rig.sense(room, {0.0, 0.0, 40.0 * kDegree});
  const double away = 2.0 - 0.2 * std::cos(40.0 * kDegree);
  EXPECT_NEAR(rig.get<ConeData>().reading(), away / std::cos(30.0 * kDegree), 0.001);
}

TEST(SonarPlugin, FiresInGroupsInItsOrder) {
  const FakeWorld room(4.0, 4.0);
  SensorRig rig("sonar",
                "angles_deg = [0, 90, 180, 270]\nfiring_order = [0, 2, 3, 1]\n"
                "fire_at_once = 2\nperiod_s = 0.2");
  EXPECT_DOUBLE_EQ(rig.sensor->period(), 0.1);  // two groups in 0.2 s
  Random noise(1);
  const auto counts = [&] {
    std::vector<std::uint64_t> all;
    for (const SensorData* one : rig.data) all.push_back(one->sequence());
    return all;
  };
  using Counts = std::vector<std::uint64_t>;
  rig.sense(room, {}, &noise);
  EXPECT_EQ(counts(), (Counts{1, 0, 1, 0}));
  rig.sense(room, {}, &noise);
  EXPECT_EQ(counts(), (Counts{1, 1, 1, 1}));
  rig.sense(room, {}, &noise);
  EXPECT_EQ(counts(), (Counts{2, 1, 2, 1}));
  rig.sense(room, {});  // without noise, as the learner does: all
  EXPECT_EQ(counts(), (Counts{3, 2, 3, 2}));
}

TEST(SonarPlugin, RefusesAWrongFiringOrder) {
  const std::string four = "angles_deg = [0, 90, 180, 270]\n";
  expectRefusal("sonar", four + "fire_at_once = 3", {"fire_at_once", "3", "divide"});
  expectRefusal("sonar", four + "firing_order = [0, 1, 2]", {"firing_order"});
  expectRefusal("sonar", four + "firing_order = [0, 1, 2, 2]", {"firing_order", "once"});
  expectRefusal("sonar", four + "firing_order = [0, 1, 2, 4]", {"firing_order", "0 to 3"});
  expectRefusal("sonar", four + "firing_order = [0, 1, 2, 0.5]", {"firing_order", "0.5"});
}

TEST(SonarPlugin, SeesNothingBeyondItsRange) {
  const FakeWorld room(20.0, 20.0);
  SensorRig rig("sonar", "angles_deg = [0, 180]\nmax_range_m = 3");
  rig.sense(room, {8.0, 0.0, 0.0});
  EXPECT_NEAR(rig.get<ConeData>(0).reading(), 1.8, kMillimetre);
  EXPECT_TRUE(std::isinf(rig.get<ConeData>(1).reading()));
}

TEST(SonarPlugin, ReportsItsSmallestRangeForWhatIsNearer) {
  const FakeWorld room(1.0, 1.0);
  SensorRig rig("sonar", "angles_deg = [0]\nring_radius_m = 0.4\nmin_range_m = 0.17");
  rig.sense(room, {});
  EXPECT_NEAR(rig.get<ConeData>().reading(), 0.17, kMillimetre);
}

TEST(SonarPlugin, HasTheNoiseOfItsModelAndLosesEchoes) {
  const FakeWorld room(4.4, 4.4);
  SensorRig rig("sonar",
                "angles_deg = [0]\nsigma_m = 0.01\nsigma_per_m = 0.02\nmissed_share = 0.25");
  Random noise(4);
  Statistics ranges;
  for (int i = 0; i < 4000; ++i) {
    rig.sense(room, {}, &noise);
    const double range = rig.get<ConeData>().reading();
    if (std::isfinite(range)) ranges.add(range);
  }
  EXPECT_NEAR(ranges.count() / 4000.0, 0.75, 0.028);  // 4 sigma of 4000 draws
  EXPECT_NEAR(ranges.mean(), 2.0, 0.0037);            // 4 * 0.05 / sqrt(3000)
  EXPECT_NEAR(ranges.sigma(), 0.05, 0.0026);
}

TEST(SonarPlugin, LooksAroundOnceForSonarsThatTurnAtTheSamePlace) {
  const FakeWorld room(4.0, 4.0);
  SensorRig rig("sonar", "angles_deg = [0, 120, 240]");
  std::size_t once = 0;
  for (const double heading : {0.3, 0.3 + 10.0 * kDegree, 0.3 - 90.0 * kDegree}) {
    SensorRig alone("sonar", "angles_deg = [0]");  // looks at each heading anew
    const Pose2 place{0.5, 0.2, heading};
    alone.sense(room, place * inverse(alone.data[0]->mount()));
    if (once == 0) once = room.rays();
    for (std::size_t i = 0; i < 3; ++i) {
      RobotState state;
      state.pose = place * inverse(rig.data[i]->mount());
      SensorData* one = rig.data[i];
      rig.sensor->generateData(room, state, nullptr, 1, {&one, 1});
      EXPECT_NEAR(rig.get<ConeData>(i).reading(), alone.get<ConeData>().reading(), 0.0011);
    }
  }
  EXPECT_EQ(room.rays(), 4 * once);  // three alone, the ring's once
}

TEST(SonarPlugin, SeesTheSameWithNoiseOfZeroAsWithoutNoise) {
  FakeWorld room(4.0, 4.0);
  room.addPost({0.9, 0.4, 0.1});
  SensorRig rig("sonar", "angles_deg = [0, 45, 90]\nnoise_sigma_m = 0\nnoise_sigma_per_m = 0");
  for (double heading = -3.0; heading < 3.0; heading += 0.37) {
    for (std::size_t i = 0; i < 3; ++i) {
      SensorData* one = rig.data[i];
      RobotState state;
      state.pose = {0.1, -0.2, heading};
      Random noise(1);
      rig.sensor->generateData(room, state, &noise, ++rig.now, {&one, 1});
      const double noisy = rig.get<ConeData>(i).reading();
      rig.sensor->generateData(room, state, nullptr, rig.now, {&one, 1});
      EXPECT_NEAR(rig.get<ConeData>(i).reading(), noisy, 0.0011);
    }
  }
}

}  // namespace
}  // namespace ortung
