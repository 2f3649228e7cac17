#include <gtest/gtest.h>

#include "Workspace.hpp"

namespace ortung::test {
namespace {

using WrongFiles = Workspace;

TEST_F(WrongFiles, AreNamedByWhatTheyAre) {
  learnTables();
  recordRun();
  const auto learn = [&](const char* world, const char* robot) {
    return ortung({"learn", "--world", path(world), "--robot", path(robot), "--out", path("x")});
  };
  expectRefused(learn("robot.toml", "robot.toml"), 1,
                "ortung learn: ", {"robot.toml: is no world file; it is a robot file"});
  expectRefused(learn("hall.toml", "hall.toml"), 1,
                "ortung learn: ", {"hall.toml: is no robot file; it is a world file"});
  expectRefused(learn("hall.ortung", "robot.toml"), 1,
                "ortung learn: ", {"it is a file of tables"});
  expectRefused(learn("run.rec", "robot.toml"), 1, "ortung learn: ", {"it is a record"});
  const auto localize = [&](const std::string& source, const char* tables) {
    return ortung(
        {"localize", "--source", source, "--robot", path("robot.toml"), "--tables", path(tables)});
  };
  expectRefused(localize("record:" + path("hall.ortung"), "hall.ortung"), 1,
                "ortung localize: ", {"or a compressed record; it is a file of tables"});
  expectRefused(localize(path("run.rec"), "run.rec"), 1, "ortung localize: ", {"it is a record"});
  expectRefused(localize(path("robot.toml"), "hall.ortung"), 2,
                "ortung localize: ", {"expected KIND:PATH", "it is a robot file"});
}

TEST_F(WrongFiles, ARecordNeedsNoKind) {
  learnTables();
  recordRun();
  const auto localize = [&](const std::string& source) {
    return ortung({"localize", "--source", source, "--robot", path("robot.toml"), "--tables",
                   path("hall.ortung")});
  };
  const Outcome bare = localize(path("run.rec"));
  EXPECT_EQ(bare.exitCode, 0) << bare.err;
  EXPECT_EQ(bare.out, localize("record:" + path("run.rec")).out);
  EXPECT_EQ(localize(path("run.rec") + "?to=5").out,
            localize("record:" + path("run.rec") + "?to=5").out);
}

TEST_F(WrongFiles, UnknownOptionsAreNamedFirst) {
  // Though a required one is missing, too.
  expectRefused(ortung({"learn", "--wrold", "hall.toml"}), 2,
                "ortung learn: there is no option --wrold (did you mean '--world'?)", {});
  expectRefused(ortung({"learn", "--frobnicate=3"}), 2,
                "ortung learn: there is no option --frobnicate;", {});
  expectRefused(ortung({"lern"}), 2,
                "ortung: there is no subcommand 'lern' (did you mean 'learn'?)", {});
  expectRefused(ortung({"plugins", "sensro"}), 2, "ortung plugins: there is no kind of plugins",
                {"did you mean 'sensor'?"});
}

TEST(Help, IsAtMost100ColumnsWide) {
  std::vector<std::vector<std::string>> commands = {{}};
  for (const char* command :
       {"learn", "localize", "eval", "sim", "robot", "view", "import", "check", "show", "emulate",
        "merge", "play", "serve", "plugins", "demo"})
    commands.push_back({command});
  commands.push_back({"export", "mcap"});
  commands.push_back({"calibrate", "lines"});
  for (std::vector<std::string> command : commands) {
    command.emplace_back("--help");
    const Outcome help = ortung(command);
    ASSERT_EQ(help.exitCode, 0) << help.err;
    EXPECT_EQ(help.out.find('\x1b'), std::string::npos);  // no terminal, no colours
    std::istringstream lines(help.out.substr(0, help.out.find("Example:")));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
  }
}

TEST(Doctor, LooksAtAllParts) {
  const Outcome outcome = ortung({"doctor", "--port", "45671"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.out;
  for (const char* part : {"processor", "commands", "plugins", "pictures", "port", "devices"})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
}

class SickInstallation : public Workspace {};

TEST_F(SickInstallation, IsToldByTheDoctor) {
  write("ortung_broken.so", "this is no shared library");
  const Outcome outcome = ortung({"doctor"}, {"ORTUNG_PLUGIN_PATH=" + folder_.string()});
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_NE(outcome.out.find("BROKEN plugins"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("ortung_broken.so"), std::string::npos) << outcome.out;
}

TEST(PluginTable, ShowsWhatThereIsOfAKind) {
  const Outcome sensors = ortung({"plugins", "sensor"});
  EXPECT_EQ(sensors.exitCode, 0) << sensors.err;
  EXPECT_NE(sensors.out.find("\nlrf  "), std::string::npos) << sensors.out;
  EXPECT_EQ(sensors.out.find("goalkeeper"), std::string::npos);
  const Outcome players = ortung({"plugins", "player"});
  EXPECT_NE(players.out.find("keeps a goal"), std::string::npos) << players.out;
  const Outcome sources = ortung({"plugins", "source", "mrclam"});
  EXPECT_NE(sources.out.find("folder of a run of UTIAS MRCLAM"), std::string::npos) << sources.out;
  const Outcome lrf = ortung({"plugins", "sensor", "lrf"});
  EXPECT_NE(lrf.out.find("beams                        a whole number in [1, 8192]; default: 180"),
            std::string::npos)
      << lrf.out;
}

}  // namespace
}  // namespace ortung::test
