#include "LogTesting.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/Words.hpp"
#include "ortung/realsensors/LogFile.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;
using Texts = std::vector<std::string>;

const std::string kBarcodes = "# subject barcode\n 1 5\n 6 63\n 7 81\n";
const std::string kLandmarks = "6 1.0 2.0 0.001 0.001\n7 3.0 -1.0 0.001 0.001\n";
const std::string kOdometry = "10.0 1.0 1.5707963267948966\n11.0 0.5 0.0\n12.0 0.0 0.0\n";
const std::string kMeasurement =
    "10.5 5 1.0 0.1\n10.5 63 2.0 0.5\n10.5 81 1.5 -0.5\n11.25 99 1.0 0.0\n11.5 81 1.25 3.0\n";

/// A run of one robot.
class MrclamSource : public ::testing::Test {
 protected:
  MrclamSource() {
    folder_.write("Barcodes.dat", kBarcodes);
    folder_.write("Landmark_Groundtruth.dat", kLandmarks);
    folder_.write("Robot2_Odometry.dat", kOdometry);
    folder_.write("Robot2_Measurement.dat", kMeasurement);
  }
  std::string text(const std::string& options = "") const {
    return "mrclam:" + path() + "?robot=2" + options;
  }
  std::string path() const { return folder_.path().string(); }
  TemporaryFolder folder_;
};

TEST_F(MrclamSource, IntegratesTheCommandedVelocitiesAlongArcs) {
  // A quarter of a circle of radius 2 / pi = 0.637 m to the left, then 0.5 m straight on.
  EXPECT_EQ(
      asText(only(readAll(text()), "odometry/odometry/pose")),
      (Texts{"10000000 odometry/odometry/pose 2147483648 2147483648 18000 2147484648 2147492648",
             "11000000 odometry/odometry/pose 2147484285 2147484285 27000 2147484148 2147483648",
             "12000000 odometry/odometry/pose 2147484285 2147484785 27000 2147483648 2147483648"}));
}

TEST_F(MrclamSource, GroupsLandmarksByImageAndLeavesOutRobotsAndMisreadBarcodes) {
  EXPECT_EQ(
      asText(only(readAll(text()), "camera/landmarks/posts")),
      (Texts{"10460000 camera/landmarks/posts 6 2000 20865 7 1500 15135",
             "11210000 camera/landmarks/posts", "11460000 camera/landmarks/posts 7 1250 35189"}));
}

TEST_F(MrclamSource, GivesEachLandmarkItsOwnFeaturesIfAsked) {
  const auto messages = readAll(text("&features=each"));
  EXPECT_TRUE(only(messages, "camera/landmarks/posts").empty());
  EXPECT_EQ(asText(only(messages, "camera/landmarks/post7Distance")),
            (Texts{"10460000 camera/landmarks/post7Distance 1500",
                   "11460000 camera/landmarks/post7Distance 1250"}));
  EXPECT_EQ(asText(only(messages, "camera/landmarks/post6Bearing")),
            (Texts{"10460000 camera/landmarks/post6Bearing 20865"}));
}

TEST_F(MrclamSource, MergesItsStreamsInTheOrderOfTime) {
  std::vector<Timestamp> stamps;
  for (const Message& message : readAll(text())) stamps.push_back(message.stamp);
  EXPECT_EQ(stamps,
            (std::vector<Timestamp>{10000000, 10460000, 11000000, 11210000, 11460000, 12000000}));
  stamps.clear();
  for (const Message& message : readAll(text("&latency_s=0.6"))) stamps.push_back(message.stamp);
  EXPECT_EQ(stamps,
            (std::vector<Timestamp>{9900000, 10000000, 10650000, 10900000, 11000000, 12000000}));
}

TEST_F(MrclamSource, TakesViconPosesWhileTheRobotRan) {
  folder_.write("Robot2_Groundtruth.dat", "9.0 9 9 0\n10.0 0.5 -0.25 1.5707963\n13.0 9 9 0\n");
  EXPECT_EQ(asText(only(readAll(text()), "reference/groundTruth/pose")),
            (Texts{"10000000 reference/groundTruth/pose 2147484148 2147483398 27000"}));
}

TEST_F(MrclamSource, TakesPosesOfStandingForTheirWholeSpan) {
  folder_.write("Robot2_SparseGroundtruth.dat",
                "11.1 11.0 11.5 1.0 2.0 0.0 3\n11.8 11.8 11.8 1.5 2.0 0.0 3\n");
  EXPECT_EQ(asText(only(readAll(text()), "reference/groundTruth/pose")),
            (Texts{"11000000 reference/groundTruth/pose 2147484648 2147485648 18000",
                   "11100000 reference/groundTruth/pose 2147484648 2147485648 18000",
                   "11500000 reference/groundTruth/pose 2147484648 2147485648 18000",
                   "11800000 reference/groundTruth/pose 2147485148 2147485648 18000"}));
}

TEST_F(MrclamSource, SaysWhichRobotHasNoOdometry) {
  EXPECT_EQ(
      errorOf("mrclam:" + path() + "?robot=4"),
      path() +
          "/Robot4_Odometry.dat: found no odometry of robot 4 in this run, expected one (it may"
          " end in .xz or .gz); the option robot chooses another robot");
}

