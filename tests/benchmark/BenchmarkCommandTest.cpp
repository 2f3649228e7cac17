#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "Files.hpp"
#include "Program.hpp"

namespace ortung::test {
namespace {

void expectError(const std::vector<std::string>& arguments, int exitCode, const std::string& part) {
  const Outcome outcome = ortung(arguments);
  EXPECT_EQ(outcome.exitCode, exitCode) << outcome.err;
  EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST(BenchmarkCommand, PlaysWritesMergesAndVerifies) {
  const TemporaryFolder folder;
  const auto file = [&](const std::string& name) { return (folder.path() / name).string(); };
  const std::vector<std::string> play = {"benchmark",  "goalkeeper", "--keepers",  "still,mixed",
                                         "--strikers", "roll,shot",  "--episodes", "5",
                                         "--seed",     "9"};
  const auto with = [](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const Outcome whole = ortung(with(play, {"--json", file("all.json"), "--threads", "2"}));
  ASSERT_EQ(whole.exitCode, 0) << whole.err;
  EXPECT_NE(whole.out.find("5 episodes a pair, seed 9"), std::string::npos);
  for (const std::string part : {"1", "2"})
    ASSERT_EQ(ortung(with(play, {"--shard", part + "/2", "--json", file(part + ".part")})).exitCode,
              0);
  const Outcome merged =
      ortung({"merge", file("2.part"), file("1.part"), "--out", file("merged.json")});
  ASSERT_EQ(merged.exitCode, 0) << merged.err;
  EXPECT_EQ(merged.out, whole.out);
  EXPECT_EQ(readBytes(file("merged.json")), readBytes(file("all.json")));
  const Outcome same = ortung({"benchmark", "verify", file("all.json"), "--sample", "20"});
  EXPECT_EQ(same.exitCode, 0) << same.err;
  EXPECT_EQ(same.out, "20 of 20 episodes were played again, 0 with another result\n");

  const Outcome some = ortung({"benchmark", "verify", file("all.json"), "--sample", "7"});
  EXPECT_EQ(some.out, "7 of 20 episodes were played again, 0 with another result\n");

  auto json = nlohmann::ordered_json::parse(readBytes(file("all.json")));
  json["cells"][1]["count"]["goal"] = 6;
  json["cells"][3]["scoring"]["value"] = 1.5;
  writeBytes(file("figures.json"), json.dump());
  const Outcome wrong = ortung({"benchmark", "verify", file("figures.json"), "--sample", "1"});
  EXPECT_EQ(wrong.exitCode, 1);
  EXPECT_NE(wrong.err.find("figures.json: /cells/1/count/goal is 6, but the episodes give "),
            std::string::npos)
      << wrong.err;
  EXPECT_NE(wrong.err.find("/cells/3/scoring/value is 1.5, but"), std::string::npos) << wrong.err;
  EXPECT_EQ(wrong.out,
            "1 of 20 episodes were played again, 0 with another result\n"
            "2 figures are not those of the episodes\n");
  json = nlohmann::ordered_json::parse(readBytes(file("all.json")));
  std::string outcomes = json["cells"][1]["outcomes"];
  outcomes[2] = outcomes[2] == 'g' ? 's' : 'g';
  json["cells"][1]["outcomes"] = outcomes;
  writeBytes(file("bad.json"), json.dump());
  expectError({"benchmark", "verify", file("bad.json")}, 1, "its hash is");
  // Only its own results are overwritten.
  writeBytes(file("text.txt"), "mine");
  expectError(with(play, {"--json", file("text.txt")}), 1, "text.txt");
  // Results of before there were parts.
  EXPECT_EQ(ortung({"benchmark", "merge", file("all.json"), "--json", file("old.json")}).exitCode,
            0);
  EXPECT_EQ(readBytes(file("old.json")), readBytes(file("all.json")));
  EXPECT_EQ(ortung({"benchmark", "merge", file("2.part"), file("1.part")}).out, whole.out);
  expectError({"benchmark", "merge", file("1.part")}, 3, "missing: 2/2");
  expectError({"merge", file("1.part"), "--out", file("half.json")}, 3, "missing: 2/2");
}

TEST(BenchmarkCommand, ComparesWaysToSeeAndWritesAPage) {
  const TemporaryFolder folder;
  const std::string page = (folder.path() / "page.html").string();
  const Outcome played =
      ortung({"benchmark", "goalkeeper", "--keepers", "intercepting", "--sees", "truth,localized",
              "--strikers", "roll", "--episodes", "3", "--html", page});
  ASSERT_EQ(played.exitCode, 0) << played.err;
  EXPECT_NE(played.out.find("intercepting:sees=localized"), std::string::npos);
  EXPECT_NE(played.out.find("pose error of the keeper"), std::string::npos);
  EXPECT_NE(readBytes(page).find("<svg"), std::string::npos);
}

TEST(BenchmarkCommand, BadOptionsAreRefused) {
  const auto play = [](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"benchmark", "goalkeeper", "--episodes", "2"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  expectError(play({"--keepers", "lazy"}), 1, "no plugin 'lazy'");
  expectError(play({"--keepers", "goalkeeper:policy=lazy"}), 1, "policy is 'lazy'");
  expectError(play({"--strikers", "striker:kind=x"}), 1, "kind is 'x'");
  expectError(play({"--keepers", "still,still"}), 2, "twice");
  expectError(play({"--shard", "3"}), 2, "expected I/N");
  expectError(play({"--shard", "1/2"}), 2, "expected its name: --json");
  expectError(play({"--shard", "2/1"}), 2, "expected I from 1 to N");
  expectError(play({"--shard", "1/3"}), 2, "the shard is 1/3");
  expectError(play({"--threads", "0"}), 2, "--threads");
  expectError(play({"--sees", "little"}), 2, "see `ortung benchmark goalkeeper --help`");
  expectError(play({"--strikers", "shot:sees=scan"}), 1, "sees must be truth for the kind 'shot'");
  expectError(play({"--nothing"}), 2, "see `ortung benchmark goalkeeper --help`");
  expectError({"benchmark"}, 2, "subcommand");
  expectError({"benchmark", "verify", "/nothing/there"}, 1, "/nothing/there");
}

}  // namespace
}  // namespace ortung::test
