#include <gtest/gtest.h>

#include <numbers>

#include "DeviceTable.hpp"

namespace ortung::app {
namespace {

TEST(DeviceTable, HasALineForEachDeviceWithItsFiguresInColumns) {
  DeviceStatus scanner;
  scanner.name = "sick_lms /dev/ttyUSB0";
  scanner.state = DeviceState::kRunning;
  scanner.readings = 1234;
  scanner.rate = 37.46;
  scanner.age = 0.0264;
  scanner.driftPpm = -12.4;
  scanner.openings = 1;
  DeviceStatus base;
  base.name = "base /dev/base";
  base.state = DeviceState::kAbsent;
  EXPECT_EQ(deviceTable({scanner, base}, std::nullopt),
            "device                           state     rate_Hz   age_ms  readings drift_ppm  \n"
            "sick_lms /dev/ttyUSB0            running      37.5       26      1234       -12  \n"
            "base /dev/base                   absent        0.0        -         0         -  \n");
}

std::string troublesOf(const DeviceStatus& status) {
  const std::string table = deviceTable({status}, std::nullopt);
  const std::string line = table.substr(table.find('\n') + 1);
  return line.substr(81, line.size() - 82);
}

TEST(DeviceTable, NamesTheReasonAndWhateverWentWrong) {
  DeviceStatus status;
  status.name = "lines";
  EXPECT_EQ(troublesOf(status), "");
  status.openings = 1;
  EXPECT_EQ(troublesOf(status), "") << "once is as it should be";
  status.openings = 2;
  EXPECT_EQ(troublesOf(status), "2 openings");
  status.refused = 3;
  status.repeated = 4;
  status.flooded = 5;
  status.late = 6;
  status.clockJumps = 7;
  EXPECT_EQ(troublesOf(status),
            "3 refused, 4 repeated, 5 too many, 6 late, 7 clock jumps, 2 openings");
  status.driftsTooMuch = true;
  EXPECT_TRUE(troublesOf(status).starts_with(
      "clock drifts by more than 1000 ppm, which is not followed, 3 refused"))
      << troublesOf(status);
  status.driftsTooMuch = false;
  status.reason = "a\x1B[2J";
  EXPECT_TRUE(troublesOf(status).starts_with("a\\x1b[2J, 3 refused")) << troublesOf(status);
}

TEST(DeviceTable, EndsWithThePoseIfThereIsOne) {
  PoseEstimate estimate;
  estimate.pose = {1.256, -0.5, -std::numbers::pi / 4};
  estimate.status = TrackStatus::kUncertain;
  const std::string table = deviceTable({}, estimate);
  EXPECT_EQ(table.substr(table.find('\n') + 1),
            "pose x 1.26 m, y -0.50 m, heading -45.0 degrees, uncertain\n");
  EXPECT_TRUE(deviceTable({}, estimate, 3.21).ends_with("uncertain, without odometry for 3.2 s\n"));
}

}  // namespace
}  // namespace ortung::app