TEST_F(MrclamSource, RefusesOptionsItDoesNotKnowOrThatAreOutOfRange) {
  EXPECT_NE(errorOf(text("&robots=1")).find("robots is not known here"), std::string::npos);
  EXPECT_NE(
      errorOf("mrclam:" + path() + "?robot=6").find("robot is \"6\", must be a number in [1, 5]"),
      std::string::npos);
  EXPECT_NE(errorOf("mrclam:" + path() + "?robot=one").find("robot is \"one\""), std::string::npos);
}

TEST_F(MrclamSource, NamesFileAndLineOfWhatIsWrong) {
  const auto with = [&](const char* name, const std::string& bytes) {
    folder_.write(name, bytes);
    return errorOf(text());
  };
  const std::string odometry = path() + "/Robot2_Odometry.dat";
  EXPECT_EQ(
      with("Robot2_Odometry.dat", "10 1 0\n11 nan 0\n"),
      odometry + ":2: found 'nan' in field 2, expected a velocity [m/s], a number in [-100, 100]");
  EXPECT_EQ(with("Robot2_Odometry.dat", "10 1 0\n11 1\n"),
            odometry + ":2: found 2 fields, expected 3: time [s], velocities [m/s] [rad/s]");
  EXPECT_EQ(with("Robot2_Odometry.dat", "10 1 0\n9.5 1 0\n"),
            odometry +
                ":2: found time 9.5 s after 10 s, expected time to run forwards, or back by at most"
                " jitter_s=0 s");
  EXPECT_EQ(with("Robot2_Odometry.dat", "10 1 0\n11 1 0.\n12 0.0"),
            odometry +
                ":3: found 2 fields, expected 3: time [s], velocities [m/s] [rad/s] (the file ends"
                " within this line)");
  folder_.write("Robot2_Odometry.dat", kOdometry);
  const std::string measurement = path() + "/Robot2_Measurement.dat";
  EXPECT_EQ(with("Robot2_Measurement.dat", "FLASER 1 2 3\n"),
            measurement +
                ":1: found 'FLASER' in field 1, expected a time [s], a number in [-10000000000, "
                "10000000000]");
  EXPECT_EQ(with("Robot2_Measurement.dat", "11 63 1 0\n10 63 1 0\n"),
            measurement + ":2: found a time before that of the line above, expected rising times");
  folder_.write("Robot2_Measurement.dat", kMeasurement);
  EXPECT_EQ(with("Barcodes.dat", "6 63\n7 63\n"),
            path() + "/Barcodes.dat:2: found barcode 63 twice, expected each once");
  EXPECT_EQ(with("Landmark_Groundtruth.dat", ""),
            path() + "/Landmark_Groundtruth.dat:1: found no landmark, expected at least one");
}

/// What is known of the real runs: counted with other tools.
struct KnownRun {
  const char* name;
  int robot;
  std::size_t odometry, images, truth;
};

TEST(MrclamData, HasAllReadingsOfTheRealRuns) {
  ORTUNG_NEED_DATA(data, "utias_mrclam");
  for (const auto& [name, robot, odometry, images, truth] :
       {KnownRun{"ds6", 1, 61785, 1234, 48561}, KnownRun{"ds6", 3, 61158, 2745, 56224},
        KnownRun{"ds1", 5, 100726, 5453, 0}, KnownRun{"ds2", 1, 121742, 5146, 0}}) {
    const auto messages =
        readAll("mrclam:" + (data / name).string() + "?robot=" + std::to_string(robot));
    EXPECT_EQ(only(messages, "odometry/odometry/pose").size(), odometry) << name << robot;
    EXPECT_EQ(only(messages, "camera/landmarks/posts").size(), images) << name << robot;
    if (truth == 0) continue;  // not counted
    EXPECT_EQ(only(messages, "reference/groundTruth/pose").size(), truth) << name << robot;
  }
}

TEST(MrclamData, SeesLandmarksWhereViconSaysTheyAre) {
  ORTUNG_NEED_DATA(data, "utias_mrclam/ds6");
  std::map<std::uint32_t, std::pair<double, double>> places;
  LogFile landmarks(data / "Landmark_Groundtruth.dat");
  while (landmarks.nextRecord()) {
    places[static_cast<std::uint32_t>(landmarks.number(0, "id"))] = {landmarks.number(1, "x"),
                                                                     landmarks.number(2, "y")};
  }
  for (int robot = 1; robot <= 5; ++robot) {
    PoseData truth({"reference", "groundTruth", "pose"});
    std::size_t near = 0;
    std::size_t all = 0;
    for (const Message& message :
         readAll("mrclam:" + data.string() + "?robot=" + std::to_string(robot))) {
      if (message.id == truth.id()) truth.setData(message.stamp, message.words);
      if (message.id.feature != "posts" || message.stamp - truth.stamp() > 100000) continue;
      for (std::size_t i = 0; i < message.words.size(); i += 3) {
        const Pose2 pose = truth.reading();
        const auto& [x, y] = places.at(message.words[i]);
        const double bearing = std::atan2(y - pose.y, x - pose.x) - pose.theta;
        ++all;
        near += std::abs(wrapAngle(words::toAngle(message.words[i + 2]) - bearing)) < 0.05;
      }
    }
    EXPECT_GT(all, 1000u) << robot;
    // README of the data: sigma 0.009 rad, 0.02 s of latency at up to 0.4 rad/s, own bias 0.014.
    EXPECT_GT(static_cast<double>(near) / static_cast<double>(all), 0.97) << robot;
  }
}

}  // namespace
}  // namespace ortung
