#include <gtest/gtest.h>

#include <set>

#include "SweepFile.hpp"
#include "ortung/base/Parameters.hpp"

namespace ortung::app {
namespace {

SweepFile sweep(const std::string& text) { return {text, "s.toml", "/tmp"}; }

std::string refusal(const std::string& text) {
  try {
    sweep(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "(nothing was thrown)";
}

TEST(SweepFile, HasAllCombinationsTheLastKeyFastest) {
  const SweepFile file =
      sweep(R"(command = ["eval", "--set", "mcl.particles={n}", "--seed", "{seed}"]
[vary]
n = [500, 2000]
seed = "1..3"
)");
  ASSERT_EQ(file.size(), 6u);
  EXPECT_EQ(file.keys(), (std::vector<std::string>{"n", "seed"})) << "in the order of the file";
  EXPECT_EQ(file.task(0).name, "n=500,seed=1");
  EXPECT_EQ(file.task(1).name, "n=500,seed=2");
  EXPECT_EQ(file.task(5).name, "n=2000,seed=3");
  EXPECT_EQ(file.task(4).words,
            (std::vector<std::string>{"eval", "--set", "mcl.particles=2000", "--seed", "2"}));
  EXPECT_EQ(file.task(4).values, (std::vector<std::string>{"2000", "2"}));
  EXPECT_EQ(file.command(), "eval");
}

TEST(SweepFile, ListsStandForWordsAndTablesForFields) {
  const SweepFile file = sweep(R"(
command = ["eval", "--source", "record:{log.file}?robot={log.robot}", "{fault}", "x{log}"]
[vary]
log = [{ name = "a", file = "a.rec", robot = 1 }, { name = "b", file = "b.rec", robot = 2.5 }]
fault = [[], ["--fault", "readings=crowd"]]
)");
  EXPECT_EQ(file.task(0).words,
            (std::vector<std::string>{"eval", "--source", "record:a.rec?robot=1", "xa"}));
  EXPECT_EQ(file.task(0).name, "log=a,fault=none");
  EXPECT_EQ(file.task(3).words,
            (std::vector<std::string>{"eval", "--source", "record:b.rec?robot=2.5", "--fault",
                                      "readings=crowd", "xb"}));
  EXPECT_EQ(file.task(3).name, "log=b,fault=--fault readings=crowd");
}

// So that what is lengthy has a short name in tables.
TEST(SweepFile, FieldsMayBeListsAndHoldOtherKeys) {
  const SweepFile file = sweep(R"(
command = ["eval", "--source", "{log.source}", "{what.words}"]
[vary]
log = [{ name = "hall", source = "sim:hall.toml?seed={seed}" }]
what = [{ name = "crowd", words = ["--fault", "readings=crowd@{seed}"] }, { name = "none", words = [] }]
seed = "3..4"
)");
  ASSERT_EQ(file.size(), 4u);
  EXPECT_EQ(file.task(1).name, "log=hall,what=crowd,seed=4");
  EXPECT_EQ(file.task(1).words,
            (std::vector<std::string>{"eval", "--source", "sim:hall.toml?seed=4", "--fault",
                                      "readings=crowd@4"}));
  EXPECT_EQ(file.task(2).words,
            (std::vector<std::string>{"eval", "--source", "sim:hall.toml?seed=3"}));
}

TEST(SweepFile, IdsAreOfWordsAloneSoThatMoreValuesChangeNone) {
  const std::string command = R"(command = ["eval", "--seed", "{seed}"]
[vary]
seed = )";
  const SweepFile few = sweep(command + "[3, 4]");
  const SweepFile many = sweep(command + "\"1..9\"");
  EXPECT_EQ(few.task(0).id, many.task(2).id);
  std::set<std::string> ids;
  for (std::size_t i = 0; i < many.size(); ++i) ids.insert(many.task(i).id);
  EXPECT_EQ(ids.size(), 9u);
  for (const std::string& id : ids) EXPECT_EQ(id.size(), 16u);
}

TEST(SweepFile, WithoutValuesHasOneTask) {
  const SweepFile file = sweep(R"(command = ["benchmark", "goalkeeper", "--episodes", "5"])");
  ASSERT_EQ(file.size(), 1u);
  EXPECT_EQ(file.task(0).name, "all");
  EXPECT_EQ(file.command(), "benchmark goalkeeper");
}

TEST(SweepFile, SaysWhatIsWrongWhereAndWhatWasExpected) {
  const std::string eval = "command = [\"eval\", \"{a}\"]\n[vary]\n";
  EXPECT_EQ(refusal(""), "s.toml: has no list of words named command");
  EXPECT_EQ(refusal("command = [\"learn\"]"),
            "s.toml:1: expected a command with figures: eval, or benchmark goalkeeper");
  EXPECT_EQ(refusal("command = [\"eval\", \"--json\", \"x\"]"),
            "s.toml:1: --json is the sweep's own");
  EXPECT_EQ(refusal("command = [\"eval\"]\nmore = 1"),
            "s.toml:2: 'more' is not known, expected command and [vary]");
  EXPECT_EQ(refusal(eval + "b = [1]"), "s.toml: b is varied, but {b} stands nowhere in command");
  EXPECT_EQ(refusal("command = [\"eval\", \"{a}\", \"{c}\"]\n[vary]\na = [1]"),
            "s.toml: nothing fills {c} of '{c}' in command");
  EXPECT_EQ(refusal("command = [\"eval\", \"{a.robot}\"]\n[vary]\na = [1]"),
            "s.toml: nothing fills {a.robot} of '{a.robot}' in command");
  EXPECT_EQ(refusal(eval + "a = []"),
            "s.toml:3: a: expected a list of values, or a range as \"1..20\"");
  EXPECT_EQ(refusal(eval + "a = \"5..1\""),
            "s.toml:3: a: expected a list of values, or a range as \"1..20\"");
  EXPECT_EQ(refusal(eval + "a = [1, 1]"), "s.toml:3: a: has the value '1' twice");
  EXPECT_EQ(refusal(eval + "a = [{ file = 1 }]"), "s.toml:3: a: a table needs a name");
  EXPECT_EQ(refusal(eval + "a = [[[1]]]"), "s.toml:3: a: expected a number or a text");
  EXPECT_EQ(refusal(eval + "a = [{ name = 1, words = [[1]] }]"),
            "s.toml:3: a.words: expected a number or a text");
  EXPECT_EQ(refusal(eval + "a = [\"x{sed}\"]"), "s.toml: nothing fills {sed} of '{a}' in command");
  EXPECT_EQ(refusal(eval + "a = [\"x{a}\"]"), "s.toml: nothing fills {x{a}} of '{a}' in command");
  EXPECT_NE(refusal("command = [").find("s.toml:1"), std::string::npos);
  EXPECT_NE(refusal("command = [\"eval\", \"{a}\", \"{b}\", \"{c}\"]\n[vary]\na = \"1..1000\"\n"
                    "b = \"1..1000\"\nc = \"1..1000\"")
                .find("more than 10000000 tasks"),
            std::string::npos);
}

}  // namespace
}  // namespace ortung::app
