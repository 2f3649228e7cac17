#include <csignal>

#include "Workspace.hpp"

namespace ortung::test {
namespace {

using Learn = Workspace;

TEST_F(Learn, SaysHowMuchItLearnedAndRepeatsItBitForBit) {
  const std::vector<std::string> command = {
      "learn", "--world",          path("hall.toml"), "--robot", path("robot.toml"),
      "--out", path("hall.ortung")};
  const Outcome outcome = ortung(command);
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  // 6 x 4 m in cells of 0.1 m.
  EXPECT_NE(outcome.out.find("60 x 40 cells of 0.1 m"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("1 features of scout in hall"), std::string::npos) << outcome.out;
  const std::string first = read("hall.ortung");
  ASSERT_EQ(ortung(command).exitCode, 0);
  EXPECT_EQ(read("hall.ortung"), first);
}

TEST_F(Learn, IsAPlayerAndDoesNotDependOnThreads) {
  const auto learn = [&](const std::string& out, const std::string& threads) {
    const Outcome outcome = ortung({"learn", "--world", path("hall.toml"), "--robot",
                                    path("robot.toml"), "--out", path(out), "--threads", threads});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("LMS200/LRF/180DegreeScan in "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find(" headings\n"), std::string::npos) << outcome.out;
  };
  learn("one.ortung", "1");
  learn("two.ortung", "2");
  EXPECT_EQ(read("one.ortung"), read("two.ortung"));
  // It learns in any simulation, ends by itself, and does not see who drives about meanwhile.
  const Outcome sim = ortung({"sim", path("hall.toml"), "--player",
                              "learner:robot=" + path("robot.toml") + "&out=" + path("sim.ortung"),
                              "--robot", path("robot.toml"), "--duration", "60", "--free-run"});
  EXPECT_EQ(sim.exitCode, 0) << sim.err;
  EXPECT_EQ(read("sim.ortung"), read("one.ortung"));
}

TEST_F(Learn, LeavesTheOldFileWholeWhenInterrupted) {
  write("hall.ortung", "PK\x03\x04 open.npy: the old file");
  Program program({"learn", "--world", path("hall.toml"), "--robot", path("robot.toml"), "--out",
                   path("hall.ortung"), "--cell", "0.01", "--heading-step", "0.5", "--progress"});
  ASSERT_TRUE(program.waitForError("learning ["));
  program.signal(SIGINT);
  const Outcome outcome = program.finish();
  EXPECT_EQ(outcome.exitCode, 130) << outcome.err;
  EXPECT_NE(outcome.err.find("ortung learn: interrupted"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(read("hall.ortung"), "PK\x03\x04 open.npy: the old file");
  EXPECT_EQ(files(), (std::vector<std::string>{"hall.ortung", "hall.toml", "robot.toml"}));
}

TEST_F(Learn, RefusesAnOutputItCannotWriteBeforeItWorks) {
  const Outcome outcome = ortung({"learn", "--world", path("hall.toml"), "--robot",
                                  path("robot.toml"), "--out", path("none/hall.ortung")});
  expectRefused(outcome, 1, "ortung learn: " + path("none/hall.ortung"), {"there is no folder"});
}

}  // namespace
}  // namespace ortung::test
