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
  // Compressed, it is the same.
  ASSERT_EQ(ortung({"import", "record", path("run.rec"), "--out", path("small.rec")}).exitCode, 0);
  EXPECT_LT(3 * std::filesystem::file_size(path("small.rec")),
            std::filesystem::file_size(path("run.rec")));
  ASSERT_EQ(ortung({"import", "record", path("small.rec"), "--out", path("back.txt")}).exitCode, 0);
  EXPECT_TRUE(read("back.txt") == read("run.rec"));
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

TEST_F(Import, TakesTheSourceInOneWordAsOtherCommandsDo) {
  const std::vector<std::vector<std::string>> ways = {
      {"import", "sim:" + path("hall.toml") + "?duration=0.5&seed=4"},
      {"import", "sim", path("hall.toml") + "?duration=0.5&seed=4"},
      {"import", "sim", path("hall.toml"), "--option", "duration=0.5", "--option", "seed=4"}};
  std::string first;
  for (std::vector<std::string> way : ways) {
    way.insert(way.end(), {"--with-robot", path("robot.toml"), "--out", path("run.rec")});
    const Outcome outcome = ortung(way);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    if (first.empty()) first = read("run.rec");
    EXPECT_EQ(read("run.rec"), first);
  }
  expectRefused(ortung({"import", "sim:x", "y", "--out", path("run.rec")}), 2,
                "ortung import: ", {"'sim:x'", "KIND SOURCE or KIND:SOURCE"});
  expectRefused(ortung({"import", "sim", "--out", path("run.rec")}), 2,
                "ortung import: source 'sim'", {"KIND:PATH"});
  expectRefused(ortung({"import", "sim:x?y", "--out", path("run.rec")}), 2,
                "ortung import: ", {"'y' is not key=value"});
}

/// A log with a map beside it.
class ImportedWorld : public Workspace {
 protected:
  ImportedWorld() {
    for (const char* folder : {"log", "far"}) std::filesystem::create_directory(path(folder));
    write("log/scans.txt",
          "# t odom n r; ANGLES -1.5 0.5 ; sensor at x=0.78 y=-0.1 yaw=0.5, max range 80.0\n"
          "1.0 0.0 0.0 0.0 3 1.25 0 81.91\n2.0 0.5 0.0 0.1 3 1.5 2 -1\n");
    write("log/map.yaml",
          "image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\n"
          "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
    write("log/map.pgm", "P5\n20 20\n255\n" + std::string(400, '\xFF'));
  }
  Outcome import(const std::string& world, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command = {"import",        "scanlog", path("log"), "--out",
                                        path("run.rec"), "--world", world};
    command.insert(command.end(), more.begin(), more.end());
    return ortung(command);
  }
};

TEST_F(ImportedWorld, KeepsLinksAndWhatIsThere) {
  std::filesystem::create_symlink("far/hall.toml", path("site.toml"));
  const Outcome made = import(path("site.toml"));
  ASSERT_EQ(made.exitCode, 0) << made.err;
  EXPECT_TRUE(std::filesystem::is_symlink(path("site.toml")));
  EXPECT_NE(read("far/hall.toml").find("site.yaml"), std::string::npos);
  EXPECT_EQ(ortung({"check", path("site.toml")}).exitCode, 0);
  expectRefused(import(path("site.toml")), 1, "ortung import: " + path("site.toml"), {"--force"});
  std::filesystem::remove(path("far/hall.toml"));
  expectRefused(import(path("site.toml")), 1, "ortung import: " + path("site."), {"--force"});
  EXPECT_EQ(import(path("site.toml"), {"--force"}).exitCode, 0);
  EXPECT_EQ(files(), (std::vector<std::string>{"far", "hall.toml", "log", "robot.toml", "run.rec",
                                               "site.pgm", "site.toml", "site.yaml"}));
}

TEST_F(ImportedWorld, ShortOptionsStandForOptionsOfTheSource) {
  const auto robotOf = [this](const std::vector<std::string>& option) {
    std::vector<std::string> more = {"--force", "--robot-file", path("mine.toml")};
    more.insert(more.end(), option.begin(), option.end());
    const Outcome made = import(path("site.toml"), more);
    EXPECT_EQ(made.exitCode, 0) << made.err;
    return read("mine.toml");
  };
  const std::string shortly = robotOf({"--laser-x", "0.25"});
  EXPECT_NE(shortly.find("x_m = 0.25"), std::string::npos) << shortly;
  EXPECT_EQ(shortly, robotOf({"--option", "laser_x=0.25"}));
  EXPECT_NE(robotOf({}).find("x_m = 0.78"), std::string::npos) << "as the log has it";
  expectRefused(import(path("site.toml"), {"--force", "--robot", "5"}), 1,
                "ortung import: ", {"log: robot is not known here"});
}

TEST_F(ImportedWorld, ReplacesNeitherADeviceNorTheMapThatItIsMadeOf) {
  expectRefused(import("/dev/null", {"--force"}), 1,
                "ortung import: /dev/null: ", {"is made beside it"});
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  const std::string map = read("log/map.pgm");
  expectRefused(import(path("log/map.toml"), {"--force"}), 2, "ortung import: " + path("log/map."),
                {"is read by this run"});
  EXPECT_EQ(read("log/map.pgm"), map);
}

TEST_F(Import, MissingLogIsNamed) {
  const Outcome outcome = ortung({"import", "mrclam", path("none"), "--out", path("run.rec")});
  expectRefused(outcome, 1, "ortung import: ", {path("none")});
  EXPECT_FALSE(std::filesystem::exists(path("run.rec")));
}

}  // namespace
}  // namespace ortung::test
