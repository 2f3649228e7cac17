/// Logs of beacons: plaza, uwbpose, roh, lego.

#include "LogTesting.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/Words.hpp"
#include "ortung/realsensors/LogSource.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;
using Texts = std::vector<std::string>;

/// A folder with a log of each kind.
class BeaconSources : public ::testing::Test {
 protected:
  BeaconSources() {
    folder_.write("plaza1_TL.txt", "# id x y\n5.000 -17.5 59\n6.000 22 23.5\n");
    folder_.write("plaza1_DR.txt", "1 0 0\n2 0.5 0\n3 0 1.5707963\n4 0.5 0\n");
    folder_.write("plaza1_TD.txt", "2.5 2.000 6.000 20.25\n3.5 2 5 10\n1.5 2 6 20\n");
    folder_.write("plaza1_GT.txt", "# add 3.141592654 to heading to match\n1 2 3 0\n");
    folder_.write("README_source.md",
                  "|  | X |\n| Tag 0 | -0.5 | 0.25 | 0 |\n| Tag 1 | 0.5 | 0.25 | 0 |\n"
                  "| Anchor 0 | -3 | 3 | 1.5 |\n| Anchor 1 | 3 | -3 | 1.25 |\n");
    folder_.write("mid_ranges.txt", "1 4 4.5 2 2.25\n1.5 nan 4.5 0 2\n");
    folder_.write("mid_gt.txt", "1 0 0 0.96 3.14\n1.25 0 0.1 0.96 3.14\n1.5 0 0.2 0.96 3.14\n");
    folder_.write("landmark.csv", "0, 0\r\n6, 0\r\n");
    folder_.write("(X1.5,Y3.0).csv", "152,-122.5\n-190 , 0.25\n");
  }
  std::string path(const std::string& name = "") const { return (folder_.path() / name).string(); }
  TemporaryFolder folder_;
};

TEST_F(BeaconSources, PlazaIntegratesWaysAndSortsLateRanges) {
  const auto messages = readAll("plaza:" + path());
  // 0.5 m ahead, a quarter turn to the left, 0.5 m ahead.
  EXPECT_TRUE(asText(only(messages, "odometry/odometry/pose"))
                  .back()
                  .starts_with("4000000 odometry/odometry/pose 2147484148 2147484148 27000"));
  EXPECT_EQ(asText(only(messages, "uwb/landmarks/beacon6Distance")),
            (Texts{"1500000 uwb/landmarks/beacon6Distance 20000",
                   "2500000 uwb/landmarks/beacon6Distance 20250"}));
  EXPECT_EQ(asText(only(messages, "reference/groundTruth/pose")),
            (Texts{"1000000 reference/groundTruth/pose 2147485648 2147486648 0"}))
      << "turned by half a turn, as the comment says";
}

TEST_F(BeaconSources, UwbPoseLeavesOutFailedRangesAndTakesTheHeadingOfTheWay) {
  const auto messages = readAll("uwbpose:" + path() + "?range_bias_m=0.5");
  EXPECT_EQ(asText(only(messages, "tag0/landmarks/anchor0Distance")),
            (Texts{"1000000 tag0/landmarks/anchor0Distance 3500"}));
  EXPECT_EQ(asText(only(messages, "tag0/landmarks/anchor1Distance")),
            (Texts{"1000000 tag0/landmarks/anchor1Distance 1500"}));
  EXPECT_EQ(only(messages, "tag1/landmarks/anchor1Distance").size(), 2u);
  EXPECT_EQ(asText(only(messages, "reference/groundTruth/pose")),
            (Texts{"1000000 reference/groundTruth/pose 2147483648 2147483648 27000",
                   "1250000 reference/groundTruth/pose 2147483648 2147483748 27000",
                   "1500000 reference/groundTruth/pose 2147483648 2147483848 27000"}))
      << "0.2 m to the left";
}

