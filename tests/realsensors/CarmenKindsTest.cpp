/// Of which kind a log of CARMEN is, and what its messages say of the scanner.

#include "LogTesting.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;
using Texts = std::vector<std::string>;

const std::string kOdometry = "odometry/odometry/pose";
const std::string kTruth = "reference/groundTruth/pose";

class CarmenKinds : public ::testing::Test {
 protected:
  std::string text(const std::string& bytes, const std::string& options = "") const {
    return "carmen:" + folder_.write("a.log", bytes).string() + options;
  }
  std::string path() const { return (folder_.path() / "a.log").string(); }
  /// A scan of one beam. @param pose of the laser @param robot of odometry
  static std::string scan(const std::string& pose, const std::string& robot, int second) {
    const std::string time = std::to_string(second);
    return "FLASER 1 1.5 " + pose + " " + robot + " " + time + " host " + time + "\n";
  }
  static std::string odometry(const std::string& pose, const std::string& time) {
    return "ODOM " + pose + " 0 0 0 " + time + " host " + time + "\n";
  }
  std::string robotOf(const std::string& log, const std::string& options = "") const {
    return makeSource(text(log, options))->robotToml();
  }
  TemporaryFolder folder_;
};

// 5 cm between the laser's pose and odometry's are more than rounding; what is exactly the mount
// is none.
TEST_F(CarmenKinds, PosesOffByMoreThanFiveCentimetresAreCorrected) {
  const auto truths = [&](const std::string& pose, const std::string& robot) {
    return only(readAll(text(scan("0 0 0", "0 0 0", 1) + scan(pose, robot, 2))), kTruth).size();
  };
  EXPECT_EQ(truths("1.04 0 0", "1 0 0"), 0u);
  EXPECT_EQ(truths("1.06 0 0", "1 0 0"), 2u);
  EXPECT_EQ(truths("1 -0.06 0", "1 0 0"), 2u);
}

TEST_F(CarmenKinds, TheMountOfTheLaserIsNoCorrection) {
  const std::string mount = "PARAM robot_frontlaser_offset 0.5 host 0\n";
  // Looking along y, the laser is half a metre farther along y.
  const std::string log =
      mount + scan("0.5 0 0", "0 0 0", 1) + scan("1 1.5 1.5707963", "1 1 1.5707963", 2);
  EXPECT_TRUE(only(readAll(text(log)), kTruth).empty());
  EXPECT_NE(robotOf(log).find("x_m = 0.5, y_m = 0.0"), std::string::npos);
  // A corrected log has the pose of the laser itself, wherever that is on the robot.
  const std::string corrected = mount + scan("0 0 0", "0 0 0", 1) + scan("2 0 0", "1 0 0", 2);
  EXPECT_EQ(only(readAll(text(corrected)), kTruth).size(), 2u);
  EXPECT_NE(robotOf(corrected).find("x_m = 0.0, y_m = 0.0"), std::string::npos);
}

// The offset of another sensor is not the front laser's.
TEST_F(CarmenKinds, OtherParametersAreOthers) {
  const std::string log =
      "PARAM robot_rearlaser_offset 0.5 host 0\nPARAM x y\n" + scan("0 0 0", "0 0 0", 1);
  EXPECT_NE(robotOf(log).find("x_m = 0.0, y_m = 0.0"), std::string::npos);
  EXPECT_EQ(errorOf(text("PARAM robot_frontlaser_offset far host 0\n" + log)),
            path() +
                ":1: found 'far' in field 3, expected the offset of the front laser [m], a "
                "number in [-10, 10]");
}

// An ODOM line with time 0 behind a scan is a correction; before any scan it is not.
TEST_F(CarmenKinds, ALogThatBeginsAtTimeZeroIsNotChained) {
  const std::string log = odometry("1 2 0", "0") + scan("1 2 0", "1 2 0", 1) +
                          odometry("2 2 0", "2") + scan("2 2 0", "2 2 0", 2);
  const auto messages = readAll(text(log));
  EXPECT_TRUE(only(messages, kTruth).empty());
  EXPECT_EQ(asText(only(messages, kOdometry))[0],
            "1000000 odometry/odometry/pose 2147484648 2147485648 18000 2147483648 2147483648")
      << "as it stands, not from the origin on";
}

// Messages between the scan and the line that corrects do not hide that, if they are NEFF.
TEST_F(CarmenKinds, OnlyNeffStandsBetweenAScanAndItsCorrection) {
  const auto isChained = [&](const std::string& between) {
    const std::string log = scan("1 2 0", "1 2 0", 1) + between + odometry("1 2 0", "0") +
                            odometry("2 2 0", "2") + scan("2 2 0", "2 2 0", 2);
    return !only(readAll(text(log)), kTruth).empty();
  };
  EXPECT_TRUE(isChained(""));
  EXPECT_TRUE(isChained("NEFF 15\n"));
  EXPECT_FALSE(isChained("TRUEPOS 1 2 3\n"));
}

