// What the program that links MRPT prints of objects made here.
#include <gtest/gtest.h>
#include <mrpt/core/Clock.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/serialization/CArchive.h>

#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <sstream>

#include "LogTesting.hpp"
#include "RawlogPrinter.hpp"
#include "ortung/base/HelperProgram.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;

using Objects = std::vector<std::shared_ptr<mrpt::serialization::CSerializable>>;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kEndless = std::numeric_limits<float>::infinity();

/// What a stream has written into memory.
struct Memory {
  ~Memory() { std::free(text); }
  char* text = nullptr;
  std::size_t size = 0;
};

/// What is printed of @p objects.
std::string printed(const Objects& objects) {
  Memory memory;
  {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(
        ::open_memstream(&memory.text, &memory.size), std::fclose);
    RawlogPrinter printer(out.get());
    for (const auto& object : objects) printer.print(*object);
    printer.finish();
  }
  return {memory.text, memory.size};
}

std::shared_ptr<mrpt::obs::CObservation2DRangeScan> scanOf(const std::vector<float>& ranges,
                                                           double seconds) {
  auto scan = std::make_shared<mrpt::obs::CObservation2DRangeScan>();
  scan->timestamp = mrpt::Clock::fromDouble(seconds);
  scan->aperture = 2.0F;
  scan->maxRange = 8.0F;
  scan->resizeScan(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    scan->setScanRange(i, ranges[i]);
    scan->setScanRangeValidity(i, true);
  }
  return scan;
}

TEST(RawlogPrinter, PassesOverScansWithoutBeams) {
  const auto empty = scanOf({}, 1.0);
  const auto scan = scanOf({1.0F, 2.0F, 3.0F}, 2.0);
  const std::string expected =
      "# scanner 0 0 0 -1 1 8 3\n2000000 laser/LRF/scan 3 1000 2000 3000\n";
  EXPECT_EQ(printed({empty, scan}), expected + "# skipped 1 scans without beams\n# end 1\n");
  EXPECT_EQ(printed({scan, empty, empty}), expected + "# skipped 2 scans without beams\n# end 1\n");
}

// MRPT says of a scan in which direction it goes; those of a record go counter-clockwise.
TEST(RawlogPrinter, TurnsScansRoundThatGoFromLeftToRight) {
  const auto scan = scanOf({1.0F, 2.0F, 3.0F}, 1.0);
  scan->setScanRangeValidity(2, false);
  scan->rightToLeft = false;
  EXPECT_EQ(printed({scan}),
            "# scanner 0 0 0 -1 1 8 3\n1000000 laser/LRF/scan 3 0 2000 1000\n# end 1\n");
}

TEST(RawlogPrinter, BeamsAreSpreadOverTheApertureHoweverFewThereAre) {
  EXPECT_TRUE(printed({scanOf({1.0F}, 1.0)}).starts_with("# scanner 0 0 0 -1 2 8 1\n"));
  EXPECT_TRUE(printed({scanOf({1.0F, 2.0F}, 1.0)}).starts_with("# scanner 0 0 0 -1 2 8 2\n"));
  EXPECT_TRUE(printed({scanOf(std::vector<float>(5, 1.0F), 1.0)})
                  .starts_with("# scanner 0 0 0 -1 0.5 8 5\n"));
}

// The scanner is the one that comes first; it is known by its label and its number of beams.
TEST(RawlogPrinter, PassesOverScansOfOtherScanners) {
  const auto first = scanOf({1.0F, 2.0F}, 1.0);
  const auto label = scanOf({3.0F, 4.0F}, 2.0);
  const auto beams = scanOf({5.0F, 6.0F, 7.0F}, 3.0);
  const auto again = scanOf({8.0F, 9.0F}, 4.0);
  for (const auto& scan : {first, beams, again}) scan->sensorLabel = "FRONT";
  label->sensorLabel = "REAR";
  EXPECT_EQ(printed({first, label, beams, again}),
            "# scanner 0 0 0 -1 2 8 2\n1000000 laser/LRF/scan 2 1000 2000\n"
            "4000000 laser/LRF/scan 2 8000 9000\n# skipped 2 scans of another scanner\n# end 2\n");
}

