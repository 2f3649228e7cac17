#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "Paths.hpp"
#include "Workspace.hpp"

namespace ortung::test {
namespace {

using Check = Workspace;

TEST_F(Check, SaysWhatEachKindOfFileContains) {
  learnTables();
  recordRun();
  const Outcome outcome = ortung(
      {"check", path("hall.toml"), path("robot.toml"), path("hall.ortung"), path("run.rec")});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  for (const char* part : {"world 'hall', fingerprint", "x -3 to 3 m, y -2 to 2 m", "robot 'scout'",
                           "LMS200/LRF/180DegreeScan", "tables of robot 'scout' in world 'hall'",
                           "record, world", "readings", "4 files, 0 bad"}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << "\n" << outcome.out;
  }
}

TEST_F(Check, GoesOnBehindABadFileAndEndsWithCode1) {
  write("bad.toml", "[[sensor]]\nplugin = \"lrf\"\nbeams = -1\n");
  const Outcome outcome = ortung({"check", path("bad.toml"), path("none.rec"), path("hall.toml")});
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_NE(outcome.err.find("bad.toml:3"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("none.rec: can't be read"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("world 'hall'"), std::string::npos);
  EXPECT_NE(outcome.out.find("3 files, 2 bad"), std::string::npos) << outcome.out;
}

TEST_F(Check, TellsWhetherTablesBelongToWorldAndRobot) {
  learnTables();
  const std::vector<std::string> command = {
      "check", path("hall.ortung"), "--world", path("hall.toml"), "--robot", path("robot.toml")};
  const Outcome fits = ortung(command);
  EXPECT_EQ(fits.exitCode, 0) << fits.err;
  EXPECT_NE(fits.out.find("fits " + path("hall.toml")), std::string::npos);
  replace("hall.toml", "center_m = [2.4, -1.0]", "center_m = [2.3, -1.0]");
  expectRefused(ortung(command), 1, "ortung check: " + path("hall.ortung"),
                {"learned in the world"});
  replace("hall.toml", "center_m = [2.3, -1.0]", "center_m = [2.4, -1.0]");
  replace("robot.toml", "beams = 60", "beams = 61");
  expectRefused(ortung(command), 1, "ortung check: " + path("hall.ortung"),
                {"LMS200/LRF/180DegreeScan"});
}

// 3.14 and 1.57 are pi and a quarter of a turn; the lengths are centimetres.
TEST_F(Check, DoubtsValuesInAnotherUnit) {
  write("odd.toml",
        "[robot]\nname = \"odd\"\nradius_m = 25\n[[sensor]]\nplugin = \"odometry\"\n"
        "[[sensor]]\nplugin = \"lrf\"\npose = { x_m = 5, y_m = 0, theta_deg = 1.57 }\n"
        "fov_deg = 3.14\nmax_range_m = 800\nsigma_m = 0.05\n[drive]\nmax_turn_deg_s = 2.1\n");
  const Outcome odd = ortung({"check", path("odd.toml")});
  EXPECT_EQ(odd.exitCode, 0) << odd.err;
  const std::string file = "ortung check: warning: " + path("odd.toml");
  for (const std::string part :
       {":3: radius_m is 25 m: a robot's radius is usually ", ":8: x_m is 5 m: ",
        ":8: theta_deg is 1.57, which looks like radians and would be 90 degrees",
        ":9: fov_deg is 3.14, which looks like radians and would be 180 degrees",
        ":10: max_range_m is 800 m: ", ":13: max_turn_deg_s is 2.1 deg/s: "})
    EXPECT_NE(odd.err.find(file + part), std::string::npos) << part << "\n" << odd.err;
  EXPECT_EQ(std::count(odd.err.begin(), odd.err.end(), '\n'), 6) << odd.err;
}

TEST_F(Check, HasNoDoubtsAboutWhatIsShipped) {
  const std::filesystem::path maps = std::filesystem::path(ORTUNG_SOURCE_DIR) / "maps";
  std::vector<std::string> command = {"check"};
  for (const char* kind : {"fields", "robots", "scenes"})
    for (const auto& entry : std::filesystem::directory_iterator(maps / kind))
      if (entry.path().extension() == ".toml") command.push_back(entry.path());
  ASSERT_GT(command.size(), 20u);
  const Outcome outcome = ortung(command);
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("warning"), std::string::npos) << outcome.err;
}

TEST_F(Check, NamesThePlaceOfAMisspeltPlugin) {
  write("lfr.toml", "[robot]\nname = \"r\"\n[[sensor]]\nplugin = \"lfr\"\n");
  expectRefused(ortung({"check", path("lfr.toml")}), 1,
                "ortung check: " + path("lfr.toml") + ":4: ", {"'lfr'", "did you mean 'lrf'?"});
  write("motion.toml",
        "[robot]\nname = \"r\"\n[[sensor]]\nplugin = \"lrf\"\n[motion]\nplugin = \"onni\"\n");
  expectRefused(ortung({"check", path("motion.toml")}), 1,
                "ortung check: " + path("motion.toml") + ":6: ", {"did you mean 'omni'?"});
  write("scene.toml", "[scene]\nworld = \"hall.toml\"\n[[player]]\nplugin = \"golkeeper\"\n");
  expectRefused(ortung({"check", path("scene.toml")}), 1,
                "ortung check: " + path("scene.toml") + ":3: ", {"did you mean 'goalkeeper'?"});
}

}  // namespace
}  // namespace ortung::test
