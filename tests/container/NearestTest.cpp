#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "ortung/base/Nearest.hpp"

namespace ortung {
namespace {

const std::vector<std::string> kOptions = {"--world", "--robot", "--tables", "--out"};

TEST(Nearest, FindsWhatWasMeant) {
  EXPECT_EQ(nearest("--wrold", kOptions), "--world");  // swapped
  EXPECT_EQ(nearest("--tabels", kOptions), "--tables");
  EXPECT_EQ(nearest("--robt", kOptions), "--robot");   // left out
  EXPECT_EQ(nearest("--outt", kOptions), "--out");     // inserted
  EXPECT_EQ(nearest("--rabot", kOptions), "--robot");  // replaced
}

TEST(Nearest, DoesNotGuessWildly) {
  EXPECT_EQ(nearest("--frobnicate", kOptions), "");
  EXPECT_EQ(nearest("--report", std::vector<std::string>{"--record"}), "");
  EXPECT_EQ(nearest("", kOptions), "");
  EXPECT_EQ(nearest("x", {}), "");
  EXPECT_EQ(nearest(std::string(100000, 'a'), kOptions), "");
}

TEST(Nearest, KnowsKeysWithoutTheirUnits) {
  EXPECT_EQ(nearest("theta", std::vector<std::string>{"model", "theta_deg", "x_m"}), "theta_deg");
  EXPECT_EQ(nearest("x", std::vector<std::string>{"theta_deg", "x_m"}), "x_m");
}

TEST(Nearest, CountsASwapAsOneLetter) {
  // Two replaced letters of four are too many, one swap is not.
  EXPECT_EQ(nearest("badc", std::vector<std::string>{"abcd"}), "");
  EXPECT_EQ(nearest("abdc", std::vector<std::string>{"abcd"}), "abcd");
}

TEST(Nearest, SaysItInParentheses) {
  EXPECT_EQ(didYouMean("--wrold", kOptions), " (did you mean '--world'?)");
  EXPECT_EQ(didYouMean("--frobnicate", kOptions), "");
}

RC_GTEST_PROP(Nearest, AWordIsNearestToItself, (std::vector<std::string> words)) {
  for (const std::string& word : words)
    if (word.size() <= 256 && !word.empty()) RC_ASSERT(nearest(word, words) == word);
}

RC_GTEST_PROP(Nearest, OneLetterLessIsFound, ()) {
  const auto word =
      *rc::gen::container<std::string>(*rc::gen::inRange(4, 40), rc::gen::inRange('a', 'z'));
  std::string shorter = word;
  shorter.erase(*rc::gen::inRange<std::size_t>(0, word.size()), 1);
  RC_ASSERT(nearest(shorter, std::vector<std::string>{"0", word, "1"}) == word);
}

}  // namespace
}  // namespace ortung
