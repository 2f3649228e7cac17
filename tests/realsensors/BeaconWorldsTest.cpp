/// Worlds and robot files of logs that know landmarks: small ones, with bounds computed by hand.

#include "LogTesting.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;

/// One folder for the files of a log.
class BeaconWorlds : public ::testing::Test {
 protected:
  std::string path(const std::string& name = "") const { return (folder_.path() / name).string(); }
  std::string worldOf(const std::string& source) const {
    makeSource(source)->writeWorld(folder_.path() / "hall.toml");
    return readBytes(folder_.path() / "hall.toml");
  }
  static void expectIn(const std::string& text, const std::vector<std::string>& parts) {
    for (const std::string& part : parts)
      EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  }
  void writePlaza(const std::string& name = "plaza1") const {
    folder_.write(name + "_TL.txt", "5 -17.5 59\n6 22 23.5\n");
    folder_.write(name + "_DR.txt", "1 0 0\n2 0.5 0\n");
    folder_.write(name + "_TD.txt", "2.5 2 6 20.25\n");
  }
  void writeUwb(const std::string& readme) const {
    folder_.write("README_source.md", readme);
    folder_.write("mid_ranges.txt", "1 4 4.5\n");
  }
  TemporaryFolder folder_;
};

// The box of the beacons is 39.5 m x 35.5 m; 10 m are added on each side.
TEST_F(BeaconWorlds, PlazaReachesTenMetresBeyondItsBeacons) {
  writePlaza();
  EXPECT_EQ(worldOf("plaza:" + path()),
            "[world]\nname = \"hall\"\nx_m = [-27.5, 32.0]\ny_m = [13.5, 69.0]\n"
            "\n[[landmark]]\nkind = \"beacon\"\nidentity = 5\nposition_m = [-17.5, 59.0]\n"
            "\n[[landmark]]\nkind = \"beacon\"\nidentity = 6\nposition_m = [22.0, 23.5]\n");
}

// Ranges are 1.07 times too long, so the longest one in the world is 1.07 * hypot(59.5, 55.5) m.
TEST_F(BeaconWorlds, PlazasRobotHearsBeaconsFromEverywhere) {
  writePlaza("gesling1");
  const std::string robot = makeSource("plaza:" + path() + "?run=gesling1")->robotToml();
  expectIn(robot, {"name = \"gesling1\"", "identities = [5, 6]", "max_range_m = 88.0\n",
                   "range_scale = 1.07\n", "features = \"distances\""});
}

TEST_F(BeaconWorlds, UwbPoseKnowsHowHighItsAnchorsAre) {
  writeUwb("| Tag 0 | -0.5 | 0.25 | 0 |\n| Anchor 0 | -3 | 2 | 1.5 |\n| Anchor 1 | 3 | -3 | 0 |\n");
  EXPECT_EQ(worldOf("uwbpose:" + path()),
            "[world]\nname = \"hall\"\nx_m = [-4.0, 4.0]\ny_m = [-4.0, 3.0]\n"
            "\n[[landmark]]\nkind = \"anchor\"\nidentity = 0\nposition_m = [-3.0, 2.0, 1.5]\n"
            "\n[[landmark]]\nkind = \"anchor\"\nidentity = 1\nposition_m = [3.0, -3.0, 0.0]\n");
}

TEST_F(BeaconWorlds, UwbPosesTagsAreAsHighAsTheFirstPoseOrOneMetre) {
  writeUwb("| Tag 0 | -0.5 | 0.25 | 0 |\n| Anchor 0 | -3 | 3 | 1.5 |\n| Anchor 1 | 3 | -3 | 1 |\n");
  expectIn(makeSource("uwbpose:" + path())->robotToml(),
           {"name = \"uwbpose-mid\"", "model = \"tag0\"", "identities = [0, 1]",
            "pose = { x_m = -0.5, y_m = 0.25, z_m = 1.0 }", "max_range_m = 5.0\n"});
  folder_.write("mid_gt.txt", "1 0 0 0.75 3\n2 0 0 0.5 3\n");
  expectIn(makeSource("uwbpose:" + path())->robotToml(), {"z_m = 0.75 }"});
}

