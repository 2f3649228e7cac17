/// Worlds and robot files that the sources write fit their readings: the simulator and the
/// container read them, and the robot was where they say that it can be.

#include <cctype>
#include <ostream>

#include "LogTesting.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;

struct Case {
  const char* kind;
  const char* path;
  const char* options;
  double standable;  ///< share of the reference that must be where the robot fits
};

void PrintTo(const Case& log, std::ostream* out) {  // NOLINT: GoogleTest looks for this name
  *out << log.kind << ":" << log.path << log.options;
}

/// "mrclam_utias_mrclam_ds6"
std::string nameOf(const ::testing::TestParamInfo<Case>& info) {
  std::string name = std::string(info.param.kind) + "_" + info.param.path;
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  return name;
}

/// One log of the shared data.
class WrittenWorlds : public ::testing::TestWithParam<Case> {};

TEST_P(WrittenWorlds, HoldTheRobotWhereverItWent) {
  const auto& [kind, path, options, standable] = GetParam();
  ORTUNG_NEED_DATA(data, path);
  const TemporaryFolder folder;
  const auto source = makeSource(std::string(kind) + ":" + data.string() + options);
  source->writeWorld(folder.path() / "world.toml");
  const RobotConfig robot = readRobot(parseToml(source->robotToml(), "robot"));
  const auto world = readWorld(folder.path() / "world.toml");
  const FieldRegion region = world->region(0.1, {robot.radius});
  PoseData truth({"reference", "groundTruth", "pose"});
  std::size_t all = 0, inside = 0, fits = 0;
  for (const Message& message : readAll(*source)) {
    if (!(message.id == truth.id())) continue;
    truth.setData(message.stamp, message.words);
    const auto cell = region.grid.cellAt(truth.reading().x, truth.reading().y);
    ++all;
    inside += cell >= 0;
    fits += cell >= 0 && region.standable[static_cast<std::size_t>(cell)] != 0;
  }
  ASSERT_GT(all, 0u);
  EXPECT_EQ(inside, all);
  std::printf("%zu poses, %.4f where a robot of %.2f m fits\n", all,
              static_cast<double>(fits) / static_cast<double>(all), robot.radius);
  EXPECT_GE(static_cast<double>(fits), standable * static_cast<double>(all));
}

TEST_P(WrittenWorlds, HaveARobotThatTakesAllReadings) {
  const auto& [kind, path, options, standable] = GetParam();
  ORTUNG_NEED_DATA(data, path);
  const auto source = makeSource(std::string(kind) + ":" + data.string() + options);
  PluginFactory factory(PluginFactory::standardFolders());
  SensorContainer container;
  const RobotConfig robot = readRobot(parseToml(source->robotToml(), "robot"));
  try {
    fillContainer(container, robot, factory);
  } catch (const PluginError& error) {
    GTEST_SKIP() << "plugins of sensors were not built: " << error.what();
  }
  std::size_t taken = 0;
  for (const Message& message : readAll(*source)) {
    SensorData* const feature = container.findExactly(message.id);
    ASSERT_NE(feature, nullptr) << toText(message.id);
    feature->setData(message.stamp, message.words);  // throws if the words do not fit
    ++taken;
  }
  EXPECT_GT(taken, 0u);
}

INSTANTIATE_TEST_SUITE_P(
    RealLogs, WrittenWorlds,
    ::testing::Values(
        Case{"scanlog", "carmen/intel", "", 1.0}, Case{"scanlog", "carmen/aces", "", 1.0},
        Case{"scanlog", "carmen/belgioioso", "", 0.96},  // walked through by people while it mapped
        Case{"scanlog", "carmen/freiburg-101", "", 1.0},
        Case{"scanlog", "crob_lab_jarvis/complex_path_fast/security", "", 1.0},
        Case{"scanlog", "crob_lab_jarvis/complex_path_fast/nav350", "", 1.0},
        Case{"scanlog", "mrpt_localization_demo", "", 1.0},
        Case{"scanlog", "mrpt_sena_telecom", "", 1.0}, Case{"scanlog", "mrpt_uwb_ro", "", 1.0},
        Case{"carmen", "carmen/aces/aces-corrected.log.gz", "?map=map.yaml", 1.0},
        Case{"rawlog", "mrpt_uwb_ro/raw/uwb_ro-localization_demo.rawlog",
             "?map=uwb_ro-localization_demo_map.gridmap.gz&gt=../ref.txt&beacons=../beacons.txt",
             1.0},
        Case{"mrclam", "utias_mrclam/ds1", "?robot=3", 1.0},
        Case{"mrclam", "utias_mrclam/ds2", "?robot=3&features=each", 1.0},
        Case{"mrclam", "utias_mrclam/ds3", "?robot=3", 1.0},
        Case{"mrclam", "utias_mrclam/ds6", "", 1.0}, Case{"plaza", "plaza", "", 1.0},
        Case{"uwbpose", "uwb_planar_pose", "", 1.0},
        Case{"roh", "roh_bearings/(X1.5,Y1.5).csv", "", 1.0}),
    nameOf);

}  // namespace
}  // namespace ortung
