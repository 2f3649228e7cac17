#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "Files.hpp"
#include "Program.hpp"

namespace ortung::test {
namespace {

TEST(FootballCommand, PlaysWritesMergesAndVerifies) {
  const TemporaryFolder folder;
  const auto file = [&](const std::string& name) { return (folder.path() / name).string(); };
  const auto play = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {
        "benchmark", "football", "--teams",  "footballer", "--against", "footballer-v1",
        "--leagues", "f2000",    "--halves", "2",          "--half-s",  "3"};
    words.insert(words.end(), more.begin(), more.end());
    return ortung(words);
  };
  const Outcome whole = play({"--json", file("all.json")});
  ASSERT_EQ(whole.exitCode, 0) << whole.err;
  EXPECT_NE(whole.out.find("f2000: footballer against footballer-v1"), std::string::npos);
  EXPECT_NE(whole.out.find("nobody goes for the ball"), std::string::npos);
  EXPECT_NE(whole.out.find("f2000: ratings"), std::string::npos);
  for (const std::string part : {"1", "2"})
    ASSERT_EQ(play({"--shard", part + "/2", "--json", file(part + ".part")}).exitCode, 0);
  const Outcome merged =
      ortung({"merge", file("2.part"), file("1.part"), "--out", file("merged.json")});
  ASSERT_EQ(merged.exitCode, 0) << merged.err;
  EXPECT_EQ(merged.out, whole.out);
  EXPECT_EQ(readBytes(file("merged.json")), readBytes(file("all.json")));
  const Outcome same = ortung({"benchmark", "verify", file("all.json"), "--sample", "2"});
  EXPECT_EQ(same.exitCode, 0) << same.err;
  EXPECT_NE(same.out.find("2 of 2 halves were played again, 0 with another result"),
            std::string::npos)
      << same.out;
  auto json = nlohmann::ordered_json::parse(readBytes(file("all.json")));
  json["ratings"]["f2000"]["footballer"]["points"]["value"] = 123.0;
  writeBytes(file("rated.json"), json.dump(1));
  const Outcome rated = ortung({"benchmark", "verify", file("rated.json"), "--sample", "1"});
  EXPECT_EQ(rated.exitCode, 1);
  EXPECT_NE(rated.err.find("/ratings/f2000/footballer/points/value is 123.0"), std::string::npos)
      << rated.err;
  json["cells"][0]["halves"][0]["passes"][0] = 77;
  writeBytes(file("bad.json"), json.dump(1));
  const Outcome bad = ortung({"benchmark", "verify", file("bad.json")});
  EXPECT_EQ(bad.exitCode, 1);
  EXPECT_NE(bad.err.find("its hash is"), std::string::npos) << bad.err;
}

TEST(FootballCommand, BadOptionsAreRefused) {
  const Outcome team = ortung({"benchmark", "football", "--teams", "lazy", "--halves", "1"});
  EXPECT_EQ(team.exitCode, 1);
  EXPECT_NE(team.err.find("no plugin 'lazy'"), std::string::npos) << team.err;
  const Outcome named = ortung({"benchmark", "football", "--teams", "footballer@blue"});
  EXPECT_EQ(named.exitCode, 1);
  EXPECT_NE(named.err.find("the benchmark sets team"), std::string::npos) << named.err;
  EXPECT_EQ(ortung({"benchmark", "football", "--shard", "1/2"}).exitCode, 2) << "no --json";
}

}  // namespace
}  // namespace ortung::test
