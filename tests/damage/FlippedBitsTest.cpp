// Every bit of small files of each kind that is read, flipped: the copy is read or refused with a
// sentence, within a bounded memory. Images are in FlippedImagesTest.cpp, tables in
// FlippedTablesTest.cpp.
#include <map>

#include "FlippedBits.hpp"
#include "Golden.hpp"
#include "Paths.hpp"
#include "SmallPngs.hpp"
#include "WorldModel.hpp"
#include "ortung/base/HelperProgram.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/robot/MotionNetworkFile.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/Scene.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung {
namespace {

using test::Fate;
using test::flipBits;
using test::fromHex;
using test::goldenFile;
using test::readBytes;
using test::TemporaryFolder;
using test::writeBytes;

// Some bits do not matter (comments, names, digits), others do.
void expectBoth(const Fate& fate) {
  EXPECT_GT(fate.taken, 0);
  EXPECT_GT(fate.refused, 0);
}

/// Casts a ray in a world that was taken.
void use(const std::filesystem::path& file) {
  const auto world = readWorld(file);
  float range = -1.0F;
  world->castFan({.x = 0.1,
                  .y = 0.1,
                  .z = 0.2,
                  .firstAngle = 0.3,
                  .angleStep = 0.1,
                  .elevation = 0.0,
                  .maxRange = 8.0},
                 0, {&range, 1});
  EXPECT_TRUE(range >= 0.0F && range <= 8.0F) << range;
}

TEST(FlippedBits, OfAWorld) {
  const TemporaryFolder folder;
  const std::string world = R"([world]
name = "small"
x_m = [-3, 3]
[physics]
cycle_ms = 20
[[rectangle]]
kind = "wall"
center_m = [1, 0.5]
size_m = [1.2, 0.4]
angle_deg = 25
[[ellipse]]
kind = "post"
identity = 1
center_m = [-1, -0.5]
size_m = [1.4, 0.6]
[[ellipse]]
kind = "ball"
name = "ball"
center_m = [0, -1]
size_m = [0.2, 0.2]
z_m = [0, 0.2]
[[triangle]]
corners_m = [1, -1.5, 2.2, -1.2, 1.6, -0.4]
[[landmark]]
kind = "tag"
identity = 2
position_m = [1, 1, 0.5]
)";
  writeBytes(folder / "world.toml", world);
  use(folder / "world.toml");  // Embree's threads start before memory is limited
  int round = 0;
  expectBoth(flipBits<ConfigError>(world, [&](const std::string& bytes) {
    writeBytes(folder / "world.toml", bytes);
    readWorldModel(folder / "world.toml");
    if (++round % 16 == 0) use(folder / "world.toml");  // which makes the rays' geometry
  }));
}

TEST(FlippedBits, OfAScene) {
  const TemporaryFolder folder;
  const std::string scene = R"([scene]
world = "world.toml"
duration_s = 5
[[robot]]
file = "robot.toml"
name = "a"
start = { x_m = -1.3, y_m = 0.0, theta_deg = 0 }
kidnap_s = [1, 2.5]
[[robot]]
file = "robot.toml"
name = "b"
waypoints_m = [0, 0, 1, 0.5]
speed_m_s = 0.5
[[command]]
at_s = 0.5
robot = "a"
translational_m_s = 0.5
[[thing]]
at_s = 1
name = "ball"
pose = { x_m = 1, y_m = 0 }
)";
  writeBytes(folder / "scene.toml", scene);
  writeBytes(folder / "world.toml",
             "[[ellipse]]\nkind = \"post\"\ncenter_m = [0, 0]\nsize_m = [1, 1]\n");
  writeBytes(folder / "robot.toml", "[robot]\nname = \"r\"\n");
  expectBoth(flipBits<ConfigError>(scene, [&](const std::string& bytes) {
    writeBytes(folder / "scene.toml", bytes);
    Scene::read(folder / "scene.toml");
  }));
}

