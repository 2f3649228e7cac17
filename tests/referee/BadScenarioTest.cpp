#include <gtest/gtest.h>

#include "Files.hpp"
#include "Paths.hpp"
#include "Scenario.hpp"

namespace ortung::test {
namespace {

const std::string kBegin =
    "[scenario]\nabout = \"x\"\n[referee]\nrules = \"msl\"\n[ball]\nat_m = [0, 0]\n"
    "[[robot]]\nname = \"b1\"\nteam = \"blue\"\npose = [-3, 0, 0]\n";

class BadScenarioTest : public testing::Test {
 protected:
  Scenario read(const std::string& text) {
    writeBytes(folder / "s.toml", text);
    return Scenario::read(folder / "s.toml", ORTUNG_SOURCE_DIR "/maps");
  }
  std::string errorOf(const std::string& text) {
    return messageOf<ConfigError>([&] { read(text); });
  }
  TemporaryFolder folder;
};

TEST_F(BadScenarioTest, SaysWhatIsWrongWithAFile) {
  EXPECT_NE(errorOf(kBegin).find("step is missing"), std::string::npos);
  EXPECT_NE(errorOf(kBegin + "[[step]]\nat_s = 1\nwhistle = 1\n").find("s.toml:13: whistle"),
            std::string::npos);
  EXPECT_NE(errorOf(kBegin + "[[step]]\nat_s = 1\n[[step]]\nat_s = 0\n").find("before the step"),
            std::string::npos);
  EXPECT_NE(errorOf(kBegin + "[[step]]\nat_s = 1\nexpect = { phase = \"half\" }\n").find("phase"),
            std::string::npos);
}

/// A test that can't fail is none: each kind of expectation is one that does not hold here.
TEST_F(BadScenarioTest, EveryExpectationCanFail) {
  const char* const kWrong[] = {"phase = \"playing\"",
                                "restart = \"corner\"",
                                "restart_of = \"yellow\"",
                                "score = [1, 0]",
                                "half = 2",
                                "clock_s = 5",
                                "left = \"yellow\"",
                                "ball_m = [1, 0]",
                                "ball_rests = false",
                                "robots = [{ name = \"b1\", at_m = [3, 0] }]",
                                "robots = [{ name = \"b1\", from_ball_m = 2 }]",
                                "robots = [{ name = \"b1\", in_own_half = false }]",
                                "robots = [{ name = \"b9\" }]",
                                "free = [\"b1\"]",
                                "held = [\"b9\"]",
                                "seen = [\"goal\"]",
                                "seen = [\"kick-off yellow\"]",
                                "unseen = [\"kick-off\"]"};
  for (const char* wrong : kWrong) {
    const auto problems = play(read(kBegin + "[[step]]\nat_s = 0\nexpect = { " + wrong + " }\n"));
    ASSERT_EQ(problems.size(), 1U) << wrong;
    EXPECT_EQ(problems[0].find("step 1 at 0.00 s"), 0U) << problems[0];
  }
  EXPECT_EQ(play(read(kBegin + "[[step]]\nat_s = 0\nrefused = \"start\"\n")).size(), 1U);
}

}  // namespace
}  // namespace ortung::test
