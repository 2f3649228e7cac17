// Observations of MRPT that are made of readings: every number in MRPT's units and frames.
#include <gtest/gtest.h>
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRange.h>

#include <cmath>
#include <numbers>

#include "LogTesting.hpp"
#include "RawlogMaker.hpp"
#include "RawlogPrinter.hpp"
#include "ortung/base/HelperProgram.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;
using namespace mrpt::obs;
constexpr double kPi = std::numbers::pi;

/// The observation of @p reading after @p declaration.
template <class Observation>
std::shared_ptr<Observation> made(const std::string& declaration, const std::string& reading) {
  RawlogMaker maker;
  EXPECT_EQ(maker.observationOf(declaration), nullptr);
  return std::dynamic_pointer_cast<Observation>(maker.observationOf(reading));
}

// 2^31 is 0: (1.5, -0.25) m, 90 degrees; 0.3 m/s, -10 degrees/s, 0.05 m/s to the left.
TEST(RawlogMaker, OdometryHasItsPoseAndAllItsVelocities) {
  const auto odometry = made<CObservationOdometry>(
      "# odometry odometry/odometry/pose",
      "2500000 odometry/odometry/pose 7 2147485148 2147483398 27000 2147483948 2147482648 "
      "4294967295 2147483698");
  ASSERT_NE(odometry, nullptr);
  EXPECT_NEAR(odometry->odometry.x(), 1.5, 1e-9);
  EXPECT_NEAR(odometry->odometry.y(), -0.25, 1e-9);
  EXPECT_NEAR(odometry->odometry.phi(), kPi / 2, 1e-9);
  EXPECT_TRUE(odometry->hasVelocities);
  EXPECT_NEAR(odometry->velocityLocal.vx, 0.3, 1e-9);
  EXPECT_NEAR(odometry->velocityLocal.vy, 0.05, 1e-9);
  EXPECT_NEAR(odometry->velocityLocal.omega, -10 * kPi / 180, 1e-9);
  EXPECT_NEAR(mrpt::Clock::toDouble(odometry->timestamp), 2.5, 1e-6);
  EXPECT_EQ(odometry->sensorLabel, "odometry/odometry/pose");
}

// Beams from 0 to 90 degrees: MRPT has them on both sides of an axis that is turned by 45 degrees.
TEST(RawlogMaker, ScansLieOnBothSidesOfTheirAxis) {
  const auto scan = made<CObservation2DRangeScan>(
      "# scan laser/LRF/scan 0.5 -0.25 1.5707963267948966 0 0.7853981633974483 8",
      "1 laser/LRF/scan 3 1000 0 8001");
  ASSERT_NE(scan, nullptr);
  EXPECT_NEAR(scan->sensorPose.x(), 0.5, 1e-6);
  EXPECT_NEAR(scan->sensorPose.y(), -0.25, 1e-6);
  EXPECT_NEAR(scan->sensorPose.yaw(), 0.75 * kPi, 1e-6);
  EXPECT_NEAR(scan->aperture, kPi / 2, 1e-6);
  EXPECT_EQ(scan->maxRange, 8.0F);
  EXPECT_TRUE(scan->rightToLeft);
  ASSERT_EQ(scan->getScanSize(), 3u);
  EXPECT_EQ(scan->getScanRange(0), 1.0F);
  EXPECT_NEAR(scan->getScanRange(2), 8.001, 1e-6);
  EXPECT_TRUE(scan->getScanRangeValidity(0));
  EXPECT_FALSE(scan->getScanRangeValidity(1));
}

// 18000 is straight ahead, 27000 to the left, 9000 to the right.
TEST(RawlogMaker, LandmarksAreSeenWhereTheirWordsSay) {
  const auto marks = made<CObservationBearingRange>(
      "# landmarks camera/landmarks/posts 0.1 0.2 -1.5707963267948966 12.5 1.25",
      "1 camera/landmarks/posts 9 7 2500 18000 8 1000 27000 4294967295 500 9000");
  ASSERT_NE(marks, nullptr);
  EXPECT_NEAR(marks->sensorLocationOnRobot.x(), 0.1, 1e-6);
  EXPECT_NEAR(marks->sensorLocationOnRobot.y(), 0.2, 1e-6);
  EXPECT_NEAR(marks->sensorLocationOnRobot.yaw(), -kPi / 2, 1e-6);
  EXPECT_EQ(marks->maxSensorDistance, 12.5F);
  EXPECT_EQ(marks->fieldOfView_yaw, 1.25F);
  ASSERT_EQ(marks->sensedData.size(), 3u);
  EXPECT_EQ(marks->sensedData[0].landmarkID, 7);
  EXPECT_NEAR(marks->sensedData[0].range, 2.5, 1e-6);
  EXPECT_NEAR(marks->sensedData[0].yaw, 0.0, 1e-6);
  EXPECT_NEAR(marks->sensedData[1].yaw, kPi / 2, 1e-6);
  EXPECT_NEAR(marks->sensedData[2].yaw, -kPi / 2, 1e-6);
  EXPECT_EQ(marks->sensedData[2].landmarkID, INVALID_LANDMARK_ID) << "nobody knows which it is";
}

