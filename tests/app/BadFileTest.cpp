#include <gtest/gtest.h>

#include "Paths.hpp"
#include "Workspace.hpp"

namespace ortung::test {
namespace {

/// What learn says of bad files; the tables of an earlier run must survive each of them.
class BadFile : public Workspace {
 protected:
  BadFile() { write("hall.ortung", "PK\x03\x04 open.npy: the old file"); }

  void expectLearnRefuses(const std::string& begin, const std::vector<std::string>& parts) {
    const Outcome outcome = ortung({"learn", "--world", path("hall.toml"), "--robot",
                                    path("robot.toml"), "--out", path("hall.ortung")});
    expectRefused(outcome, 1, "ortung learn: " + begin, parts);
    EXPECT_EQ(read("hall.ortung"), "PK\x03\x04 open.npy: the old file");
    EXPECT_EQ(files(), (std::vector<std::string>{"hall.ortung", "hall.toml", "robot.toml"}));
  }
};

TEST_F(BadFile, WrongKeyIsNamedWithItsLine) {
  replace("robot.toml", "max_range_m", "max_rang_m");
  expectLearnRefuses(path("robot.toml") + ":8", {"max_rang_m"});
}

TEST_F(BadFile, WrongUnitIsNamed) {
  replace("robot.toml", "fov_deg = 180", "fov_rad = 3.14");
  expectLearnRefuses(path("robot.toml") + ":7", {"fov_rad"});
}

TEST_F(BadFile, NumberOutOfItsRangeIsNamedWithTheRange) {
  replace("robot.toml", "fov_deg = 180", "fov_deg = 400");
  expectLearnRefuses(path("robot.toml") + ":7", {"fov_deg", "400", "360"});
}

TEST_F(BadFile, UnknownPluginIsNamed) {
  replace("robot.toml", "plugin = \"lrf\"", "plugin = \"radar\"");
  expectLearnRefuses("", {"radar"});
}

TEST_F(BadFile, WrongKeyOfAWorldIsNamed) {
  replace("hall.toml", "size_m", "size_cm");
  expectLearnRefuses(path("hall.toml"), {"size_"});
}

TEST_F(BadFile, MissingMapImageIsNamed) {
  write("hall.toml", "[world]\nname = \"hall\"\n[[grid]]\nmap = \"hall.yaml\"\nz_m = [0, 1]\n");
  expectLearnRefuses(path("hall.toml") + ":", {"hall.yaml"});
}

TEST_F(BadFile, MissingFilesAreNamed) {
  std::filesystem::remove(path("robot.toml"));
  expectRefused(ortung({"learn", "--world", path("hall.toml"), "--robot", path("robot.toml"),
                        "--out", path("hall.ortung")}),
                1, "ortung learn: " + path("robot.toml"), {});
}

TEST_F(BadFile, WhatIsNoTomlIsNamedWithItsLine) {
  write("robot.toml", "[robot]\nname = \n");
  expectLearnRefuses(path("robot.toml") + ":2", {});
}

TEST_F(BadFile, ControlCharactersDoNotReachTheTerminal) {
  replace("robot.toml", "plugin = \"lrf\"", "plugin = \"a\\u001B[2Jb\"");
  const Outcome outcome = ortung({"learn", "--world", path("hall.toml"), "--robot",
                                  path("robot.toml"), "--out", path("hall.ortung")});
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_EQ(outcome.err.find('\033'), std::string::npos) << outcome.err;
}

TEST_F(BadFile, PluginOfAnotherBuildIsRefusedWithBothBuilds) {
  const std::filesystem::path plugins = ORTUNG_PLUGINS_DIR;
  std::filesystem::create_directory(path("plugins"));
  std::filesystem::path original;
  for (const auto& entry : std::filesystem::directory_iterator(plugins)) {
    if (entry.path().filename().string().starts_with("ortung_lrf")) original = entry.path();
    std::filesystem::copy(entry.path(), path("plugins"));
  }
  ASSERT_FALSE(original.empty());
  std::filesystem::remove(path("hall.ortung"));
  for (const auto& entry : std::filesystem::directory_iterator(path("plugins"))) {
    if (!entry.path().filename().string().starts_with("ortung_lrf")) continue;
    const std::string name = "plugins/" + entry.path().filename().string();
    std::string bytes = read(name);
    const std::string tag = "container 0.";
    for (std::size_t at = bytes.find(tag); at != bytes.npos; at = bytes.find(tag, at + 1)) {
      bytes[at + tag.size() - 2] = '9';  // "container 9."
    }
    write(name, bytes);
  }
  const Outcome outcome = ortung({"learn", "--world", path("hall.toml"), "--robot",
                                  path("robot.toml"), "--out", path("hall.ortung")},
                                 {"ORTUNG_PLUGIN_PATH=" + path("plugins")});
  expectRefused(outcome, 1, "ortung learn: ", {"ortung_lrf", "container 9.", "container 0."});
  EXPECT_FALSE(std::filesystem::exists(path("hall.ortung")));
}

}  // namespace
}  // namespace ortung::test
