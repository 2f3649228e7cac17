#include "RoomRun.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/records/RecordWriter.hpp"
#include "ortung/run/Feeder.hpp"

namespace ortung::test {
namespace {

using Feeding = RoomRun;

TEST_F(Feeding, CountsReadingsOfFeaturesThatTheRobotLacks) {
  for (std::size_t i = 0; i < 3; ++i)
    moments[i].push_back({moments[i][0].stamp, {"gps", "GNSS", "fix"}, {7}});
  record("");
  const auto robot = openRobot(robotFile);
  RecordSource source(recordFile);
  Feeder feeder("run", source, robot->container);
  while (feeder.next()) {
  }
  EXPECT_EQ(feeder.unknown(), (std::map<std::string, std::size_t>{{"gps/GNSS/fix", 3}}));
}

TEST_F(Feeding, FillsTheContainerMomentByMoment) {
  const auto robot = openRobot(robotFile);
  RecordSource source(recordFile);
  Feeder feeder("run", source, robot->container);
  const SensorData* scanner = robot->container.find({.type = "LRF"});
  for (std::size_t i = 0; i < moments.size(); ++i) {
    ASSERT_TRUE(feeder.next());
    EXPECT_EQ(feeder.stamp(), moments[i][0].stamp);
    EXPECT_DOUBLE_EQ(feeder.seconds(), 0.1 * static_cast<double>(i));
    EXPECT_TRUE(std::ranges::equal(scanner->getData(), moments[i][1].words));
    ASSERT_TRUE(feeder.truth());
  }
  EXPECT_FALSE(feeder.next());
  EXPECT_DOUBLE_EQ(feeder.progress(), 1.0);
}

TEST_F(Feeding, WritesWhatPasses) {
  const auto robot = openRobot(robotFile);
  RecordSource source(recordFile);
  Feeder feeder("run", source, robot->container);
  RecordWriter copy(folder / "copy.rec", source.worldFingerprint());
  feeder.recordInto(copy);
  while (feeder.next()) {
  }
  copy.commit();
  EXPECT_EQ(readBytes(folder / "copy.rec"), readBytes(recordFile));
}

}  // namespace
}  // namespace ortung::test