TEST(RawlogPrinter, RangesThatAreNoLengthsAreNotValid) {
  EXPECT_EQ(printed({scanOf({1.0F, kEndless, kNan, 0.0F, -1.0F, 2.0F}, 1.0)}),
            "# scanner 0 0 0 -1 0.4 8 6\n1000000 laser/LRF/scan 6 1000 0 0 0 0 2000\n# end 1\n");
  const auto beacons = std::make_shared<mrpt::obs::CObservationBeaconRanges>();
  const auto marks = std::make_shared<mrpt::obs::CObservationBearingRange>();
  beacons->timestamp = marks->timestamp = mrpt::Clock::fromDouble(1.0);
  beacons->maxSensorDistance = marks->maxSensorDistance = 30.0F;
  marks->fieldOfView_yaw = 2.0F;
  for (const float range : {kEndless, kNan, 0.0F, -1.0F, 4.0F}) {
    beacons->sensedData.emplace_back();
    beacons->sensedData.back().beaconID = 7;
    beacons->sensedData.back().sensedDistance = range;
    marks->sensedData.emplace_back();
    marks->sensedData.back().landmarkID = 3;
    marks->sensedData.back().range = range;
  }
  EXPECT_EQ(printed({beacons, marks}),
            "# beacons 0 0 0 30\n1000000 uwb/landmarks/beacon7Distance 1 4000\n"
            "# landmarks 0 0 0 30 2\n1000000 camera/landmarks/posts 3 3 4000 18000\n"
            "# skipped 4 ranges of unknown beacons, or of 0\n"
            "# skipped 4 sightings of unknown landmarks\n# end 2\n");
}

// A receiver of ranges has a place, and looks nowhere; it is told once.
TEST(RawlogPrinter, TellsWhereRangesOfBeaconsAreTaken) {
  const auto beacons = std::make_shared<mrpt::obs::CObservationBeaconRanges>();
  beacons->timestamp = mrpt::Clock::fromDouble(1.0);
  beacons->maxSensorDistance = 30.0F;
  beacons->sensedData.resize(2);
  for (auto& sensed : beacons->sensedData) {
    sensed.sensorLocationOnRobot = {0.25, -0.5, 1.5};
    sensed.beaconID = 1;
    sensed.sensedDistance = 2.0F;
  }
  const std::string range = "1000000 uwb/landmarks/beacon1Distance 1 2000\n";
  EXPECT_EQ(printed({beacons}), "# beacons 0.25 -0.5 0 30\n" + range + range + "# end 2\n");
}

/// Stamps of scans in frames that a log's clock puts at @p seconds [us].
std::vector<std::string> stampsOfFrames(const std::vector<double>& seconds) {
  Objects frames;
  for (const double at : seconds) {
    auto frame = std::make_shared<mrpt::obs::CSensoryFrame>();
    frame->insert(scanOf({1.0F}, at));
    frames.push_back(frame);
  }
  std::vector<std::string> stamps;
  std::istringstream text(printed(frames));
  for (std::string line; std::getline(text, line);)
    if (const auto end = line.find(" laser/"); end != line.npos)
      stamps.push_back(line.substr(0, end));
  return stamps;
}

// Less than a second back, the clock is taken to be coarse, and the frame comes 1 us after the last
// one. Farther back, it has been set: who reads the lines decides what that means.
TEST(RawlogPrinter, FramesOfACoarseClockAreToldApartAndAClockThatWasSetIsNotHidden) {
  using Texts = std::vector<std::string>;
  EXPECT_EQ(stampsOfFrames({10, 10, 10, 11}),
            (Texts{"10000000", "10000001", "10000002", "11000000"}));
  EXPECT_EQ(stampsOfFrames({10, 9.25, 12}), (Texts{"10000000", "10000001", "12000000"}));
  EXPECT_EQ(stampsOfFrames({10, 9}), (Texts{"10000000", "9000000"}));
  EXPECT_EQ(stampsOfFrames({10, 3, 4}), (Texts{"10000000", "3000000", "4000000"}));
}

