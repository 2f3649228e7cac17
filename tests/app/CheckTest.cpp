#include <gtest/gtest.h>

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

}  // namespace
}  // namespace ortung::test
