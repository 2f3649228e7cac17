// `ortung sim --digest`.
#include "Paths.hpp"
#include "Workspace.hpp"

namespace ortung::test {
namespace {

std::string digestOf(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"sim", ORTUNG_SOURCE_DIR "/maps/scenes/kick.toml",
                                       "--duration", "2", "--free-run", "--digest"});
  const Outcome outcome = ortung(arguments);
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  const std::size_t at = outcome.out.find("\ndigest ");
  EXPECT_NE(at, std::string::npos) << outcome.out;
  return outcome.out.substr(at + 1);
}

TEST_F(Workspace, DigestTellsRunsApartThatDidOtherThings) {
  const std::string digest = digestOf({});
  EXPECT_EQ(digest.size(), std::string("digest 0123456789abcdef\n").size());
  EXPECT_EQ(digestOf({"--threads", "2"}), digest);
  EXPECT_EQ(digestOf({"--trace", path("trace.csv")}), digest);
  EXPECT_NE(digestOf({"--seed", "2"}), digest);
  EXPECT_NE(digestOf({"--no-noise"}), digest);
  EXPECT_NE(digestOf({"--player", "wander:robot=pioneer.toml&start=5,-5,0"}), digest);
}

TEST_F(Workspace, DigestOfAServerIsRefused) {
  const Outcome outcome =
      ortung({"sim", ORTUNG_SOURCE_DIR "/maps/scenes/kick.toml", "--listen", "0", "--digest"});
  EXPECT_EQ(outcome.exitCode, 2);
  EXPECT_NE(outcome.err.find("--digest do not fit --listen"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace ortung::test