/// A frame of one scan at @p seconds; without a stamp if that is below 0.
std::shared_ptr<mrpt::obs::CSensoryFrame> frameOf(double seconds) {
  auto frame = std::make_shared<mrpt::obs::CSensoryFrame>();
  const auto scan = scanOf({1.0F, 2.0F}, std::max(seconds, 0.0));
  if (seconds < 0.0) scan->timestamp = INVALID_TIMESTAMP;
  frame->insert(scan);
  return frame;
}

/// A movement by the wheels' increments.
std::shared_ptr<mrpt::obs::CActionCollection> moved(double x, double y, double phi) {
  mrpt::obs::CActionRobotMovement2D movement;
  movement.estimationMethod = mrpt::obs::CActionRobotMovement2D::emOdometry;
  movement.rawOdometryIncrementReading = mrpt::poses::CPose2D(x, y, phi);
  auto actions = std::make_shared<mrpt::obs::CActionCollection>();
  actions->insert(movement);
  return actions;
}

// 1 m ahead and a quarter to the left, then 0.5 m ahead: at (1, 0.5), looking along y.
TEST(RawlogPrinter, IncrementsOfOdometryAreAddedUpInTheRobotsFrame) {
  const std::string text =
      printed({moved(1, 0, M_PI / 2), frameOf(1), moved(0.5, 0, 0), frameOf(2)});
  EXPECT_EQ(text,
            "# scanner 0 0 0 -1 2 8 2\n1000000 laser/LRF/scan 2 1000 2000\n"
            "1000000 odometry/odometry/pose 5 2147484648 2147483648 27000 2147483648 2147483648\n"
            "2000000 laser/LRF/scan 2 1000 2000\n"
            "2000000 odometry/odometry/pose 5 2147484648 2147484148 27000 2147484148 2147483648\n"
            "# end 4\n");
}

// A frame with odometry of its own does not get that of the increments, too.
TEST(RawlogPrinter, OdometryOfAFrameGoesBeforeIncrements) {
  auto odometry = std::make_shared<mrpt::obs::CObservationOdometry>();
  odometry->timestamp = mrpt::Clock::fromDouble(1.0);
  odometry->odometry = mrpt::poses::CPose2D(-1.5, 0.25, -M_PI / 2);
  const auto frame = frameOf(1);
  frame->insert(odometry);
  EXPECT_EQ(printed({moved(1, 0, 0), frame}),
            "# scanner 0 0 0 -1 2 8 2\n1000000 laser/LRF/scan 2 1000 2000\n"
            "1000000 odometry/odometry/pose 5 2147482148 2147483898 9000 2147483648 2147483648\n"
            "# end 2\n");
}

TEST(RawlogPrinter, MovementsInSpaceAreSkipped) {
  auto actions = std::make_shared<mrpt::obs::CActionCollection>();
  actions->insert(mrpt::obs::CActionRobotMovement3D());
  EXPECT_EQ(printed({actions}), "# skipped 1 actions other than movements in the plane\n# end 0\n");
}

// Simulated logs have no stamps: their frames are a second apart.
TEST(RawlogPrinter, FramesWithoutStampsAreASecondApart) {
  const std::string scan = " laser/LRF/scan 2 1000 2000\n";
  const std::string pose =
      " odometry/odometry/pose 5 2147483648 2147483648 18000 2147483648 2147483648\n";
  EXPECT_EQ(printed({frameOf(-1), frameOf(-1)}), "# scanner 0 0 0 -1 2 8 2\n1000000" + scan +
                                                     "1000000" + pose + "2000000" + scan +
                                                     "2000000" + pose + "# end 4\n");
}

