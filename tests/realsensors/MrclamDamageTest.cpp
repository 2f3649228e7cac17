/// What a run of MRCLAM refuses, and what of it is left out.

#include "LogTesting.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;
using Texts = std::vector<std::string>;

/// A small run of robot 1.
class MrclamDamage : public ::testing::Test {
 protected:
  MrclamDamage() {
    folder_.write("Barcodes.dat", "1 5\n6 63\n7 81\n9 17\n");
    folder_.write("Landmark_Groundtruth.dat", "6 1 2 0 0\n7 3 -1 0 0\n");
    folder_.write("Robot1_Odometry.dat", "10 1 0\n12 0 0\n");
    folder_.write("Robot1_Measurement.dat", "10.5 63 2 0.5\n");
  }
  std::string log(const std::string& options = "") const {
    return "mrclam:" + folder_.path().string() + options;
  }
  std::string errorWith(const std::string& name, const std::string& bytes) const {
    const std::string error = testing::errorWith(folder_, name, bytes, log());
    const std::string start = (folder_.path() / name).string();
    EXPECT_TRUE(error.starts_with(start + ":")) << error;
    return error.substr(std::min(error.size(), start.size() + 1));
  }
  TemporaryFolder folder_;
};

TEST_F(MrclamDamage, SubjectsUpToFiveAreRobotsAndNoLandmarks) {
  EXPECT_EQ(errorWith("Landmark_Groundtruth.dat", "5 1 2 0 0\n"),
            "1: found '5' in field 1, expected a landmark's subject, a number in [6, 1000000]");
  EXPECT_EQ(errorWith("Landmark_Groundtruth.dat", "6 1 2 0 0\n6 1 3 0 0\n"),
            "2: found subject 6 twice, expected each once");
  EXPECT_EQ(errorWith("Landmark_Groundtruth.dat", "6 1 2\n"),
            "1: found 3 fields, expected 5: subject, x, y and their standard deviations [m]");
}

TEST_F(MrclamDamage, VelocitiesAndSightingsStayWithinReason) {
  folder_.write("Robot1_Odometry.dat", "10 100 -100\n12 0 0\n");
  EXPECT_EQ(errorOf(log()), "");
  EXPECT_EQ(errorWith("Robot1_Odometry.dat", "10 1 -100.5\n"),
            "1: found '-100.5' in field 3, expected a velocity [rad/s], a number in [-100, 100]");
  folder_.write("Robot1_Odometry.dat", "10 1 0\n");
  EXPECT_EQ(errorWith("Robot1_Measurement.dat", "10 63 -0.5 0\n"),
            "1: found '-0.5' in field 3, expected a range [m], a number in [0, 1000]");
  EXPECT_EQ(errorWith("Robot1_Measurement.dat", "10 63 1 10.5\n"),
            "1: found '10.5' in field 4, expected a bearing [rad], a number in [-10, 10]");
  EXPECT_EQ(errorWith("Robot1_Measurement.dat", "10 6.5 1 0\n"),
            "1: found '6.5' in field 2, expected a barcode, a whole number in [0, 1000000]");
  EXPECT_EQ(errorWith("Robot1_Measurement.dat", "10 63 1\n"),
            "1: found 3 fields, expected 4: time [s], barcode, range [m], bearing [rad]");
}

// Subject 9 has a barcode but no place: it is nothing that the robot could use.
TEST_F(MrclamDamage, LandmarksWithoutAPlaceAreLeftOut) {
  folder_.write("Robot1_Measurement.dat", "10.5 17 1 0\n10.5 81 2.5 0\n11 17 1 0\n");
  EXPECT_EQ(
      asText(only(readAll(log("?latency_s=0")), "camera/landmarks/posts")),
      (Texts{"10500000 camera/landmarks/posts 7 2500 18000", "11000000 camera/landmarks/posts"}));
}

// 3.5 rad to the left are 2.7832 rad to the right: -159.46 degrees.
TEST_F(MrclamDamage, BearingsAreWrapped) {
  folder_.write("Robot1_Measurement.dat", "10.5 63 2 3.5\n");
  EXPECT_EQ(asText(only(readAll(log("?latency_s=-0.25")), "camera/landmarks/posts")),
            (Texts{"10750000 camera/landmarks/posts 6 2000 2054"}));
}

TEST_F(MrclamDamage, ALittleJitterMayBeAllowed) {
  folder_.write("Robot1_Odometry.dat", "10 1 0\n9.75 1 0\n12 0 0\n");
  EXPECT_NE(errorOf(log()), "");
  const auto odometry = only(readAll(log("?jitter_s=0.5")), "odometry/odometry/pose");
  ASSERT_EQ(odometry.size(), 3u);
  EXPECT_EQ(odometry[1].stamp, 10'000'001);
}

TEST_F(MrclamDamage, StandsHaveTheirTimeWithinTheirSpan) {
  EXPECT_EQ(errorWith("Robot1_SparseGroundtruth.dat", "11 11.5 12 1 2 0 3\n"),
            "1: found a time outside of its span, expected first <= time <= last");
  EXPECT_EQ(errorWith("Robot1_SparseGroundtruth.dat", "11 10.5 10.75 1 2 0 3\n"),
            "1: found a time outside of its span, expected first <= time <= last");
  EXPECT_EQ(errorWith("Robot1_SparseGroundtruth.dat", "11 11 11 1 2 0 3\n10.5 10 11 1 2 0 3\n"),
            "2: found a time before that of the line above, expected rising times");
  EXPECT_EQ(errorWith("Robot1_SparseGroundtruth.dat", "11 11 11 1 2 0\n"),
            "1: found 6 fields, expected 7: time, first, last time [s], x [m], y [m], theta "
            "[rad], landmarks seen");
}

// Vicon goes before the stands, and neither counts before and behind the odometry.
TEST_F(MrclamDamage, TheReferenceLastsAsLongAsTheOdometry) {
  folder_.write("Robot1_SparseGroundtruth.dat", "11 9 12.5 1 2 0 3\n");
  const std::string id = "reference/groundTruth/pose";
  EXPECT_EQ(asText(only(readAll(log()), id)),
            (Texts{"11000000 reference/groundTruth/pose 2147484648 2147485648 18000"}));
  folder_.write("Robot1_Groundtruth.dat", "9.999999 9 9 0\n10 1 0 0\n12 2 0 0\n12.000001 9 9 0\n");
  EXPECT_EQ(asText(only(readAll(log()), id)),
            (Texts{"10000000 reference/groundTruth/pose 2147484648 2147483648 18000",
                   "12000000 reference/groundTruth/pose 2147485648 2147483648 18000"}));
  EXPECT_EQ(errorWith("Robot1_Groundtruth.dat", "10 1 0\n"),
            "1: found 3 fields, expected 4: time [s], x [m], y [m], theta [rad]");
}

// Odometry that begins anywhere begins at the origin, and a second is a second at any time.
TEST_F(MrclamDamage, OdometryDoesNotDependOnWhenItBegins) {
  const auto wordsAt = [&](const std::string& second) {
    folder_.write("Robot1_Odometry.dat", second + ".0 0.5 0.25\n" + second + ".5 0 0\n");
    folder_.write("Robot1_Measurement.dat", "");
    const auto readings = only(readAll(log()), "odometry/odometry/pose");
    return std::pair(readings.at(0).words, readings.at(1).words);
  };
  EXPECT_EQ(wordsAt("0"), wordsAt("1248273000"));
}

}  // namespace
}  // namespace ortung