TEST(RawlogMaker, ConesAreRangesFromTheirMount) {
  const auto cone = made<CObservationRange>("# cone sonar/ultrasonic/s0 0.1 -0.2 3 0.35 4",
                                            "1 sonar/ultrasonic/s0 1 1250");
  ASSERT_NE(cone, nullptr);
  EXPECT_FLOAT_EQ(cone->sensorConeApperture, 0.35F);
  EXPECT_EQ(cone->maxSensorDistance, 4.0F);
  ASSERT_EQ(cone->sensedData.size(), 1u);
  EXPECT_NEAR(cone->sensedData[0].sensedDistance, 1.25, 1e-6);
  EXPECT_NEAR(cone->sensedData[0].sensorPose.x, 0.1, 1e-9);
  EXPECT_NEAR(cone->sensedData[0].sensorPose.y, -0.2, 1e-9);
  EXPECT_NEAR(cone->sensedData[0].sensorPose.yaw, 3.0, 1e-9);
}

TEST(RawlogMaker, SaysWhatIsWrongWithALine) {
  RawlogMaker maker;
  EXPECT_EQ(maker.observationOf("# whatever it is"), nullptr);
  EXPECT_EQ(errorOf([&] { maker.observationOf("# scan a/b/c 1 2 3 4 5"); }),
            "found '# scan a/b/c 1 2 3 4 5', expected 6 numbers in it");
  EXPECT_EQ(errorOf([&] { maker.observationOf("# cone a/b/c 1 2 x 4 5"); }),
            "found '# cone a/b/c 1 2 x 4 5', expected 5 numbers in it");
  EXPECT_EQ(errorOf([&] { maker.observationOf("1 a/b/c 1 2"); }),
            "found a reading of a/b/c, which was not declared");
  EXPECT_NE(errorOf([&] { maker.observationOf("no reading"); }), "");
}

// MRPT counts from the year 1601 on, in steps of 100 ns.
TEST(RawlogMaker, TimesOutsideOfMrptsAreRefused) {
  RawlogMaker maker;
  maker.observationOf("# odometry o/o/p");
  const auto at = [&](const std::string& stamp) {
    return errorOf([&] {
      maker.observationOf(stamp +
                          " o/o/p 5 2147483648 2147483648 18000 2147483648 "
                          "2147483648");
    });
  };
  EXPECT_EQ(at("-11644473599999999"), "");
  EXPECT_EQ(at("-11644473600000000"), "the time -11644473600000000 us can't be written as MRPT's");
  EXPECT_EQ(at("910692730085477580"), "");
  EXPECT_EQ(at("910692730085477581"), "the time 910692730085477581 us can't be written as MRPT's");
}

// What one program writes the other one reads: the words, the mounts and the stamps are the same.
TEST(MrptWriter, WritesWhatTheReaderReads) {
  const TemporaryFolder folder;
  const std::string readings =
      "1000000 odometry/odometry/pose 5 2147485148 2147483398 27000 2147483648 2147483648\n"
      "1000000 laser/LRF/scan 3 1000 0 2500\n"
      "1500000 camera/landmarks/posts 6 7 2500 18000 8 1000 20865\n";
  const auto lines = folder.write("lines",
                                  "# odometry odometry/odometry/pose\n"
                                  "# scan laser/LRF/scan 0.5 0 0 -0.5 0.5 8\n"
                                  "# landmarks camera/landmarks/posts 0.25 0 0.5 12.5 1.25\n" +
                                      readings);
  const std::string log = (folder.path() / "a.rawlog").string();
  EXPECT_EQ(runHelper(findHelper("ortung-mrpt-writer", ""), {"rawlog", lines.string(), log},
                      "writer", 1 << 16),
            "3\n");
  EXPECT_EQ(runHelper(findHelper("ortung-mrpt-reader", ""), {"rawlog", log}, "reader", 1 << 16),
            "# ortung-mrpt-reader 1\n"
            "1000000 odometry/odometry/pose 5 2147485148 2147483398 27000 2147483648 2147483648\n"
            "# scanner 0.5 0 0 -0.5 0.5 8 3\n1000000 laser/LRF/scan 3 1000 0 2500\n"
            "# landmarks 0.25 0 0.5 12.5 1.25\n"
            "1500000 camera/landmarks/posts 6 7 2500 18000 8 1000 20865\n# end 3\n");
}

TEST(MrptWriter, CopiesAGridCellByCell) {
  const TemporaryFolder folder;
  std::string cells(3 * 2, '\0');
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = static_cast<char>(51 * i);
  const std::string head = "ortung-gridmap 3 2 0.5 -1 2\n";
  const auto write = [&](const std::string& bytes) {
    return runHelper(
        findHelper("ortung-mrpt-writer", ""),
        {"gridmap", folder.write("grid", bytes).string(), (folder.path() / "a.gridmap").string()},
        "writer", 1 << 16);
  };
  EXPECT_EQ(write(head + cells), "1\n");
  const std::string back =
      runHelper(findHelper("ortung-mrpt-reader", ""),
                {"gridmap", (folder.path() / "a.gridmap").string()}, "reader", 1 << 16);
  ASSERT_EQ(back.substr(0, head.size()), head);
  ASSERT_EQ(back.size(), head.size() + cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)  // MRPT keeps the logarithm of the odds
    EXPECT_NEAR(static_cast<unsigned char>(back[head.size() + i]),
                static_cast<unsigned char>(cells[i]), 3)
        << i;
  const auto complaint = [&](const std::string& bytes) { return errorOf([&] { write(bytes); }); };
  EXPECT_TRUE(complaint(head + cells.substr(1)).ends_with(": the grid is torn"));
  EXPECT_TRUE(complaint("ortung-grid 3 2 0.5 -1 2\n" + cells).ends_with(": found no grid"));
  EXPECT_TRUE(complaint("ortung-gridmap 0 2 0.5 -1 2\n").ends_with(": found no grid"));
}

}  // namespace
}  // namespace ortung
