#include "Paths.hpp"
#include "Workspace.hpp"

namespace ortung::test {
namespace {

TEST(Usage, HelpOfEverySubcommandEndsWithAnExample) {
  for (const char* command :
       {"learn", "eval", "compare", "localize", "import", "show", "check", "plugins"}) {
    const Outcome outcome = ortung({command, "--help"});
    EXPECT_EQ(outcome.exitCode, 0) << command;
    const std::size_t example = outcome.out.find("Example:\n  ");
    ASSERT_NE(example, std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find(std::string("ortung ") + command, example), std::string::npos);
    EXPECT_GT(example, outcome.out.find("--help"));
  }
}

TEST(Usage, HelpNamesAllSubcommands) {
  const Outcome outcome = ortung({"--help"});
  EXPECT_EQ(outcome.exitCode, 0);
  for (const char* command :
       {"learn", "eval", "compare", "localize", "import", "show", "check", "plugins"}) {
    EXPECT_NE(outcome.out.find(std::string("  ") + command), std::string::npos) << command;
  }
}

TEST(Usage, VersionIsPrinted) {
  const Outcome outcome = ortung({"--version"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_TRUE(outcome.out.starts_with("ortung 0.")) << outcome.out;
}

TEST(Usage, WrongUsageEndsWithCode2AndOneLine) {
  expectRefused(ortung({}), 2, "ortung: ", {"--help"});
  expectRefused(ortung({"fly"}), 2, "ortung: ", {"fly"});
  expectRefused(ortung({"learn"}), 2, "ortung learn: ", {"--world", "is required"});
  expectRefused(ortung({"check", "--frobnicate", "x"}), 2, "ortung check: ", {"--frobnicate"});
  const std::string world = ORTUNG_SOURCE_DIR "/maps/fields/arena.toml";
  expectRefused(ortung({"sim", world, "--localize", "all"}), 2, "ortung sim: --localize",
                {"--listen"});
  expectRefused(ortung({"sim", world, "--listen", "0", "--localize", "bert"}), 2,
                "ortung sim: --localize", {"there is no robot 'bert'"});
}

class WrongNumber : public Workspace {};

TEST_F(WrongNumber, EndsWithCode2AndSaysWhatWasExpected) {
  const std::vector<std::string> learn = {"learn",         "--world",          path("hall.toml"),
                                          "--robot",       path("robot.toml"), "--out",
                                          path("t.ortung")};
  const auto with = [](std::vector<std::string> arguments, const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return ortung(arguments);
  };
  expectRefused(with(learn, {"--cell", "0"}), 2, "ortung learn: --cell", {"0.01 to 10"});
  expectRefused(with(learn, {"--cell", "nan"}), 2, "ortung learn: --cell", {"'nan'"});
  expectRefused(with(learn, {"--cell", "0.1m"}), 2, "ortung learn: --cell", {"'0.1m'"});
  expectRefused(with(learn, {"--heading-step", "7"}), 2, "ortung learn: --heading-step is 7",
                {"divide"});
  const std::vector<std::string> eval = {
      "eval",     "--source",         "record:" + path("none.rec"), "--robot", path("robot.toml"),
      "--tables", path("none.ortung")};
  expectRefused(with(eval, {"--particles", "0"}), 2, "ortung eval: --particles", {});
  expectRefused(with(eval, {"--particles", "1e300"}), 2, "ortung eval: --particles", {});
  expectRefused(with(eval, {"--converged-within", "0.5"}), 2, "ortung eval: --converged-within",
                {"\"m,deg\""});
  EXPECT_EQ(files(), (std::vector<std::string>{"hall.toml", "robot.toml"}));
}

TEST(Plugins, ListsWhatWasFoundAndWhere) {
  const Outcome outcome = ortung({"plugins"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.out;
  EXPECT_NE(outcome.out.find("SensorData   lrf"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("Source       sim"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("version"), std::string::npos);
}

class BrokenPlugin : public Workspace {};

TEST_F(BrokenPlugin, IsListedWithTheReason) {
  write("ortung_broken.so", "this is no shared library");
  const Outcome outcome = ortung({"plugins"}, {"ORTUNG_PLUGIN_PATH=" + folder_.string()});
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_NE(outcome.out.find("ortung_broken.so\n  BROKEN: "), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace ortung::test
