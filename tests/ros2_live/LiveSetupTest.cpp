// What a node says that it waits for, until a robot tells its map, its scans and its frames.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "../support/Files.hpp"
#include "LiveSetup.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {
namespace {

class LiveSetupTest : public testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "Fast DDS 2.9 frees memory as another type than it was, and knows no sanitizer";
#endif
  }
  static Participant::Options options(const char* name) {
    Participant::Options options;
    options.isLocal = true;
    options.domain = 1 + static_cast<std::uint32_t>(getpid()) % 40;
    options.names.node = name;
    return options;
  }
  /// Says something again and again until the node waits for something else, a minute at most.
  template <class Say>
  static std::string missingAfter(LiveSetup& setup, const std::string& before, Say say) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    int count = 0;
    const auto goOn = [&] {
      if (count++ % 5 == 0) say();
      return setup.missing() == before && std::chrono::steady_clock::now() < end;
    };
    if (before.find("map") != before.npos)
      setup.waitForMap(goOn);
    else
      setup.waitForScanners(goOn);
    return setup.missing();
  }
};

TEST_F(LiveSetupTest, NamesWhatIsMissingAndNeverGuessesWhereAScannerIs) {
  Participant node(options("node"));
  Participant robot(options("robot"));
  const auto map = robot.publish("map", OccupancyGrid::kType, Qos::kLatched);
  const auto scans = robot.publish("scan", LaserScan::kType, Qos::kSensor);
  const auto frames = robot.publish("/tf_static", TfMessage::kType, Qos::kLatched);
  LiveSetup setup({.scans = {"scan"}, .clouds = {}, .bands = {}}, node);
  const std::string noMap = "the map at /map";
  EXPECT_EQ(setup.missing(), noMap);
  OccupancyGrid grid;
  grid.resolution = 0.1F;
  grid.width = grid.height = 2;
  grid.data = {0, 0, 100, -1};
  const std::string noScan = "scans at /scan";
  EXPECT_EQ(missingAfter(setup, noMap, [&] { map(toCdr(grid)); }), noScan);

  LaserScan scan;
  scan.header.frame = "laser";
  scan.angleMin = -0.1F;
  scan.angleMax = 0.1F;
  scan.angleIncrement = 0.1F;
  scan.rangeMax = 10.0F;
  scan.ranges = {1.0F, 2.0F, 3.0F};
  const auto say = [&] { scans(toCdr(scan)); };
  const std::string noMount = missingAfter(setup, noScan, say);
  EXPECT_EQ(noMount,
            "a transform from base_footprint to laser; frames at /tf_static and /tf are none "
            "(--base-frame?)");
  // Of another base than the node's: it goes on waiting, and says which frames there are.
  const auto tell = [&](const std::string& base) {
    frames(toCdr(TfMessage{{{{0, base}, "laser", fromPose2({0.2, 0.0, 0.0})}}}));
  };
  const std::string wrong = missingAfter(setup, noMount, [&] { tell("base_link"); });
  EXPECT_NE(wrong.find("are base_link, laser (--base-frame?)"), wrong.npos) << wrong;
  EXPECT_EQ(missingAfter(setup, wrong, [&] { tell("base_footprint"); }), "");
  const test::TemporaryFolder folder;
  setup.writeRobot(folder / "robot.toml", "\n[mcl]\nparticles = 3000\n");
  std::stringstream text;
  text << std::ifstream(folder / "robot.toml").rdbuf();
  EXPECT_NE(text.str().find("x_m = 0.2"), std::string::npos) << text.str();
  EXPECT_NE(text.str().find("particles = 3000"), std::string::npos);
}

}  // namespace
}  // namespace ortung::ros2