TEST(FlippedBits, OfARobotFile) {
  static PluginFactory factory({ORTUNG_PLUGINS_DIR});
  const std::string robot = R"([robot]
name = "r"
radius_m = 0.2
[motion]
[[sensor]]
plugin = "lrf"
beams = 90
fov_deg = 180
pose = { x_m = 0.1, theta_deg = 5 }
[[sensor]]
plugin = "sonar"
pose = { x_m = 0.1 }
[[sensor]]
plugin = "landmarks"
kind = "post"
identities = [1, 2, 400000]
[[sensor]]
plugin = "odometry"
[[sensor]]
plugin = "compass"
)";
  // Names of plugins may change, too, or those that are there be given another's settings.
  struct Refused : std::runtime_error {
    using std::runtime_error::runtime_error;
  };
  const auto look = [](const std::string& bytes) {
    try {
      SensorContainer container;
      fillContainer(container, readRobot(parseToml(bytes, "robot")), factory);
      for (const auto& data : container.all())
        EXPECT_EQ(data->localizes() && data->learningKey().empty(), false);
    } catch (const ConfigError& error) {
      throw Refused(error.what());
    } catch (const PluginError& error) {
      throw Refused(error.what());
    }
  };
  expectBoth(flipBits<Refused>(robot, look));
}

TEST(FlippedBits, OfAMotionNetwork) {
  const std::string network = readBytes(goldenFile("network1.json"));
  expectBoth(flipBits<ConfigError>(
      network, [](const std::string& bytes) { parseMotionNetwork(bytes, "network").check(); }));
}

TEST(FlippedBits, OfARecord) {
  const TemporaryFolder folder;
  for (const char* name : {"record1.rec", "record2.rec"}) {
    const std::string record = readBytes(goldenFile(name));
    expectBoth(flipBits<std::runtime_error>(record, [&](const std::string& bytes) {
      writeBytes(folder / "a.rec", bytes);
      RecordSource source(folder / "a.rec");
      for (Message message; source.next(message);) EXPECT_FALSE(message.id.model.empty());
    }));
  }
}

// --- foreign logs ---

struct Log {
  std::string kind;
  std::string path;  ///< in the folder
  std::map<std::string, std::string> files;
};

/// Reads a source to its end as the program does; what it throws must name the folder.
void readToTheEnd(const std::string& kind, const std::filesystem::path& path) {
  static PluginFactory factory({ORTUNG_PLUGINS_DIR});
  Parameters parameters(kind);
  parameters.set("path", path.string());
  parameters.set("robot_file", "");
  const auto source = factory.make<Source>(kind, parameters);
  for (Message message; source->next(message);) EXPECT_NE(message.id.model, "");
}

TEST(FlippedBits, OfForeignLogs) {
  const std::vector<Log> logs = {
      {"mrclam",
       "",
       {{"Barcodes.dat", "1 5\n6 63\n7 81\n"},
        {"Landmark_Groundtruth.dat", "6 1 2 0 0\n7 3 -1 0 0\n"},
        {"Robot1_Odometry.dat", "10 1 1.5\n11 0.5 0\n12 0 0\n"},
        {"Robot1_Measurement.dat", "10.5 5 1 0.1\n10.5 63 2 0.5\n11.5 81 1.25 3\n"},
        {"Robot1_SparseGroundtruth.dat", "11.1 11 11.5 1 2 0 3\n11.8 11.8 11.8 1.5 2 0 3\n"}}},
      {"scanlog",
       "",
       {{"scans.txt",
         "# ANGLES -1.5 0.5 ; sensor at x=0.78 y=0 yaw=0, max range 80.0\n"
         "1 0 0 0 3 1.25 0 81.91\n2 0.5 0 0.1 3 1.5 2 1\n"},
        {"gt.txt", "1 4 -5 3\n2 4.5 -5 3.1 0.99\n3 5 -5 3\n"}}},
      {"carmen",
       "a.log",
       {{"a.log",
         "PARAM robot_frontlaser_offset 0.1 h 0\nODOM 0 0 0 0 0 0 0.5 h 0.5\n"
         "FLASER 2 1 1 0.9 0 1.5 0.9 0 1.5 1 h 1\nODOM 0.9 0 1.5 0 0 0 2 h 2\n"}}}};
  for (const Log& log : logs) {
    const TemporaryFolder folder;
    for (const auto& [name, bytes] : log.files) writeBytes(folder / name, bytes);
    for (const auto& [name, whole] : log.files) {
      SCOPED_TRACE(log.kind + " " + name);
      const Fate fate = flipBits<std::runtime_error>(whole, [&](const std::string& bytes) {
        writeBytes(folder / name, bytes);
        readToTheEnd(log.kind, folder.path() / log.path);
      });
      EXPECT_GT(fate.refused, 0);
      writeBytes(folder / name, whole);
    }
  }
}

