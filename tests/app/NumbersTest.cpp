#include <gtest/gtest.h>

#include "Console.hpp"
#include "Numbers.hpp"

namespace ortung::app {
namespace {

TEST(Numbers, ReadsAsManyAsAreNamed) {
  EXPECT_EQ(parseNumbers("1,-2.5,9e1", "--start", {"x", "y", "theta_deg"}),
            (std::vector<double>{1.0, -2.5, 90.0}));
}

TEST(Numbers, RefusesEverythingElse) {
  for (const char* text : {"", "1", "1,2,3", "1,", ",1", "1 ,2", "a,b", "nan,1", "inf,1", "1,2x"}) {
    EXPECT_THROW(parseNumbers(text, "--start-sigma", {"m", "deg"}), UsageError) << text;
  }
}

TEST(Console, TextWithControlCharactersBecomesPrintable) {
  EXPECT_EQ(printable("a\033[2Jb\n"), "a\\x1b[2Jb\\x0a");
  EXPECT_EQ(printable("\xC2\x9B"
                      "1m"),
            "\xC2\\x9b1m");  // the one-character form of ESC [
  EXPECT_EQ(printable("M\xC3\xBCnchen"), "M\xC3\xBCnchen");
}

}  // namespace
}  // namespace ortung::app
