#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "FakeWorld.hpp"
#include "SensorRig.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/PointsData.hpp"
#include "ortung/formats/ScanData.hpp"

/// What settings of sensors may be, what they are when nothing is said, and where they arrive.
namespace ortung {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;  // [rad]

TEST(SensorLimits, SensorsSitWithinTenMetresOfTheMiddle) {
  for (const std::string plugin : {"lrf", "landmarks", "iconic_camera", "compass", "sonar"}) {
    for (const std::string key : {"x_m", "y_m"}) {
      for (const std::string fine : {"-10", "10"})
        EXPECT_EQ(refusal(plugin, "pose = { " + key + " = " + fine + " }"), "") << plugin;
      for (const std::string wrong : {"-10.01", "10.01"})
        expectRefusal(plugin, "pose = { " + key + " = " + wrong + " }", {key, "[-10, 10]"});
    }
    expectRefusal(plugin, "pose = { z_m = -0.01 }", {"z_m", "[0, 10]"});
    expectRefusal(plugin, "pose = { z_m = 10.01 }", {"z_m", "[0, 10]"});
  }
}

TEST(SensorLimits, NumbersHaveTheLimitsThatRefusalsTell) {
  struct Limits {
    std::string key;
    std::string low;
    std::string high;
  };
  const auto expectLimits = [](const std::string& plugin, const std::string& head,
                               const std::vector<Limits>& all) {
    for (const auto& [key, low, high] : all) {
      const auto answer = [&](double number) {
        return refusal(plugin, head + "\n" + key + " = " + std::to_string(number));
      };
      const std::string range = "must be in [" + low + ", " + high + "]";
      const auto isRefused = [&](double number) {
        return answer(number).find(range) != std::string::npos;
      };
      EXPECT_FALSE(isRefused(std::stod(low))) << plugin << " " << key;
      EXPECT_FALSE(isRefused(std::stod(high))) << plugin << " " << key;
      for (const double wrong : {std::stod(low) - 1e-5, std::stod(high) + 1e-5})
        EXPECT_TRUE(isRefused(wrong)) << plugin << " " << key << ": " << answer(wrong);
    }
  };
  expectLimits("landmarks", "features = 'list'",
               {{"max_range_m", "0.05", "1000"},
                {"min_range_m", "0", "20"},
                {"fov_deg", "1", "360"},
                {"range_scale", "0.1", "10"},
                {"slack_m", "0", "10"},
                {"period_s", "0", "3600"},
                {"range_bias_m", "-10", "10"},
                {"range_bias_per_m", "-0.5", "0.5"},
                {"range_bias_per_m_rad", "-1", "1"},
                {"range_bias_per_m_rad2", "-1", "1"},
                {"bearing_bias_deg", "-180", "180"},
                {"bearing_bias_per_rad", "-0.3", "0.3"},
                {"bearing_bias_per_rad2", "-0.2", "0.2"},
                {"noise_range_sigma_m", "0", "100"},
                {"noise_range_sigma_per_m", "0", "10"},
                {"noise_bearing_sigma_deg", "0", "180"},
                {"missed_share", "0", "1"},
                {"false_share", "0", "1"}});
  expectLimits("lrf", "",
               {{"angle_step_deg", "0.001", "360"},
                {"fov_deg", "0.1", "360"},
                {"first_angle_deg", "-360", "360"},
                {"max_range_m", "0.05", "1000"},
                {"min_range_m", "0", "8"},
                {"endpoint_cell_m", "0.005", "1"},
                {"noise_sigma_m", "0", "10"},
                {"noise_sigma_per_m", "0", "1"}});
  expectLimits("sonar", "",
               {{"ring_radius_m", "0", "10"},
                {"opening_deg", "0.1", "120"},
                {"max_range_m", "0.05", "100"},
                {"min_range_m", "0", "3"},
                {"noise_sigma_m", "0", "10"},
                {"noise_sigma_per_m", "0", "1"}});
  expectLimits("iconic_omnivision", "see = ['posts', 'lines']",
               {{"max_range_m", "0.05", "1000"},
                {"min_range_m", "0", "10"},
                {"fov_deg", "1", "360"},
                {"slack_m", "0", "10"},
                {"visible_share", "0", "1"},
                {"noise_range_sigma_m", "0", "100"},
                {"noise_range_sigma_per_m", "0", "10"},
                {"noise_bearing_sigma_deg", "0", "180"}});
  expectLimits("compass", "", {{"north_deg", "-360", "360"}, {"noise_sigma_deg", "0", "180"}});
  expectLimits("lrf_cylinders", "reads = 'a/b/c'", {{"radius_m", "0.005", "5"}});
  expectLimits(
      "lrf_cylinders", "reads = 'a/b/c'\nradius_m = 0.2",
      {{"break_m", "0.01", "10"}, {"tolerance_m", "0.0001", "1"}, {"max_range_m", "0.05", "1000"}});
}

TEST(SensorLimits, KindsOfLandmarksHaveLettersDigitsAndThreeSigns) {
  PluginFactory factory(PluginFactory::standardFolders());
  const std::string good = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-";
  for (int c = 1; c < 128; ++c) {
    std::array<char, 8> escaped{};
    std::snprintf(escaped.data(), escaped.size(), "\\u%04x", static_cast<unsigned>(c));
    std::string said;
    try {
      factory.makeData("landmarks",
                       parseToml("kind = \"" + std::string(escaped.data()) + "\"", "test.toml"));
    } catch (const ConfigError& error) {
      said = error.what();
    }
    const bool isGood = good.find(static_cast<char>(c)) != good.npos;
    EXPECT_EQ(said.find("must be 1 to 32 of [A-Za-z0-9_.-]") == said.npos, isGood) << c << said;
    EXPECT_EQ(said.empty(), isGood) << c << said;
  }
  EXPECT_EQ(refusal("landmarks", "kind = '" + std::string(32, 'a') + "'"), "");
  expectRefusal("landmarks", "kind = '" + std::string(33, 'a') + "'", {"kind", "1 to 32"});
}

TEST(SensorLimits, BeamsAreSpreadEvenlyAboutTheFront) {
  for (const auto& [settings, first, step] :
       {std::tuple{"beams = 5\nangle_step_deg = 10", -20.0, 10.0},
        std::tuple{"beams = 6\nangle_step_deg = 2", -5.0, 2.0},
        std::tuple{"beams = 5\nfov_deg = 80", -40.0, 20.0},
        std::tuple{"beams = 5\nfov_deg = 80\nfirst_angle_deg = 7", 7.0, 20.0},
        std::tuple{"beams = 5\nangle_step_deg = 10\nfirst_angle_deg = 7", 7.0, 10.0}}) {
    const SensorRig rig("lrf", settings);
    const auto& scan = dynamic_cast<const ScanData&>(*rig.data.at(0)).config();
    EXPECT_NEAR(scan.firstAngle, first * kDegree, 1e-12) << settings;
    EXPECT_NEAR(scan.angleStep, step * kDegree, 1e-12) << settings;
  }
}

// Five beams at the edges and between them: one step more must fit between the last and the first.
TEST(SensorLimits, AScanMustNotReachIntoItself) {
  EXPECT_EQ(refusal("lrf", "beams = 5\nfov_deg = 288"), "");
  expectRefusal("lrf", "beams = 5\nfov_deg = 289",
                {"fov_deg", "must be 360 or at most 288.000000 with 5 beams"});
  EXPECT_EQ(refusal("lrf", "beams = 5\nangle_step_deg = 72"), "");
  expectRefusal("lrf", "beams = 5\nangle_step_deg = 73",
                {"angle_step_deg", "at most 72.000000 with 5 beams"});
}

TEST(SensorLimits, FormatsOfACameraKnowItsFieldOfViewAndRange) {
  SensorRig rig("iconic_camera",
                "see = ['lines', 'goals', 'posts']\nfov_deg = 90\nmax_range_m = 7\n"
                "lines = { max_range_m = 5 }\nposts = { identified = false }");
  const PointsData::Config& lines = rig.get<PointsData>(0).config();
  const LandmarksData::Config& goals = rig.get<LandmarksData>(1).config();
  const PointsData::Config& posts = rig.get<PointsData>(2).config();
  for (const double fieldOfView : {lines.fieldOfView, goals.fieldOfView, posts.fieldOfView})
    EXPECT_NEAR(fieldOfView, 90 * kDegree, 1e-12);
  EXPECT_EQ(lines.maxRange, 5.0);
  EXPECT_EQ(goals.maxRange, 7.0);
  EXPECT_EQ(posts.maxRange, 7.0);
}

// The table of plugins/sensors/iconic/README.md.
TEST(SensorLimits, SensorModelsOfACameraAreThoseOfItsPage) {
  SensorRig rig("iconic_omnivision",
                "see = ['lines', 'goals', 'posts']\nposts = { identified = false }");
  const LandmarksData::Config& goals = rig.get<LandmarksData>(1).config();
  EXPECT_EQ(goals.bearing.sigma, 3 * kDegree);
  for (const SensorModel& model : {rig.get<PointsData>(0).config().model, goals.range,
                                   rig.get<PointsData>(2).config().model}) {
    EXPECT_EQ(model.sigma, 0.1);
    EXPECT_EQ(model.sigmaPerMetre, 0.05);
  }
}

TEST(SensorLimits, AListOfLandmarksKnowsItsSettings) {
  SensorRig rig("landmarks",
                "features = 'list'\nidentities = [3, 5]\nmax_range_m = 6\nfov_deg = 120\n"
                "range_sigma_m = 0.2\nbearing_sigma_deg = 4");
  const LandmarksData::Config& list = rig.get<LandmarksData>().config();
  EXPECT_EQ(list.identities, (std::vector<std::uint32_t>{3, 5}));
  EXPECT_EQ(list.maxRange, 6.0);
  EXPECT_NEAR(list.fieldOfView, 120 * kDegree, 1e-12);
  EXPECT_EQ(list.range.sigma, 0.2);
  EXPECT_NEAR(list.bearing.sigma, 4 * kDegree, 1e-12);
}

TEST(SensorLimits, ACameraTellsOfItsOwnLandmarksAlone) {
  FakeWorld world(12.0, 8.0);
  world.addLandmark({2, "post", 3.0, 1.0, 0.5});
  world.addLandmark({9, "post", 3.0, -1.0, 0.5});
  world.addLandmark({2, "goal", 3.0, 0.0, 0.5});
  SensorRig rig("iconic_omnivision", "see = ['posts']");  // identities 1 to 4
  rig.sense(world, {});
  const LandmarksData::Reading& posts = rig.get<LandmarksData>().reading();
  ASSERT_EQ(posts.size(), 1u);
  EXPECT_EQ(posts[0].identity, 2u);
  EXPECT_NEAR(posts[0].bearing, std::atan2(1.0, 3.0), 0.0002);
  SensorRig alike("iconic_omnivision", "see = ['posts']\nposts = { identified = false }");
  alike.sense(world, {});
  EXPECT_EQ(alike.get<PointsData>().reading().size(), 2u) << "of whatever identity";
}

TEST(SensorLimits, FalseSightingsAreInAnyDirectionOfTheFieldOfView) {
  FakeWorld world(12.0, 8.0);
  world.addLandmark({1, "post", 5.0, 3.0, 0.5});
  SensorRig rig("landmarks", "identities = [1]\nfalse_share = 1\nfov_deg = 120\nmax_range_m = 10");
  Random noise(2);
  Statistics bearings;
  for (int i = 0; i < 2000; ++i) {
    rig.sense(world, {1.0, 0.0, 0.0}, &noise);
    bearings.add(rig.get<BearingData>(1).reading().value() / kDegree);
  }
  // Even from -60 to 60 degrees: sigma is 120 / sqrt(12) = 34.6, and 4 sigma of 2000 draws:
  EXPECT_NEAR(bearings.mean(), 0.0, 3.1);
  EXPECT_NEAR(bearings.sigma(), 120.0 / std::sqrt(12.0), 1.4);
}

}  // namespace
}  // namespace ortung
