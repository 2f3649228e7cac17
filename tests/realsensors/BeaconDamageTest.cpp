/// What logs of beacons refuse, and where they say so.

#include "LogTesting.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;

/// A complete log of each kind, of which a test replaces one file.
class BeaconDamage : public ::testing::Test {
 protected:
  BeaconDamage() {
    folder_.write("plaza1_TL.txt", "5 -17.5 59\n6 22 23.5\n");
    folder_.write("plaza1_DR.txt", "1 0 0\n2 0.5 0\n");
    folder_.write("plaza1_TD.txt", "2.5 2 6 20.25\n");
    folder_.write("README_source.md", "| Tag 0 | 0 | 0 | 0 |\n| Anchor 0 | -3 | 3 | 1.5 |\n");
    folder_.write("mid_ranges.txt", "1 4\n");
    folder_.write("robot_arena_landmarks.txt", "L C 1000 500 55\nL C 0 -500 55\n");
    folder_.write("r_motors.txt", "M 100 0 0 0 0 0\nM 200 0 0 0 0 0\n");
    folder_.write("r_scan.txt", "S 200 1 100\n");
    folder_.write("landmark.csv", "0, 0\n6, 0\n");
    folder_.write("(X1,Y3).csv", "152,-122.5\n");
  }
  std::string path(const std::string& name = "") const { return (folder_.path() / name).string(); }
  /// The error of a log whose file @p name holds @p bytes, without the folder before it.
  std::string errorWith(const std::string& name, const std::string& bytes,
                        const std::string& source) const {
    const std::string error = testing::errorWith(folder_, name, bytes, source);
    const std::string start = path() + (path().ends_with('/') ? "" : "/");
    EXPECT_TRUE(error.empty() || error.starts_with(start)) << error;
    return error.empty() ? "" : error.substr(start.size());
  }
  TemporaryFolder folder_;
};

TEST_F(BeaconDamage, PlazaSaysWhichFileAndLineIsWrong) {
  const std::string log = "plaza:" + path();
  EXPECT_EQ(errorOf(log), "");
  EXPECT_EQ(errorWith("plaza1_TL.txt", "# none\n", log),
            "plaza1_TL.txt:2: found no beacon, expected at least one");
  EXPECT_EQ(errorWith("plaza1_TL.txt", "5.5 1 1\n", log),
            "plaza1_TL.txt:1: found '5.5' in field 1, expected a beacon's identity, a whole number "
            "in [0, 1000000]");
  EXPECT_EQ(errorWith("plaza1_TL.txt", "5 1\n", log),
            "plaza1_TL.txt:1: found 2 fields, expected 3: identity, x, y [m]");
  EXPECT_EQ(errorWith("plaza1_TL.txt", "5 1 -1000.5\n", log),
            "plaza1_TL.txt:1: found '-1000.5' in field 3, expected y [m], a number in "
            "[-1000, 1000]");
  EXPECT_EQ(errorWith("plaza1_DR.txt", "1 0 0\n2 100.5 0\n", log),
            "plaza1_DR.txt:2: found '100.5' in field 2, expected a distance travelled [m], a "
            "number in [-100, 100]");
  EXPECT_EQ(errorWith("plaza1_DR.txt", "1 0 10.5\n", log),
            "plaza1_DR.txt:1: found '10.5' in field 3, expected a turn [rad], a number in "
            "[-10, 10]");
  EXPECT_EQ(errorWith("plaza1_DR.txt", "3 0 0\n1 0 0\n", log),
            "plaza1_DR.txt:2: found time 1 s after 3 s, expected time to run forwards, or back by "
            "at most jitter_s=1 s");
  EXPECT_EQ(errorWith("plaza1_DR.txt", "3 0 0\n1 0 0\n", log + "?jitter_s=2"), "");
  EXPECT_EQ(errorWith("plaza1_TD.txt", "1 2 6 10000.5\n", log),
            "plaza1_TD.txt:1: found '10000.5' in field 4, expected a range [m], a number in "
            "[0, 10000]");
  EXPECT_EQ(errorWith("plaza1_GT.txt", "# add much to heading\n", log),
            "plaza1_GT.txt:1: found 'much' in field 3, expected an angle [rad], a number in "
            "[-10, 10]");
  EXPECT_EQ(errorWith("plaza1_GT.txt", "1 2 3\n", log),
            "plaza1_GT.txt:1: found 3 fields, expected 4: time [s], x [m], y [m], theta [rad]");
}

