#include <gtest/gtest.h>

#include "Workspace.hpp"

namespace ortung::test {
namespace {

using Import = Workspace;

TEST_F(Import, RecordOfASimulatedRunBearsTheFingerprintOfItsWorld) {
  recordRun();
  learnTables();
  EXPECT_TRUE(read("run.rec").starts_with("# ortung record 1\n# world "))
      << read("run.rec").substr(0, 80);
  const Outcome outcome = ortung({"check", path("run.rec"), path("hall.ortung")});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
}

TEST_F(Import, RefusesToReplaceARobotFileUnlessForced) {
  const std::vector<std::string> command = {
      "import",           "sim",          path("hall.toml"), "--out",
      path("run.rec"),    "--option",     "duration=1",      "--with-robot",
      path("robot.toml"), "--robot-file", path("mine.toml")};
  write("mine.toml", "my own work");
  expectRefused(ortung(command), 1, "ortung import: " + path("mine.toml"), {"--force"});
  EXPECT_EQ(read("mine.toml"), "my own work");
  EXPECT_EQ(files(), (std::vector<std::string>{"hall.toml", "mine.toml", "robot.toml"}));
  std::vector<std::string> forced = command;
  forced.push_back("--force");
  EXPECT_EQ(ortung(forced).exitCode, 0);
  EXPECT_EQ(read("mine.toml"), read("robot.toml"));
}

TEST_F(Import, SourceThatKnowsNoWorldSaysSoAndWritesNothing) {
  const Outcome outcome =
      ortung({"import", "sim", path("hall.toml"), "--out", path("run.rec"), "--with-robot",
              path("robot.toml"), "--world", path("copy.toml")});
  expectRefused(outcome, 1, "ortung import: ", {"no world"});
  EXPECT_EQ(files(), (std::vector<std::string>{"hall.toml", "robot.toml"}));
}

TEST_F(Import, OptionsMustBeKeyAndValue) {
  const auto with = [&](const std::vector<std::string>& options) {
    std::vector<std::string> command = {"import", "sim", path("hall.toml"), "--out",
                                        path("run.rec")};
    for (const std::string& option : options) {
      command.push_back("--option");
      command.push_back(option);
    }
    return ortung(command);
  };
  expectRefused(with({"duration"}), 2, "ortung import: --option", {"key=value"});
  expectRefused(with({"seed=1", "seed=2"}), 2, "ortung import: ", {"twice"});
}

TEST_F(Import, MissingLogIsNamed) {
  const Outcome outcome = ortung({"import", "mrclam", path("none"), "--out", path("run.rec")});
  expectRefused(outcome, 1, "ortung import: ", {path("none")});
  EXPECT_FALSE(std::filesystem::exists(path("run.rec")));
}

}  // namespace
}  // namespace ortung::test