// Ticks of 0.349 mm, tracks 0.173 m apart; the reference is of the scanner, 30 mm ahead.
TEST_F(BeaconSources, LegoCountsTicksAndPutsTheReferenceBehindTheScanner) {
  folder_.write("robot_arena_landmarks.txt", "L C 1000 500 55\nL C 0 -500 55\n");
  folder_.write("r_motors.txt", "M 100 0 0 0 0 50\nM 300 1000 0 0 0 1050\n");
  folder_.write("r_scan.txt", "S 200 3 100 2000 0\n");
  folder_.write("r_reference.txt", "P 150 100 200\nP 250 100 300\n");
  const auto messages = readAll("lego:" + path("r") + "?latency_s=0.05");
  const auto odometry = asText(only(messages, "odometry/odometry/pose"));
  ASSERT_EQ(odometry.size(), 2u);
  EXPECT_TRUE(odometry[1].starts_with("300000 odometry/odometry/pose 2147483997 2147483648 18000"));
  EXPECT_EQ(asText(only(messages, "laser/LRF/scan")), (Texts{"150000 laser/LRF/scan 100 2000 0"}));
  EXPECT_EQ(asText(only(messages, "reference/groundTruth/pose"))[0],
            "150000 reference/groundTruth/pose 2147483748 2147483818 27000");
  const std::string toml = makeSource("lego:" + path("r"))->robotToml();
  EXPECT_NE(toml.find("identities = [1, 2]\nradius_m = 0.055\n"), toml.npos) << toml;
  folder_.write("r_scan.txt", "S 200 3 100 2000 0\nS 210 2 100 2000\n");
  EXPECT_NE(errorOf("lego:" + path("r")).find("r_scan.txt:2: found 2 beams, expected 3"),
            std::string::npos);
}

TEST_F(BeaconSources, RohStandsWhereItsNameSays) {
  const auto messages = readAll("roh:" + path("(X1.5,Y3.0).csv") + "?period_s=0.5");
  EXPECT_EQ(asText(only(messages, "beacons/landmarks/beacon1Bearing")),
            (Texts{"0 beacons/landmarks/beacon1Bearing 33200",
                   "500000 beacons/landmarks/beacon1Bearing 35000"}))
      << "152 and -190 = 170 degrees";
  EXPECT_EQ(asText(only(messages, "reference/groundTruth/pose")).front(),
            "0 reference/groundTruth/pose 2147485148 2147486648 27000");
}

TEST_F(BeaconSources, SayWhatIsWrongAndWhere) {
  const auto expect = [&](const std::string& file, const std::string& bytes,
                          const std::string& source, const Texts& parts) {
    const std::string before = readBytes(path(file));
    folder_.write(file, bytes);
    const std::string error = errorOf(source);
    for (const std::string& part : parts)
      EXPECT_NE(error.find(part), std::string::npos) << part << " in: " << error;
    folder_.write(file, before);
  };
  const std::string plaza = "plaza:" + path();
  expect("plaza1_TD.txt", "1 2 7 5\n", plaza, {"plaza1_TD.txt:1", "beacon '7'", "5, 6"});
  expect("plaza1_TD.txt", "1 2 6 -5\n", plaza, {"plaza1_TD.txt:1", "'-5'", "a range [m]"});
  expect("plaza1_TL.txt", "5 1 1\n5 2 2\n", plaza, {"plaza1_TL.txt:2", "5 twice"});
  expect("plaza1_TL.txt", "5 1e9 1\n", plaza, {"plaza1_TL.txt:1", "x [m]"});
  const std::string uwb = "uwbpose:" + path();
  expect("mid_ranges.txt", "1 4 4.5 2\n", uwb, {"mid_ranges.txt:1", "4 fields", "5"});
  expect("mid_ranges.txt", "1 4 4.5 2 -nan\n", uwb, {"mid_ranges.txt:1", "'-nan'"});
  expect("README_source.md", "| Tag 1 | 0 | 0 | 0 |\n", uwb, {"README_source.md:1", "'1'", "0"});
  expect("README_source.md", "| Tag 0 | 0 | 0 | 0 |\n", uwb, {"1 tags and 0 anchors"});
  const std::string roh = "roh:" + path("(X1.5,Y3.0).csv");
  expect("(X1.5,Y3.0).csv", "152,,3\n", roh, {"(X1.5,Y3.0).csv:1", "3 fields", "2"});
  expect("(X1.5,Y3.0).csv", "152,\n", roh, {"(X1.5,Y3.0).csv:1", "''", "a bearing [deg]"});
  folder_.write("place.csv", "1,2\n");
  expect("place.csv", "1,2\n", "roh:" + path("place.csv"), {"'place.csv'", "(X1.5,Y3.0).csv"});
}

TEST(HeadingsOfWay, AreThoseBetweenPlacesAStepApart) {
  const std::vector<Pose2> places = {
      {0, 0, 0}, {0.05, 0, 0}, {0.2, 0, 0}, {0.2, 0.05, 0}, {0.2, 0.2, 0}};
  const std::vector<double> headings = headingsOfWay(places, 0.15);
  EXPECT_NEAR(headings[0], 0.0, 1e-12);
  EXPECT_NEAR(headings[1], 0.0, 1e-12);
  for (std::size_t i = 2; i < 5; ++i) EXPECT_NEAR(headings[i], 1.5707963, 1e-6) << i;
  EXPECT_TRUE(headingsOfWay({}, 0.15).empty());
}

}  // namespace
}  // namespace ortung
