#include <gtest/gtest.h>

#include "Files.hpp"
#include "TokenFile.hpp"

namespace ortung::app {
namespace {

class TokenFile : public testing::Test {
 protected:
  std::vector<BoardToken> read(const std::string& text) const {
    test::writeBytes(file(), text);
    return readTokens(file());
  }
  std::string refusal(const std::string& text) const {
    return test::messageOf<std::runtime_error>([&] { read(text); });
  }
  std::filesystem::path file() const { return folder_ / "tokens"; }
  test::TemporaryFolder folder_;
};

TEST_F(TokenFile, HasALineForEachNameAndMayHaveCommentsAndEmptyLines) {
  const auto tokens = read("# who may look\n\nview 12345678\n   \n  *\tabcdefgh-long  \n#x y\n");
  ASSERT_EQ(tokens.size(), 2u);
  EXPECT_EQ(tokens[0].name, "view");
  EXPECT_EQ(tokens[0].token, "12345678");
  EXPECT_EQ(tokens[1].name, "*");
  EXPECT_EQ(tokens[1].token, "abcdefgh-long");
}

TEST_F(TokenFile, ALineThatIsNoneIsNamedByItsNumber) {
  const std::string what =
      ": expected a client's name (or *) and its token of at least 8 characters";
  for (const char* line : {"view", "view 1234567", "view 12345678 more"})
    EXPECT_EQ(refusal("# one\na 12345678\n" + std::string(line) + "\n"),
              file().string() + ":3" + what)
        << line;
}

// A file is named to keep others out, so an empty one is an error.
TEST_F(TokenFile, NoFileMeansNoTokensButAFileWithoutTokensIsRefused) {
  EXPECT_TRUE(readTokens("").empty());
  EXPECT_EQ(refusal("# nobody\n\n"), file().string() + ": has no tokens");
  EXPECT_TRUE(test::messageOf<std::runtime_error>([&] {
                readTokens(folder_ / "none");
              }).starts_with((folder_ / "none").string() + ": "));
}

}  // namespace
}  // namespace ortung::app
