#include <gtest/gtest.h>

#include "Base64.hpp"

namespace ortung::app {
namespace {

std::string encoded(const std::string& bytes) { return base64(std::as_bytes(std::span(bytes))); }

// RFC 4648, section 10.
TEST(Base64, IsThatOfItsStandard) {
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foob"), "Zm9vYg==");
  EXPECT_EQ(encoded("fooba"), "Zm9vYmE=");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

// 111110 111111 111100, and all bits zero.
TEST(Base64, BytesThatAreNoTextAreEncodedLikeOthers) {
  EXPECT_EQ(encoded("\xFB\xFF"), "+/8=");
  EXPECT_EQ(encoded(std::string(4, '\0')), "AAAAAA==");
}

}  // namespace
}  // namespace ortung::app