// A comment that only resembles the one that reverses headings does not.
TEST_F(BeaconDamage, PlazaTurnsHeadingsByItsCommentAlone) {
  for (const auto& [comment, heading] :
       {std::pair{"# add 1.5707963 to heading", "27000"}, std::pair{"# add 1.5 to x", "18000"},
        std::pair{"# sum 1.5 to heading", "18000"}, std::pair{"# add 1.5 per heading", "18000"},
        std::pair{"# then add -1.5707963 to heading please", "9000"}}) {
    folder_.write("plaza1_GT.txt", std::string(comment) + "\n1 0 0 0\n");
    EXPECT_TRUE(asText(only(readAll("plaza:" + path()), "reference/groundTruth/pose"))[0].ends_with(
        heading))
        << comment;
  }
}

TEST_F(BeaconDamage, UwbPoseSaysWhichFileAndLineIsWrong) {
  const std::string log = "uwbpose:" + path();
  EXPECT_EQ(errorOf(log), "");
  EXPECT_EQ(errorWith("README_source.md", "| Tag 0 | 9.5 | 0 | 0 |\n", log),
            "README_source.md:1: found '9.5' in field 5, expected x [m], a number in [-9, 9]");
  EXPECT_EQ(
      errorWith("README_source.md", "| Tag 0 | 0 | 0 | 0 |\n| Anchor 0 | 1 | 1 | -1 |\n", log),
      "README_source.md:2: found '-1' in field 9, expected z [m], a number in [0, 100]");
  EXPECT_EQ(errorWith("README_source.md", "| Anchor 1 | 1 | 1 | 1 |\n", log),
            "README_source.md:1: found '1', expected 0, the next one");
  EXPECT_EQ(errorWith("README_source.md", "| Anchor 64 | 1 | 1 | 1 |\n", log),
            "README_source.md:1: found '64' in field 3, expected a number, a number in [0, 63]");
  std::string tags;
  for (int i = 0; i < 17; ++i) tags += "| Tag " + std::to_string(i) + " | 0 | 0 | 0 |\n";
  EXPECT_EQ(errorWith("README_source.md", tags, log),
            "README_source.md:17: found more tags, expected at most 16");
  EXPECT_EQ(errorWith("mid_ranges.txt", "1 1000.5\n", log),
            "mid_ranges.txt:1: found '1000.5' in field 2, expected a range [m] or nan, a number in "
            "[0, 1000]");
  EXPECT_EQ(errorWith("mid_gt.txt", "1 0 0 10.5 3\n", log),
            "mid_gt.txt:1: found '10.5' in field 4, expected z [m], a number in [0, 10]");
  EXPECT_EQ(errorWith("mid_gt.txt", "1 0 0 0.5\n", log),
            "mid_gt.txt:1: found 4 fields, expected 5: time [s], x, y, z [m], yaw [rad]");
  EXPECT_EQ(errorOf("uwbpose:" + path() + "?run=slow"),
            path() +
                "slow_ranges.txt: found no such file, nor one with .xz or .gz behind its "
                "name, expected one of them");
}

TEST_F(BeaconDamage, TheOnlyRunIsReadWhateverItIsCalled) {
  for (const char* file : {"plaza1_TL.txt", "plaza1_DR.txt", "plaza1_TD.txt", "mid_ranges.txt"})
    std::filesystem::remove(path(file));
  EXPECT_EQ(errorOf("plaza:" + path()), path() + ": found no file NAME_TL.txt, expected one");
  EXPECT_EQ(errorOf("uwbpose:" + path()), path() + ": found no file NAME_ranges.txt, expected one");
  folder_.write("_TL.txt", "6 22 23.5\n");  // nobody's name
  folder_.write("yard.7_TL.txt", "6 22 23.5\n");
  folder_.write("yard.7_DR.txt", "1 0 0\n2 0.5 0\n");
  folder_.write("yard.7_TD.txt", "2.5 2 6 20.25\n");
  folder_.write("slow_ranges.txt", "1 4\n");
  EXPECT_EQ(errorOf("plaza:" + path()), "");
  EXPECT_EQ(errorOf("uwbpose:" + path()), "");
}

