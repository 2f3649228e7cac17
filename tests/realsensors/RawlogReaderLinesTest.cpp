/// What is made of each kind of line that ortung-mrpt-reader prints.

#include <cstdlib>

#include "LogTesting.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;
using Texts = std::vector<std::string>;

/// A script in place of the reader prints the lines of a test.
class RawlogReaderLines : public ::testing::Test {
 protected:
  RawlogReaderLines() { ::setenv("ORTUNG_LIBEXEC", folder_.path().c_str(), 1); }
  ~RawlogReaderLines() override { ::unsetenv("ORTUNG_LIBEXEC"); }
  std::string printing(const std::string& lines, const std::string& options = "") const {
    const auto program =
        folder_.write("ortung-mrpt-reader", "#!/bin/sh\ncat <<'END'\n" + lines + "END\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    return "rawlog:" + folder_.write("hall.rawlog", "").string() + options;
  }
  std::string robotOf(const std::string& lines, const std::string& options = "") const {
    return makeSource(printing(lines, options))->robotToml();
  }
  /// The error behind the file's name.
  std::string errorOf(const std::string& lines) const {
    const std::string error = ortung::testing::errorOf(printing(lines));
    const std::string start = (folder_.path() / "hall.rawlog").string() + ": ";
    EXPECT_TRUE(error.starts_with(start)) << error;
    return error.substr(std::min(error.size(), start.size()));
  }
  TemporaryFolder folder_;
};

const std::string kWhere = " of what ortung-mrpt-reader prints, expected ";
const std::string kPose = "5 odometry/odometry/pose 5 1 2 3 4 5\n";

TEST_F(RawlogReaderLines, LandmarksHaveTheirSensorsMountAndFieldOfView) {
  const std::string robot = robotOf(
      "# landmarks 0.25 -0.5 1.5707963267948966 12.5 1.0471975511965976\n"
      "1 camera/landmarks/posts 6 9 1000 18000 2 3000 18000\n"
      "2 camera/landmarks/posts 3 9 1000 18000\n# end 2\n");
  EXPECT_NE(robot.find("feature = \"posts\"\nfeatures = \"list\"\nkind = \"post\"\n"
                       "identities = [2, 9]\npose = { x_m = 0.25, y_m = -0.5, theta_deg = 90.0 }\n"
                       "max_range_m = 12.5\nfov_deg = "),
            std::string::npos)
      << robot;
  const std::size_t view = robot.find("fov_deg = ");
  EXPECT_NEAR(std::stod(robot.substr(view + 10)), 60.0, 1e-9);
}

TEST_F(RawlogReaderLines, WhatWasLeftOutAndTimesThatFallBackAreTold) {
  const auto source = makeSource(
      printing("5 odometry/odometry/pose 5 1 2 3 4 5\n3 odometry/odometry/pose 5 1 2 3 4 5\n"
               "# skipped 7 CObservationImage\n# skipped 2 scans without beams\n# end 2\n"));
  EXPECT_EQ(source->remark(),
            "7 CObservationImage: left out; 2 scans without beams: left out; 1 readings of "
            "odometry/odometry/pose have earlier times than those before them, and were put in "
            "the order of time");
}

TEST_F(RawlogReaderLines, ASensorIsOnItsRobot) {
  EXPECT_NE(errorOf("# scanner 1e6 0 0 -1 0.01 8 3\n# end 0\n")
                .find("expected one within 10 m of the robot's origin; the options laser_x"),
            std::string::npos);
  EXPECT_EQ(errorOf("# landmarks 0 -10.5 0 8 1\n# end 0\n"),
            "found a sensor that is farther from the robot in line 1" + kWhere + "one within 10 m");
}

// A range that is not known is 30 m, one of kilometres is 1000 m; a field of view of 0 is a turn,
// as is one of more than that, and the least one is 1 degree.
TEST_F(RawlogReaderLines, SightsAreWithinReason) {
  const auto robotWith = [&](const std::string& range, const std::string& view) {
    return robotOf("# landmarks 0 0 0 " + range + " " + view +
                   "\n1 camera/landmarks/posts 3 9 1000 18000\n# end 1\n");
  };
  for (const auto& [range, view, text] :
       {std::tuple{"0", "0", "max_range_m = 30.0\nfov_deg = 360.0\n"},
        {"-1", "-1", "max_range_m = 30.0\nfov_deg = 360.0\n"},
        {"5000", "7", "max_range_m = 1000.0\nfov_deg = 360.0\n"},
        {"999", "0.001", "max_range_m = 999.0\nfov_deg = 1.0\n"}})
    EXPECT_NE(robotWith(range, view).find(text), std::string::npos) << text;
}

TEST_F(RawlogReaderLines, BeaconsAreHeardAllAroundEvenWithoutAPlace) {
  const std::string robot = robotOf(
      "1 uwb/landmarks/beacon10Distance 1 5\n"
      "2 uwb/landmarks/beacon2Distance 1 5\n# end 2\n");
  EXPECT_NE(robot.find("kind = \"beacon\"\nidentities = [2, 10]\n"
                       "pose = { x_m = 0.0, y_m = 0.0, theta_deg = 0.0 }\nmax_range_m = 30.0\n"
                       "fov_deg = 360.0\n"),
            std::string::npos)
      << robot;
  EXPECT_EQ(robot.find("plugin = \"lrf\""), std::string::npos);
  EXPECT_EQ(robot.find("\"camera\""), std::string::npos);
}

TEST_F(RawlogReaderLines, TheFirstScannerCountsAndOptionsChangeIt) {
  const std::string lines =
      "# scanner 0.5 0 0 -1 1 8 2\n# scanner 9 9 9 -1 1 8 9\n"
      "1 laser/LRF/scan 2 1 2\n500001 laser/LRF/scan 2 1 2\n# end 2\n";
  const std::string robot = robotOf(lines, "?laser_y=0.75&max_range_m=4");
  EXPECT_NE(robot.find("x_m = 0.5, y_m = 0.75, theta_deg = 0.0 }\nbeams = 2\n"), robot.npos);
  EXPECT_NE(robot.find("max_range_m = 4.0\nperiod_s = 0.5\n"), robot.npos) << robot;
}

TEST_F(RawlogReaderLines, OtherCommentsAreRemarksAndNothingIsReadBehindTheEnd) {
  EXPECT_EQ(asText(readAll(printing("# skipped 3 images\n# whatever\n" + kPose +
                                    "# end 1\nnot a line at all\n"))),
            (Texts{"5 odometry/odometry/pose 1 2 3 4 5"}));
}

TEST_F(RawlogReaderLines, OtherFeaturesPassThroughInTheirOrder) {
  EXPECT_EQ(asText(readAll(printing("7 imu/imu/x 2 1 2\n" + kPose + "6 imu/imu/x 0\n# end 3\n"))),
            (Texts{"5 odometry/odometry/pose 1 2 3 4 5", "6 imu/imu/x", "7 imu/imu/x 1 2"}));
}

TEST_F(RawlogReaderLines, WordsThatDoNotFitTheirFeatureAreRefused) {
  EXPECT_EQ(errorOf("5 odometry/odometry/pose 4 1 2 3 4\n# end 1\n"),
            "found 4 words of odometry/odometry/pose in line 1" + kWhere + "5");
  EXPECT_EQ(errorOf("1 camera/landmarks/posts 4 1 2 3 4\n# end 1\n"),
            "found 4 words of camera/landmarks/posts in line 1" + kWhere + "4");
  for (const char* name :
       {"beaconDistance", "beacon-1Distance", "beacon1000001Distance", "beaconX"})
    EXPECT_EQ(errorOf(kPose + "1 uwb/landmarks/" + name + " 1 5\n# end 2\n"),
              "found '" + std::string(name) + "' in line 2" + kWhere + "beaconNDistance");
}

TEST_F(RawlogReaderLines, CommentsHaveTheirNumbersAndNoOthers) {
  EXPECT_EQ(errorOf("# beacons 0 0 0 30 1\n"),
            "found a comment of another length in line 1" + kWhere + "4 numbers");
  EXPECT_EQ(errorOf("# landmarks 0 0 0 30\n"),
            "found a comment of another length in line 1" + kWhere + "5 numbers");
  EXPECT_EQ(errorOf("# beacons 0 0 1000001 30\n"),
            "found '1000001' in line 1" + kWhere + "a number");
  EXPECT_EQ(errorOf(kPose + "# end\n"),
            "found a comment of another length in line 2" + kWhere + "1 numbers");
}

TEST_F(RawlogReaderLines, ALineThatDoesNotEndIsNotRead) {
  const auto program = folder_.write("ortung-mrpt-reader", "#!/bin/sh\nprintf '# end 0'\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const std::string log = folder_.write("hall.rawlog", "").string();
  EXPECT_EQ(ortung::testing::errorOf("rawlog:" + log),
            log + ": found its end in line 1" + kWhere + "a last line '# end COUNT'");
}

TEST_F(RawlogReaderLines, TheReferenceComesFromAFile) {
  folder_.write("ref.txt", "# t x y theta\n2 1.5 -2 1.5707963 0.99\n1.5 0 0 0\n");
  EXPECT_EQ(asText(only(readAll(printing(kPose + "# end 1\n", "?gt=ref.txt")),
                        "reference/groundTruth/pose")),
            (Texts{"2000000 reference/groundTruth/pose 2147485148 2147481648 27000",
                   "2000001 reference/groundTruth/pose 2147483648 2147483648 18000"}));
  const std::string file = (folder_.path() / "ref.txt").string();
  EXPECT_EQ(ortung::testing::errorOf(printing(kPose + "# end 1\n", "?gt=ref.txt&jitter_s=0.1")),
            file +
                ":3: found time 1.5 s after 2 s, expected time to run forwards, or back by at "
                "most jitter_s=0.1 s");
  folder_.write("ref.txt", "2 1.5 -2\n");
  EXPECT_EQ(ortung::testing::errorOf(printing(kPose + "# end 1\n", "?gt=ref.txt")),
            file + ":1: found 3 fields, expected 4: time [s], x [m], y [m], theta [rad]");
}

TEST_F(RawlogReaderLines, ItsWorldIsTheMapOfTheOptions) {
  const std::string lines = kPose + "# end 1\n";
  const auto world = folder_.path() / "w.toml";
  EXPECT_EQ(ortung::testing::errorOf([&] { makeSource(printing(lines))->writeWorld(world); }),
            (folder_.path() / "hall.rawlog").string() +
                ": a rawlog has no map; the option map=FILE names one");
  folder_.write("m.gridmap", "grid");
  folder_.write("b.txt", "4 1 2\n");
  makeSource(printing(lines, "?map=m.gridmap"))->writeWorld(world);
  EXPECT_EQ(readBytes(world),
            "[world]\nname = \"w\"\n\n[[grid]]\nmap = \"w.gridmap\"\n"
            "surface_depth_cells = 0.5\nmap_error_m = 0.02\n");
  makeSource(printing(lines, "?map=m.gridmap&beacons=b.txt"))->writeWorld(world);
  EXPECT_TRUE(readBytes(world).ends_with(
      "\n[[landmark]]\nkind = \"beacon\"\nidentity = 4\nposition_m = [1.0, 2.0]\n"));
}

}  // namespace
}  // namespace ortung
