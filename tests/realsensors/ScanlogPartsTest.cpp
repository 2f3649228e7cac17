/// Branches of plain text logs: comments, options, and where a map is looked for.

#include "LogTesting.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;
using Texts = std::vector<std::string>;

class ScanlogParts : public ::testing::Test {
 protected:
  std::string text(const std::string& options = "") const {
    return "scanlog:" + folder_.path().string() + options;
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  /// The robot file of a log with this comment and one scan of two beams.
  std::string robotOf(const std::string& comment, const std::string& options = "") const {
    folder_.write("scans.txt", comment + "\n1 0 0 0 2 5 6\n");
    return makeSource(text(options))->robotToml();
  }
  TemporaryFolder folder_;
};

TEST_F(ScanlogParts, CommentsOverSeveralLinesAreOne) {
  const std::string robot =
      robotOf("# ANGLES 0.5 0.25 rad\n# sensor at x=+1.5 m y=-2e-1 yaw=7\n# max range 4.5 m");
  EXPECT_NE(robot.find("x_m = 1.5, y_m = -0.2, theta_deg = "), std::string::npos) << robot;
  EXPECT_NE(robot.find("max_range_m = 4.5\n"), std::string::npos) << robot;
  // 7 rad are 41.070457 degrees more than a turn.
  EXPECT_NE(robot.find("theta_deg = 41.070457"), std::string::npos) << robot;
}

TEST_F(ScanlogParts, WhatACommentDoesNotSayIsZero) {
  const std::string robot = robotOf("# ANGLES 0 0.5 ; y=9 yaw=1");
  EXPECT_NE(robot.find("x_m = 0.0, y_m = 0.0, theta_deg = 0.0"), std::string::npos)
      << "a mount begins with ' at x=':\n"
      << robot;
  EXPECT_NE(robot.find("max_range_m = 30.0\n"), std::string::npos);
  EXPECT_NE(robotOf("# ANGLES 0 0.5 ; sensor at x=1").find("x_m = 1.0, y_m = 0.0, theta_deg = 0.0"),
            std::string::npos);
}

// A comment between scans does not change the scanner.
TEST_F(ScanlogParts, TheCommentAboveTheFirstScanCounts) {
  folder_.write("scans.txt", "# ANGLES 0 0.5\n1 0 0 0 1 5\n# ANGLES 1 1\n2 0 0 0 1 5\n");
  const std::string robot = makeSource(text())->robotToml();
  EXPECT_NE(robot.find("first_angle_deg = 0.0\n"), std::string::npos) << robot;
}

TEST_F(ScanlogParts, ALineWithoutARangeIsNone) {
  folder_.write("scans.txt", "# ANGLES 0 0.5\n1 0 0 0\n");
  EXPECT_EQ(errorOf(text()),
            path("scans.txt") + ":2: found 4 fields, expected 6: time, odometry, n, ranges");
}

TEST_F(ScanlogParts, PeriodsNeedAPoseOfEachKindForEachScan) {
  folder_.write("scans.txt", "# ANGLES 0 0.5\n1 0 0 0 1 5\n2 0 0 0 1 5\n");
  folder_.write("odom.txt", "1 0 0 0\n");
  EXPECT_EQ(errorOf(text("?odom=odom.txt&period_s=1")),
            folder_.path().string() +
                ": found 1 poses of an odometry of its own for 2 scans, expected one a scan, since "
                "the stamps of the scans are not used (they do not change, or the option period_s "
                "is set)");
  EXPECT_NE(errorOf(text("?period_s=0.0005")).find("period_s"), std::string::npos);
  EXPECT_NE(errorOf(text("?jitter_s=3601")).find("jitter_s"), std::string::npos);
}

// One scan in ten may share the stamp of the one before; two in eleven are too many.
TEST_F(ScanlogParts, StampsThatStandStillNowAndThenAreKept) {
  std::string lines = "# ANGLES 0 0.5\n";
  for (int i = 0; i < 9; ++i) lines += std::to_string(10 + 5 * i) + " 0 0 0 1 5\n";
  folder_.write("scans.txt", lines + "50 0 0 0 1 5\n");
  EXPECT_EQ(readAll(text()).back().stamp, 50'000'001);
  folder_.write("scans.txt", lines + "50 0 0 0 1 5\n50 0 0 0 1 5\n");
  EXPECT_EQ(readAll(text()).back().stamp, 20'000'000) << "10 s behind the first one";
}

TEST_F(ScanlogParts, CommandsOfADamagedFileAreRefused) {
  folder_.write("scans.txt", "# ANGLES 0 0.5\n1 0 0 0 1 5\n");
  const auto complaint = [&](const std::string& line) {
    folder_.write("cmd.txt", line + "\n");
    return errorOf(text("?commands=cmd.txt"));
  };
  EXPECT_EQ(complaint("1 100 -100"), "");
  EXPECT_EQ(complaint("1 100.5 0"), path("cmd.txt") +
                                        ":1: found '100.5' in field 2, expected a velocity [m/s], "
                                        "a number in [-100, 100]");
  EXPECT_EQ(complaint("1 0 -101"), path("cmd.txt") +
                                       ":1: found '-101' in field 3, expected a velocity [rad/s], "
                                       "a number in [-100, 100]");
  EXPECT_EQ(complaint("1 0"),
            path("cmd.txt") +
                ":1: found 2 fields, expected 3: time [s], commanded velocities [m/s] [rad/s]");
}

TEST_F(ScanlogParts, ReflectorsAndTheirPlacesBelongTogether) {
  folder_.write("scans.txt", "# ANGLES 0 0.5\n1 0 0 0 1 5\n");
  folder_.write("places.txt", "3 1.5 -2\n");
  folder_.write("refl.txt", "1 2 0.5\n");
  const std::string both =
      ": found one of the options reflectors and reflector_map, expected both "
      "or none";
  EXPECT_EQ(errorOf(text("?reflector_map=places.txt")), folder_.path().string() + both);
  const auto complaint = [&](const std::string& name, const std::string& line) {
    const std::string error = errorWith(folder_, name, line + "\n",
                                        text("?reflectors=refl.txt&reflector_map=places.txt"));
    EXPECT_TRUE(error.empty() || error.starts_with(path(name) + ":1: found ")) << error;
    return error.substr(std::min(error.size(), path(name).size() + 10));
  };
  EXPECT_EQ(complaint("places.txt", "3 1"), "2 fields, expected 3: identity, x, y [m]");
  EXPECT_EQ(complaint("places.txt", "-3 1 1"),
            "'-3' in field 1, expected an identity, a number in [0, 1000000]");
  EXPECT_EQ(complaint("refl.txt", "1 2"),
            "2 fields, expected 3: time [s], range [m], bearing [rad]");
  EXPECT_EQ(complaint("refl.txt", "1 2 -10.5"),
            "'-10.5' in field 3, expected a bearing [rad], a number in [-10, 10]");
  EXPECT_EQ(complaint("refl.txt", "1 1000.5 0"),
            "'1000.5' in field 2, expected a range [m], a number in [0, 1000]");
}

// With a map, the world has the reflectors at their places.
TEST_F(ScanlogParts, AWorldHasItsReflectors) {
  folder_.write("scans.txt", "# ANGLES 0 0.5\n1 0 0 0 1 5\n");
  folder_.write("places.txt", "3 1.5 -2\n");
  folder_.write("refl.txt", "1 0.5 0\n");
  folder_.write("map.yaml", "image: m.pgm\n");
  folder_.write("m.pgm", "P5\n1 1\n255\na");
  folder_.write("out/keep", "");
  const auto with = makeSource(text("?reflectors=refl.txt&reflector_map=places.txt"));
  with->writeWorld(folder_.path() / "out/w.toml");
  EXPECT_TRUE(readBytes(folder_.path() / "out/w.toml")
                  .ends_with("\n[[landmark]]\nkind = \"reflector\"\nidentity = 3\n"
                             "position_m = [1.5, -2.0]\n"));
  EXPECT_NE(with->robotToml().find("max_range_m = 1.0\nocclusion = false"), std::string::npos)
      << "no sighting is farther";
  makeSource(text())->writeWorld(folder_.path() / "out/v.toml");
  EXPECT_EQ(readBytes(folder_.path() / "out/v.toml").find("landmark"), std::string::npos);
}

TEST_F(ScanlogParts, AMapIsLookedForInTheFolderAndTwoAbove) {
  const TemporaryFolder out;
  const auto imageOf = [&](const std::string& log) {
    makeSource("scanlog:" + path(log))->writeWorld(out.path() / "w.toml");
    return readBytes(out.path() / "w.pgm").back();
  };
  for (const char* log : {"x", "x/y", "x/y/z"})
    folder_.write(std::string(log) + "/scans.txt", "# ANGLES 0 0.5\n1 0 0 0 1 5\n");
  folder_.write("m.pgm", "P5\n1 1\n255\na");
  folder_.write("hall.yaml", "image: m.pgm\n");
  EXPECT_EQ(imageOf("x"), 'a');
  EXPECT_EQ(imageOf("x/y/"), 'a') << "a blank name at the end is no folder";
  EXPECT_EQ(errorOf([&] { imageOf("x/y/z"); }),
            path("x/y/z") + ": found no map, expected one; the option map=FILE names it");
  // Of several files map.yaml is taken, and without it none of them.
  folder_.write("other.yaml", "image: other.pgm\n");
  EXPECT_NE(errorOf([&] { imageOf("x/y"); }), "");
  folder_.write("n.pgm", "P5\n1 1\n255\nb");
  folder_.write("map.yaml", "image: n.pgm\n");
  EXPECT_EQ(imageOf("x/y"), 'b');
}

}  // namespace
}  // namespace ortung