TEST_F(BeaconDamage, OfSeveralRunsOneMustBeNamed) {
  folder_.write("plaza2_TL.txt.xz", "");
  folder_.write("fast_ranges.txt.gz", "");
  EXPECT_EQ(
      errorOf("plaza:" + path()),
      path() + ": found the runs 'plaza1', 'plaza2', expected the option run to name one of them");
  EXPECT_EQ(errorOf("plaza:" + path() + "?run=plaza1"), "");
  EXPECT_EQ(errorOf("uwbpose:" + path()),
            path() + ": found the runs 'fast', 'mid', expected the option run to name one of them");
  EXPECT_EQ(errorOf("uwbpose:" + path() + "?run=mid"), "");
}

TEST_F(BeaconDamage, ALogWithoutAnyReadingIsNone) {
  folder_.write("mid_ranges.txt", "1 0\n2 nan\n");
  EXPECT_EQ(errorOf("uwbpose:" + path()), path() + ": found no reading, expected at least one");
}

TEST_F(BeaconDamage, LegoSaysWhichFileAndLineIsWrong) {
  const std::string log = "lego:" + path("r");
  EXPECT_EQ(errorOf(log), "");
  EXPECT_EQ(errorWith("robot_arena_landmarks.txt", "\n", log),
            "robot_arena_landmarks.txt:2: found no cylinder, expected at least one");
  EXPECT_EQ(errorWith("robot_arena_landmarks.txt", "L C 0 0 55\nL C 900 0 56\n", log),
            "robot_arena_landmarks.txt:2: found another radius, expected all cylinders to be as "
            "wide as the first one");
  EXPECT_EQ(errorWith("robot_arena_landmarks.txt", "L C 0 0 4\n", log),
            "robot_arena_landmarks.txt:1: found '4' in field 5, expected a radius [mm], a number "
            "in [5, 5000]");
  EXPECT_EQ(errorWith("robot_arena_landmarks.txt", "L C 100001 0 55\n", log),
            "robot_arena_landmarks.txt:1: found '100001' in field 3, expected x [mm], a number in "
            "[-100000, 100000]");
  EXPECT_EQ(errorWith("r_motors.txt", "M 100 0 0 0 0\n", log),
            "r_motors.txt:1: found 6 fields, expected 7: 'M', time [ms], ticks");
  // 10 m are 28653.3 ticks.
  EXPECT_EQ(errorWith("r_motors.txt", "M 1 0 0 0 0 0\nM 2 28653 0 0 0 -28653\n", log), "");
  for (const char* ticks : {"28654 0 0 0 0", "0 0 0 0 -28654"})
    EXPECT_EQ(errorWith("r_motors.txt", std::string("M 1 0 0 0 0 0\nM 2 ") + ticks + "\n", log),
              "r_motors.txt:2: found a step of more than 10 m, expected ticks that count on from "
              "line to line");
  EXPECT_EQ(errorWith("r_motors.txt", "M 1 0.5 0 0 0 0\n", log),
            "r_motors.txt:1: found '0.5' in field 3, expected ticks, a whole number in "
            "[-1099511627776, 1099511627776]");
  EXPECT_EQ(errorWith("r_scan.txt", "S 1\n", log),
            "r_scan.txt:1: found 2 fields, expected 4: 'S', time, n, ranges");
  EXPECT_EQ(errorWith("r_scan.txt", "S 1 2 100\n", log),
            "r_scan.txt:1: found 4 fields, expected 5: 'S', time, n, n ranges");
  EXPECT_EQ(errorWith("r_scan.txt", "S 1 1 -1\n", log),
            "r_scan.txt:1: found '-1' in field 4, expected a range [mm], a number in [0, 100000]");
  EXPECT_EQ(errorWith("r_scan.txt", "", log), "r_scan.txt:1: found no scan, expected at least one");
  EXPECT_EQ(errorWith("r_reference.txt", "P 1 2\n", log),
            "r_reference.txt:1: found 3 fields, expected 4: 'P', time [ms], x, y [mm]");
}