// 180 and 360 beams end one step before a half turn, 181 and 361 at it.
TEST_F(CarmenKinds, FrontLasersHaveHalfATurnWithOrWithoutItsLastBeam) {
  for (const auto& [beams, step] : {std::pair{1, "180.0"},
                                    {2, "90.0"},
                                    {3, "90.0"},
                                    {180, "1.0"},
                                    {181, "1.0"},
                                    {360, "0.5"},
                                    {361, "0.5"}}) {
    std::string log = "FLASER " + std::to_string(beams);
    for (int i = 0; i < beams; ++i) log += " 1";
    const std::string robot = robotOf(log + " 0 0 0 0 0 0 1 host 1\n");
    EXPECT_NE(robot.find("first_angle_deg = -90.0\nangle_step_deg = " + std::string(step) + "\n"),
              std::string::npos)
        << beams << robot;
  }
}

TEST_F(CarmenKinds, ScansKeepTheirNumberOfBeams) {
  const std::string first = scan("0 0 0", "0 0 0", 1);
  EXPECT_EQ(errorOf(text(first + "FLASER 2 1 1 0 0 0 0 0 0 2 host 2\n")),
            path() + ":2: found 2 beams, expected 1 as above");
  const std::string newer = "RAWLASER1 0 -1.5 3 1 20 0.01 0 2 1 2 0 1.0 host 1.0\n";
  EXPECT_EQ(errorOf(text(newer + "RAWLASER1 0 -1.5 3 1 20 0.01 0 1 1 0 2.0 host 2.0\n",
                         "?laser=RAWLASER1")),
            path() + ":2: found 1 beams, expected 2 as above");
}

TEST_F(CarmenKinds, NewerMessagesSayTheirAnglesAndTheirRange) {
  const std::string log = "RAWLASER1 0 -0.5 1.5 0.25 12.5 0.01 0 4 1 2 3 4 0 1.0 host 1.0\n";
  const std::string robot = robotOf(log, "?laser=RAWLASER1");
  EXPECT_NE(robot.find("beams = 4\nfirst_angle_deg = -28.64789\nangle_step_deg = 14.323945\n"
                       "max_range_m = 12.5\n"),
            std::string::npos)
      << robot;
  // Without a line of odometry there is none.
  EXPECT_EQ(asText(readAll(text(log, "?laser=RAWLASER1"))),
            (Texts{"1000000 laser/LRF/scan 1000 2000 3000 4000"}));
}

TEST_F(CarmenKinds, NewerMessagesSayWhatIsWrongWithThem) {
  const auto complaint = [&](const std::string& line) {
    const std::string error = errorOf(text(line + "\n", "?laser=RAWLASER1"));
    EXPECT_TRUE(error.starts_with(path() + ":1: found ")) << error;
    return error.substr(std::min(error.size(), path().size() + 10));
  };
  EXPECT_EQ(complaint("RAWLASER1 0 -10.5 3 1 20 0 0 1 1 0 1 host 1"),
            "'-10.5' in field 3, expected the first angle [rad], a number in [-10, 10]");
  EXPECT_EQ(complaint("RAWLASER1 0 0 3 11 20 0 0 1 1 0 1 host 1"),
            "'11' in field 5, expected the step of angles [rad], a number in [-10, 10]");
  EXPECT_EQ(complaint("RAWLASER1 0 0 3 1 0.05 0 0 1 1 0 1 host 1"),
            "'0.05' in field 6, expected the greatest range [m], a number in [0.1, 10000]");
  EXPECT_EQ(complaint("RAWLASER1 0 0 3 1 20 0 0 1 1 9999 1 host 1"),
            "'9999' in field 11, expected a number of remissions, a number in [0, 8192]");
  EXPECT_EQ(complaint("RAWLASER1 0 0 3 1 20 0 0 1 1 1 1 host 1"),
            "14 fields, expected 15: scanner, ranges, remissions, poses, time");
}

// The laser's pose in that of the robot, whichever way the robot looks: 0.2 m ahead, 0.1 m to the
// left, turned by a quarter to the left.
TEST_F(CarmenKinds, RobotLasersTellTheMountByTwoPoses) {
  const std::string robot = robotOf(
      "ROBOTLASER1 0 -1.5 3 1 20 0.01 0 1 1 0 0.9 2.2 3.14159265 1 2 1.57079633 0 0 0 0 0 1.0 host "
      "1.0\n",
      "?laser=ROBOTLASER1");
  const auto number = [&](const std::string& key) {
    return std::stod(robot.substr(robot.find(key + " = ") + key.size() + 3));
  };
  EXPECT_NEAR(number("x_m"), 0.2, 1e-6);
  EXPECT_NEAR(number("y_m"), 0.1, 1e-6);
  EXPECT_NEAR(number("theta_deg"), 90.0, 1e-6);
}

TEST_F(CarmenKinds, NamesTheLasersThatAreThereInstead) {
  const std::string log =
      "RLASER 1 1 0 0 0 0 0 0 1 host 1\nODOM 0 0 0 0 0 0 1 host 1\n"
      "ROBOTLASER1 x\nRLASER 1\n";
  EXPECT_EQ(errorOf(text(log)), path() +
                                    ": found no FLASER message but RLASER ROBOTLASER1, "
                                    "expected one; the option laser names another");
  EXPECT_NE(errorOf(text(log, "?laser=RLASER")).find("laser is 'RLASER', must be one of: FLASER"),
            std::string::npos)
      << errorOf(text(log, "?laser=RLASER"));
}

}  // namespace
}  // namespace ortung
