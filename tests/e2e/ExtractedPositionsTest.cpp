// Logs of real laser range finders fill `position` and `obstacles` as a simulated one does.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "Files.hpp"
#include "ortung/formats/ObstaclesData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/run/Feeder.hpp"
#include "ortung/run/OpenSource.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung::test {
namespace {

struct Found {
  std::size_t scans = 0;
  std::size_t withObstacles = 0;
  std::vector<double> errors;  ///< of the best of a scan's positions, rising [m]

  std::size_t within(double metres) const {
    return static_cast<std::size_t>(std::upper_bound(errors.begin(), errors.end(), metres) -
                                    errors.begin());
  }
};

/// Feeds a log to the robot that it describes, with lrf_iconic beside the scanner; the walls are
/// those of the log's map.
Found extract(const std::string& log) {
  const TemporaryFolder folder;
  PluginFactory factory(PluginFactory::standardFolders());
  const auto source = openSource("scanlog:" + log, "", factory);
  source->writeWorld(folder / "world.toml");
  const RobotConfig robot = readRobot(
      parseToml(source->robotToml() + "\n[[sensor]]\nplugin = 'lrf_iconic'\nreads = '*/LRF/scan'\n",
                "robot"));
  SensorContainer container;
  const auto devices = fillContainer(container, robot, factory);
  container.setField(std::make_shared<FieldModel>(fieldModelOf(*readWorld(folder / "world.toml"))));
  const auto* position = dynamic_cast<PoseFixData*>(container.find({.feature = "position"}));
  const auto* obstacles = dynamic_cast<ObstaclesData*>(container.find({.feature = "obstacles"}));
  Feeder feeder(log, *source, container);
  Found found;
  while (feeder.next()) {
    if (position->sequence() == found.scans) continue;
    found.scans = position->sequence();
    found.withObstacles += obstacles->reading().empty() ? 0 : 1;
    if (position->reading().empty() || !feeder.truth()) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (const PoseFixData::Fix& fix : position->reading())
      nearest = std::min(nearest, distance(fix.pose, *feeder.truth()));
    found.errors.push_back(nearest);
  }
  std::sort(found.errors.begin(), found.errors.end());
  return found;
}

/// Offices of several rooms: 158 of 342 scans had a position when this was written, 152 of them
/// right.
TEST(ExtractedPositions, OfARobotInOffices) {
  const std::string log = ORTUNG_SHARED_DATA "/mrpt_uwb_ro";
  if (!std::filesystem::is_directory(log)) GTEST_SKIP() << log << " is not here";
  const Found found = extract(log);
  EXPECT_GT(found.scans, 300u);
  EXPECT_GT(found.errors.size(), found.scans / 3);
  EXPECT_GE(found.within(0.3), found.errors.size() * 95 / 100);
  EXPECT_LT(found.errors.at(found.errors.size() / 2), 0.05);  // the reference proves 0.02 to 0.04 m
  EXPECT_GT(found.withObstacles, found.scans / 2);            // furniture, people
}

/// A laboratory whose outlines are mostly furniture: few scans have a position, all of them right.
TEST(ExtractedPositions, OfARobotInALaboratory) {
  const std::string log = ORTUNG_SHARED_DATA "/mrpt_sena_telecom";
  if (!std::filesystem::is_directory(log)) GTEST_SKIP() << log << " is not here";
  const Found found = extract(log);
  EXPECT_GT(found.scans, 200u);
  EXPECT_GE(found.errors.size(), 15u);
  EXPECT_GE(found.within(0.3), found.errors.size() * 95 / 100);
}

}  // namespace
}  // namespace ortung::test