// Its clock counts milliseconds, which stay whole: 1 ms are 1000 us, and no jitter is forgiven.
TEST_F(BeaconDamage, LegosMillisecondsRunForwards) {
  folder_.write("r_scan.txt", "S 1200 1 100\nS 1201 1 100\n");
  EXPECT_EQ(asText(only(readAll("lego:" + path("r") + "?latency_s=0"), "laser/LRF/scan"))[1],
            "1201000 laser/LRF/scan 100");
  EXPECT_EQ(errorWith("r_scan.txt", "S 1200 1 1\nS 1199 1 1\n", "lego:" + path("r")),
            "r_scan.txt:2: found time 1.199 s after 1.2 s, expected time to run forwards, or back "
            "by at most jitter_s=0 s");
}

TEST_F(BeaconDamage, RohSaysWhichFileAndLineIsWrong) {
  const std::string log = "roh:" + path("(X1,Y3).csv");
  EXPECT_EQ(errorOf(log), "");
  EXPECT_EQ(errorWith("landmark.csv", "\n", log),
            "landmark.csv:2: found no beacon, expected at least one");
  EXPECT_EQ(errorWith("landmark.csv", "1\n", log),
            "landmark.csv:1: found 1 fields, expected 2: x, y [m]");
  EXPECT_EQ(errorWith("(X1,Y3).csv", "360.5,0\n", log),
            "(X1,Y3).csv:1: found '360.5' in field 1, expected a bearing [deg], a number in "
            "[-360, 360]");
  EXPECT_NE(errorOf(log + "?period_s=0").find("period_s"), std::string::npos);
}

TEST_F(BeaconDamage, RohsNamesHaveTwoNumbersInTheirBrackets) {
  for (const char* name : {"(X1,Y).csv", "(X,Y3).csv", "(X1,Y3.csv", "X1,Y3).csv", "(X1;Y3).csv",
                           "(X1000,Y3).csv", "(X1,Y-1000).csv", "(X1,Y3 ).csv", ").(X1,Y3.csv"})
    EXPECT_EQ(errorWith(name, "1,2\n", "roh:" + path(name)),
              std::string(name) + ": found the name '" + name +
                  "', expected one like '(X1.5,Y3.0).csv', the place of the robot");
  for (const char* name : {"(X-999.5,Y0).csv", "(X1,Y3)-2.csv"})
    EXPECT_EQ(errorWith(name, "1,2\n", "roh:" + path(name)), "") << name;
}

// The robot stands: one pose of odometry and one of the reference belong to each line.
TEST_F(BeaconDamage, RohStandsAsLongAsItsLinesLast) {
  folder_.write("(X-2.5,Y-1).csv", "0,0\n90,0\n-90,0\n");
  const auto messages = readAll("roh:" + path("(X-2.5,Y-1).csv") + "?period_s=0.25");
  EXPECT_EQ(
      asText(only(messages, "reference/groundTruth/pose")),
      (std::vector<std::string>{"0 reference/groundTruth/pose 2147481148 2147482648 27000",
                                "250000 reference/groundTruth/pose 2147481148 2147482648 27000",
                                "500000 reference/groundTruth/pose 2147481148 2147482648 27000"}));
  EXPECT_EQ(only(messages, "odometry/odometry/pose").size(), 3u);
  EXPECT_EQ(asText(only(messages, "beacons/landmarks/beacon1Bearing")),
            (std::vector<std::string>{"0 beacons/landmarks/beacon1Bearing 18000",
                                      "250000 beacons/landmarks/beacon1Bearing 27000",
                                      "500000 beacons/landmarks/beacon1Bearing 9000"}));
}

}  // namespace
}  // namespace ortung
