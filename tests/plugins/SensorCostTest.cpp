// What readings cost, by which a server refuses robots that would slow down all others.
#include <string>

#include "FakeWorld.hpp"
#include "SensorRig.hpp"

namespace ortung {
namespace {

double costOf(const std::string& plugin, const std::string& toml) {
  PluginFactory factory(PluginFactory::standardFolders());
  return factory.make<Sensor>(plugin, parseToml(toml, "test.toml"))->rays();
}

/// How many rays a reading of the sensor really casts.
double castBy(const std::string& plugin, const std::string& toml) {
  FakeWorld world(8.0, 5.0);
  SensorRig rig(plugin, toml);
  Random noise(1);
  rig.sense(world, {0.5, 0.3, 0.4}, &noise);
  return static_cast<double>(world.rays());
}

TEST(SensorCost, OfAScannerIsABeamARay) {
  for (const std::string settings : {"beams = 37\nfov_deg = 90", "beams = 720\nfov_deg = 360"}) {
    EXPECT_EQ(costOf("lrf", settings), settings.starts_with("beams = 37") ? 37.0 : 720.0);
    EXPECT_EQ(costOf("lrf", settings), castBy("lrf", settings));
  }
}

// Shapes are found in the scan and matched with walls: ten times the time of the rays.
TEST(SensorCost, OfFeaturesOfAScanIsTenTimesThatOfTheScan) {
  const std::string settings = "beams = 90\nfov_deg = 180\nmax_range_m = 12";
  EXPECT_EQ(costOf("lrf_iconic", settings), 10.0 * castBy("lrf_iconic", settings));
}

TEST(SensorCost, OfASonarIsAtLeastThatOfItsCone) {
  for (const std::string settings : {"angles_deg = [0]", "angles_deg = [-90, 0, 90]",
                                     "angles_deg = [-30, 30]\nopening_deg = 60"}) {
    EXPECT_GE(costOf("sonar", settings), castBy("sonar", settings)) << settings;
    EXPECT_LE(costOf("sonar", settings), 4.0 * castBy("sonar", settings)) << settings;
  }
}

// Whether it is seen is one ray to each.
TEST(SensorCost, OfLandmarksIsARayEach) {
  for (const auto& [plugin, more] :
       {std::pair<std::string, std::string>{"landmarks", ""},
        {"lrf_cylinders", "\nreads = 'LMS200/LRF/scan'\nradius_m = 0.1"}}) {
    EXPECT_EQ(costOf(plugin, "identities = [1]" + more), 1.0) << plugin;
    EXPECT_EQ(costOf(plugin, "identities = [4, 2, 7, 9, 11]" + more), 5.0) << plugin;
  }
}

// Some twenty lines cross a scan line, each of which has to be seen.
TEST(SensorCost, OfACameraOnTheFloorGrowsWithItsScanLines) {
  for (const int rays : {7, 90})
    EXPECT_EQ(
        costOf("iconic_camera", "see = ['lines']\nlines = { rays = " + std::to_string(rays) + " }"),
        20.0 * rays);
}

}  // namespace
}  // namespace ortung