TEST(RawlogPrinter, StampsAreWithinReason) {
  for (const double seconds : {1.1e10, 2e10})
    EXPECT_EQ(errorOf([&] { printed({scanOf({1.0F}, seconds)}); }),
              "found an impossible time stamp");
}

TEST(RawlogPrinter, NumbersThatAreNoneAreRefusedByName) {
  const auto scan = scanOf({1.0F}, 1.0);
  scan->maxRange = kNan;
  EXPECT_EQ(errorOf([&] { printed({scan}); }), "found a number that is not finite");
  auto odometry = std::make_shared<mrpt::obs::CObservationOdometry>();
  odometry->timestamp = mrpt::Clock::fromDouble(1.0);
  for (const double x : {static_cast<double>(kEndless), 1e300, -1.1e6}) {
    odometry->odometry = mrpt::poses::CPose2D(x, 0, 0);
    EXPECT_EQ(printed({odometry}),
              "# skipped 1 poses of odometry that are no numbers or beyond 1000 km\n# end 0\n")
        << x;
  }
}

// The whole output, of classes of all libraries of MRPT that the program knows.
TEST(MrptReader, PrintsItsFormatTheReadingsWhatItPassedOverAndHowManyThereWere) {
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive << *scanOf({1.0F, 2.0F}, 1.0) << mrpt::obs::CObservationComment()
          << mrpt::obs::CObservationPointCloud() << *scanOf({3.0F, 4.0F}, 2.0);
  const std::string bytes(static_cast<const char*>(stream.getRawBufferData()),
                          stream.getTotalBytesCount());
  const TemporaryFolder folder;
  EXPECT_EQ(runHelper(findHelper("ortung-mrpt-reader", ""),
                      {"rawlog", folder.write("a.rawlog", bytes).string()}, "rawlog", 1 << 16),
            "# ortung-mrpt-reader 1\n# scanner 0 0 0 -1 2 8 2\n"
            "1000000 laser/LRF/scan 2 1000 2000\n2000000 laser/LRF/scan 2 3000 4000\n"
            "# skipped 1 mrpt::obs::CObservationComment\n"
            "# skipped 1 mrpt::obs::CObservationPointCloud\n# end 2\n");
}

/// A grid's bytes as MRPT writes them, with @p value in place of @p old.
std::string gridWith(float old, float value) {
  const mrpt::maps::COccupancyGridMap2D map(-3.0F, 3.0F, -2.0F, 4.0F, 0.25F);
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream) << map;
  std::string bytes(static_cast<const char*>(stream.getRawBufferData()),
                    stream.getTotalBytesCount());
  std::string pattern(sizeof old, '\0');
  std::memcpy(pattern.data(), &old, sizeof old);
  const std::size_t at = bytes.find(pattern);
  EXPECT_NE(at, bytes.npos);
  if (at != bytes.npos) std::memcpy(bytes.data() + at, &value, sizeof value);
  return bytes;
}

TEST(MrptReader, RefusesGridsWithoutAPlaceOrSize) {
  const TemporaryFolder folder;
  const auto print = [&](float old, float value) {
    const auto file = folder.write("a.gridmap", gridWith(old, value)).string();
    return runHelper(findHelper("ortung-mrpt-reader", ""), {"gridmap", file}, "grid", 1 << 22);
  };
  EXPECT_TRUE(print(-3.0F, -3.0F).starts_with("ortung-gridmap 24 24 0.25 -3 -2\n"));
  for (const auto& [old, value] :
       {std::pair{-3.0F, kNan}, std::pair{-3.0F, kEndless}, std::pair{-2.0F, kNan},
        std::pair{-2.0F, -kEndless}, std::pair{0.25F, kNan}, std::pair{0.25F, 0.0F},
        std::pair{0.25F, -0.25F}}) {
    const std::string error = errorOf([&, o = old, v = value] { print(o, v); });
    EXPECT_TRUE(error.starts_with("grid: ortung-mrpt-reader ended with status 1: "))
        << old << " " << value << ": " << error;
  }
}

}  // namespace
}  // namespace ortung