/// One odometry reading and one scan of three beams, as MRPT writes them.
constexpr std::string_view kRawlog =
    "9f6d7270743a3a6f62733a3a434f62736572766174696f6e4f646f6d6574727902946d7270743a3a706f7365"
    "733a3a43506f736532440100000000000000000000000000000000000000000000000088010000006f00644a"
    "29e1b19d01000088a26d7270743a3a6f62733a3a434f62736572766174696f6e324452616e67655363616e07"
    "0000803f0100000041946d7270743a3a706f7365733a3a43506f736533440300000000000000000000000000"
    "0000000000000000000000000000000000f03f00000000000000000000000000000000000000000000000000"
    "0000000000f03f000000000000000000000000000000000000000000000000000000000000f03f8803000000"
    "0000803f00000040000040400101010ad7233c40af9629e1b19d0100000000010000006c0000000000000000"
    "0088";

constexpr rlim_t kForMrpt = rlim_t{16} << 30;  // its libraries take 1.2 GB, it has limits itself

// Found by flipping all bits: in which order the beams came is a byte that is neither 0 nor 1.
TEST(FlippedBits, AFlagOfARawlogIsAnyByte) {
  try {
    findHelper("ortung-mrpt-reader", "");
  } catch (const std::runtime_error&) {
    GTEST_SKIP() << "ortung-mrpt-reader was not built (ORTUNG_MRPT)";
  }
  const TemporaryFolder folder;
  std::string bytes = fromHex(kRawlog);
  constexpr std::size_t kFlag = 136;
  ASSERT_EQ(bytes[kFlag], 1);
  bytes[kFlag] = 5;
  writeBytes(folder / "a.rawlog", bytes);
  EXPECT_NO_THROW(readToTheEnd("rawlog", folder / "a.rawlog"));
}

// The reader is a program of its own, which takes a tenth of a second to start: some bits here, all
// of them with ORTUNG_LONG_TESTS=1.
TEST(FlippedBits, OfARawlog) {
  try {
    findHelper("ortung-mrpt-reader", "");
  } catch (const std::runtime_error&) {
    GTEST_SKIP() << "ortung-mrpt-reader was not built (ORTUNG_MRPT)";
  }
  const TemporaryFolder folder;
  const Fate fate = flipBits<std::runtime_error>(
      fromHex(kRawlog),
      [&](const std::string& bytes) {
        writeBytes(folder / "a.rawlog", bytes);
        try {
          readToTheEnd("rawlog", folder / "a.rawlog");
        } catch (const std::runtime_error& error) {
          // How UndefinedBehaviorSanitizer ends a helper (CMakePresets.json).
          EXPECT_EQ(std::string_view(error.what()).find("status 77"), std::string_view::npos)
              << error.what();
          throw;
        }
      },
      test::everyOrAll(151), kForMrpt);
  EXPECT_GT(fate.all(), 10);
  expectBoth(fate);
}

}  // namespace
}  // namespace ortung
