// Logs of real laser range finders fill `position` and `obstacles` as a simulated one does.
#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "Files.hpp"
#include "FoundPositions.hpp"
#include "Paths.hpp"
#include "ortung/formats/ObstaclesData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/run/Feeder.hpp"
#include "ortung/run/OpenSource.hpp"
#include "ortung/sim/SimWorld.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung::test {
namespace {

/// What is found in a log.
struct Found : FoundPositions {
  std::size_t withObstacles = 0;  ///< scans in which there are some
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
  std::uint64_t seen = 0;
  while (feeder.next()) {
    if (position->sequence() == seen) continue;
    seen = position->sequence();
    found.withObstacles += obstacles->reading().empty() ? 0 : 1;
    if (feeder.truth()) found.add(position->reading(), *feeder.truth());
  }
  return found;
}

/// Offices of several rooms: 198 of 342 scans had a position when this was written, all of them
/// right.
TEST(ExtractedPositions, OfARobotInOffices) {
  const std::string log = ORTUNG_SHARED_DATA "/mrpt_uwb_ro";
  if (!std::filesystem::is_directory(log)) GTEST_SKIP() << log << " is not here";
  Found found = extract(log);
  EXPECT_GT(found.scans, 300u);
  EXPECT_GT(found.fixed(), 160u);
  EXPECT_EQ(found.wrong, 0u);
  EXPECT_LT(found.medianError(), 0.05);  // the reference proves 0.02 to 0.04 m
  EXPECT_LT(found.nees(), 10.0);
  EXPECT_GT(found.withObstacles, found.scans / 2);  // furniture, people
}

/// Corridors and rooms that look alike: 260 of 395 scans had positions.
TEST(ExtractedPositions, OfARobotInACastle) {
  const std::string log = ORTUNG_SHARED_DATA "/carmen/belgioioso";
  if (!std::filesystem::is_directory(log)) GTEST_SKIP() << log << " is not here";
  const Found found = extract(log);
  EXPECT_GT(found.fixed(), 200u);
  EXPECT_GT(found.certain, 150u);
  EXPECT_EQ(found.wrong, 0u);
  EXPECT_LT(found.nees(), 10.0);
}

/// A laboratory whose outlines are mostly furniture: few scans have a position, and none a wrong
/// one.
TEST(ExtractedPositions, OfARobotInALaboratory) {
  const std::string log = ORTUNG_SHARED_DATA "/mrpt_sena_telecom";
  if (!std::filesystem::is_directory(log)) GTEST_SKIP() << log << " is not here";
  const Found found = extract(log);
  EXPECT_GT(found.scans, 200u);
  EXPECT_GE(found.errors.size(), 25u);
  EXPECT_EQ(found.wrong, 0u);
}

/// A building around a round crossing, half of which is the other half turned: 92 of 440 scans had
/// positions, 55 of them several.
TEST(ExtractedPositions, OfARobotWhereHalfATurnLooksTheSame) {
  const std::string log = ORTUNG_SHARED_DATA "/carmen/aces";
  if (!std::filesystem::is_directory(log)) GTEST_SKIP() << log << " is not here";
  const Found found = extract(log);
  EXPECT_GT(found.fixed(), 70u);
  EXPECT_GT(found.fixed() - found.certain, 35u);
  EXPECT_EQ(found.wrong, 0u);
}

/// A hall with visitors: 240 of 488 scans had a position. A few scans in a row were wrong by 35 m
/// where the walls around the robot were not found in the map.
TEST(ExtractedPositions, OfARobotInAHall) {
  const std::string log = ORTUNG_SHARED_DATA "/carmen/fhw";
  if (!std::filesystem::is_directory(log)) GTEST_SKIP() << log << " is not here";
  const Found found = extract(log);
  EXPECT_GT(found.fixed(), 190u);
  EXPECT_EQ(found.wrong, 0u);
}

/// A scanner that looks over the low barrier of a field sees the goals alone, and other robots.
TEST(ExtractedPositions, OfGoalsAlone) {
  const auto world = readWorld(ORTUNG_SOURCE_DIR "/maps/fields/msl.toml");
  PluginFactory factory(PluginFactory::standardFolders());
  const Parameters settings = parseToml(
      "beams = 360\nfov_deg = 360\nmax_range_m = 20\nnoise_sigma_m = 0.02\npose = { z_m = 0.35 }",
      "sensor");
  SensorContainer container;
  std::vector<SensorData*> data;
  for (auto& one : factory.makeData("lrf_iconic", settings))
    data.push_back(&container.add(std::move(one)));
  const auto sensor = factory.make<Sensor>("lrf_iconic", settings);
  container.add("lrf_iconic", factory.makeIfThere<Extractor>("lrf_iconic", settings), data);
  container.connect();
  container.setField(std::make_shared<FieldModel>(fieldModelOf(*world)));
  Primitive round;
  round.shape = Primitive::Shape::kEllipse;
  round.kind = "robot";
  round.halfX = round.halfY = 0.25;
  std::vector<RobotNumber> others;
  for (int i = 0; i < 3; ++i) others.push_back(world->addBody({"robot", "", "", {round}}, {}));
  Random random(5);
  Found found;
  for (int i = 0; i < 500; ++i) {
    RobotState robot;
    const auto anywhere = [&] {
      return Pose2{random.uniform(-11, 11), random.uniform(-7, 7), random.uniform(-3, 3)};
    };
    do {
      robot.pose = anywhere();
    } while (!world->isFree(robot.pose.x, robot.pose.y, {0.3, 0.8}));
    for (const RobotNumber other : others) {
      Pose2 place;
      do {
        place = anywhere();
      } while (distance(place, robot.pose) < 0.8);
      world->moveBody(other, place);
    }
    sensor->generateData(*world, robot, &random, i + 1, data);
    container.extract();
    found.add(dynamic_cast<const PoseFixData&>(*data[1]).reading(), robot.pose);
  }
  EXPECT_GT(found.fixed(), 75u);  // two of them, at both ends of the field
  EXPECT_LE(found.wrong, found.fixed() / 100);
  EXPECT_EQ(found.certain, 0u);
  EXPECT_LT(found.nees(), 10.0);
}

}  // namespace
}  // namespace ortung::test
