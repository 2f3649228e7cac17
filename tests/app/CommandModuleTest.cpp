#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "Workspace.hpp"

namespace ortung::test {
namespace {

/// Commands whose modules lie in a folder of the test's own.
class CommandModule : public Workspace {
 protected:
  Outcome run(const std::vector<std::string>& arguments) const {
    return ortung(arguments, {"ORTUNG_COMMAND_PATH=" + folder_.string()});
  }
  void copyModule(const std::string& from, const std::string& command) const {
    std::filesystem::copy_file(std::string(TEST_COMMANDS) + "/" + from,
                               folder_ / ("ortung_command_" + command + ".so"));
  }
};

TEST_F(CommandModule, OneThatIsNotInstalledIsNamedWithItsPackage) {
  expectRefused(run({"learn", "--help"}), 1, "ortung: the command 'learn' is not installed",
                {"the package ortung-sim", "ortung_command_learn.so", folder_.string()});
  expectRefused(run({"calibrate", "lines"}), 1, "ortung: the command 'calibrate lines' is not",
                {"the package ortung-devices"});
}

TEST_F(CommandModule, HelpAndVersionNeedNone) {
  const Outcome help = run({"--help"});
  EXPECT_EQ(help.exitCode, 0);
  EXPECT_NE(help.out.find("\n  learn "), std::string::npos) << help.out;
  const Outcome group = run({"export", "--help"});
  EXPECT_EQ(group.exitCode, 0);
  EXPECT_NE(group.out.find("\n  mcap "), std::string::npos) << group.out;
  EXPECT_EQ(run({"--version"}).exitCode, 0);
  EXPECT_EQ(run({"--describe"}).out, "");
}

TEST_F(CommandModule, OneOfAnotherVersionIsRefused) {
  copyModule("ortung_command_older.so", "learn");
  expectRefused(run({"learn"}), 1, "ortung: " + path("ortung_command_learn.so"),
                {"is of version 0.0.1-older, this program of ", "install the same version"});
}

TEST_F(CommandModule, WhatIsNoModuleIsRefused) {
  write("ortung_command_learn.so", "no library");
  expectRefused(run({"learn"}), 1, "ortung: the command 'learn' of the package ortung-sim can't be",
                {path("ortung_command_learn.so")});
  copyModule("ortung_command_empty.so", "show");
  expectRefused(run({"show"}), 1, "ortung: " + path("ortung_command_show.so"),
                {"is not a command of ortung"});
}

TEST(CommandDescription, TellsAllCommandsWithTheirOptions) {
  const Outcome outcome = ortung({"--describe"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::set<std::string> names;
  for (std::string line; std::getline(lines, line);) {
    const auto command = nlohmann::json::parse(line);
    names.insert(command["name"]);
    EXPECT_NE(command["footer"].get<std::string>().find("Example"), std::string::npos) << line;
    std::set<std::string> options;
    for (const auto& option : command["options"])
      for (const auto& name : option["names"]) options.insert(name);
    EXPECT_TRUE(options.contains("--help")) << line;
    EXPECT_TRUE(options.contains("--plugin-seconds")) << line;
    if (command["name"] != "ortung show") continue;
    for (const auto& option : command["options"]) {
      if (option["names"].empty() || option["names"].front() != "--scale") continue;
      EXPECT_EQ(option["default"], "auto");
      EXPECT_EQ(option["choices"], (std::vector<std::string>{"auto", "linear", "log"}));
    }
  }
  for (const char* name : {"ortung learn", "ortung sim", "ortung demo", "ortung export map",
                           "ortung benchmark merge", "ortung plugins"})
    EXPECT_TRUE(names.contains(name)) << name;
}

}  // namespace
}  // namespace ortung::test