// Of several tags the readings of each are a sensor; a bias does not change how far they reach.
TEST_F(BeaconWorlds, UwbPoseHasASensorForEachTag) {
  folder_.write("README_source.md",
                "| Tag 0 | 1 | 2 | 0 |\n| Tag 1 | 3 | -4 | 0 |\n| Anchor 0 | 0 | 0 | 1 |\n");
  folder_.write("fast_ranges.txt", "1 0.25 7.5\n2 nan 0\n");
  const auto source = makeSource("uwbpose:" + path() + "?run=fast&range_bias_m=0.5");
  expectIn(
      source->robotToml(),
      {"name = \"uwbpose-fast\"", "pose = { x_m = 1.0, y_m = 2.0, z_m = 1.0 }", "model = \"tag1\"",
       "pose = { x_m = 3.0, y_m = -4.0, z_m = 1.0 }", "max_range_m = 8.0\n"});
  EXPECT_EQ(asText(readAll(*source)),
            (std::vector<std::string>{"1000000 tag0/landmarks/anchor0Distance 0",
                                      "1000000 tag1/landmarks/anchor0Distance 7000"}))
      << "a range is not negative";
}

TEST_F(BeaconWorlds, RohReachesHalfAMetreBeyondItsBeacons) {
  folder_.write("landmark.csv", "0, -1\r\n6, 2.5\r\n");
  const auto log = "roh:" + folder_.write("(X1.5,Y3.0).csv", "152,-122.5\n").string();
  EXPECT_EQ(worldOf(log),
            "[world]\nname = \"hall\"\nx_m = [-0.5, 6.5]\ny_m = [-1.5, 3.0]\n"
            "\n[[landmark]]\nkind = \"beacon\"\nidentity = 1\nposition_m = [0.0, -1.0]\n"
            "\n[[landmark]]\nkind = \"beacon\"\nidentity = 2\nposition_m = [6.0, 2.5]\n");
  expectIn(makeSource(log)->robotToml(), {"features = \"bearings\"", "identities = [1, 2]"});
}

// Places are in millimetres, their kind is what the plugin lrf_cylinders looks for.
TEST_F(BeaconWorlds, LegosCylindersStandInMetres) {
  folder_.write("robot_arena_landmarks.txt", "L C 1000 500 55\nL C 0 -500 55\n");
  folder_.write("r_motors.txt", "M 100 0 0 0 0 50\n");
  folder_.write("r_scan.txt", "S 200 3 100 2000 0\nS 450 3 1 2 3\nS 600 3 4 5 6\n");
  EXPECT_EQ(worldOf("lego:" + path("r")),
            "[world]\nname = \"hall\"\nx_m = [-0.5, 1.5]\ny_m = [-1.0, 1.0]\n"
            "\n[[landmark]]\nkind = \"cylinder\"\nidentity = 1\nposition_m = [1.0, 0.5]\n"
            "\n[[landmark]]\nkind = \"cylinder\"\nidentity = 2\nposition_m = [0.0, -0.5]\n");
  // The middle one of three beams points -0.06981317 rad aside, the first one 0.3515625 degrees
  // farther to the right. Periods are 0.25 s and 0.15 s; the upper one of two is the median.
  expectIn(makeSource("lego:" + path("r"))->robotToml(),
           {"name = \"r\"", "pose = { x_m = 0.03, y_m = 0.0, theta_deg = 0.0 }\nbeams = 3\n",
            "first_angle_deg = -4.351562\nangle_step_deg = 0.351563\nmax_range_m = 4.0\n",
            "period_s = 0.25\n", "localizes = false\n", "reads = \"laser/LRF/scan\""});
}

TEST_F(BeaconWorlds, MrclamReachesTwoMetresBeyondItsLandmarks) {
  folder_.write("Barcodes.dat", "1 5\n6 63\n7 81\n");
  folder_.write("Landmark_Groundtruth.dat", "6 1.0 2.0 0 0\n7 3.0 -1.0 0 0\n");
  folder_.write("Robot5_Odometry.dat", "10 1 0\n");
  folder_.write("Robot5_Measurement.dat", "10.5 63 2 0.5\n");
  const std::string log = "mrclam:" + path() + "?robot=5";
  EXPECT_EQ(worldOf(log),
            "[world]\nname = \"hall\"\nx_m = [-1.0, 5.0]\ny_m = [-3.0, 4.0]\n"
            "\n[[landmark]]\nkind = \"post\"\nidentity = 6\nposition_m = [1.0, 2.0]\n"
            "\n[[landmark]]\nkind = \"post\"\nidentity = 7\nposition_m = [3.0, -1.0]\n");
  const std::string list = makeSource(log)->robotToml();
  expectIn(list, {"name = \"mrclam5\"", "features = \"list\"", "identities = [6, 7]",
                  "max_range_m = 10.0", "range_bias_per_m_rad2 = -0.48"});
  // A range alone does not say how far aside it was taken, so the bias needs both.
  const std::string each = makeSource(log + "&features=each")->robotToml();
  expectIn(each, {"features = \"each\"", "bearing_sigma_deg = 1.2"});
  EXPECT_EQ(each.find("range_bias"), each.npos);
  EXPECT_EQ(each.find("feature = \"posts\""), each.npos);
}

}  // namespace
}  // namespace ortung
