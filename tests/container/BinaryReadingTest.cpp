#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "Seeded.hpp"
#include "ortung/core/BinaryReading.hpp"

namespace ortung {
namespace {

std::string whyNot(std::string_view bytes) {
  const std::string_view before = bytes;
  std::string why;
  EXPECT_FALSE(parseBinary(bytes, &why).has_value());
  EXPECT_EQ(bytes, before);
  return why;
}

TEST(BinaryReading, IsALineAndFourBytesAWord) {
  std::string bytes;
  writeBinary({-7, {"cam", "camera", "image"}, {1, 0x04030201}}, bytes);
  EXPECT_EQ(bytes, std::string("-7 cam/camera/image 2\n\1\0\0\0\1\2\3\4", 30));
}

RC_GTEST_PROP(BinaryReadingProperty, ReadingsComeBackInTheirOrder, ()) {
  const auto words = *rc::gen::arbitrary<std::vector<std::vector<std::uint32_t>>>();
  std::string bytes;
  for (const auto& of : words)
    writeBinary({*rc::gen::arbitrary<Timestamp>(), {"a", "b", "c"}, of}, bytes);
  std::string_view rest = bytes;
  for (const auto& of : words) {
    const auto message = parseBinary(rest);
    RC_ASSERT(message.has_value());
    RC_ASSERT(message->words == of);
  }
  RC_ASSERT(rest.empty());
}

TEST(BinaryReading, WhatIsTornOrNoneIsRefused) {
  using namespace std::string_literals;
  EXPECT_EQ(whyNot(""), "the reading is torn: its line does not end");
  EXPECT_EQ(whyNot("1 a/b/c 1"), "the reading is torn: its line does not end");
  EXPECT_EQ(whyNot("1 a/b/c 1\n\1\0\0"s), "the reading is torn: words are missing");
  EXPECT_EQ(whyNot("1 a/b/c 16777216\nxxxx"), "the reading is torn: words are missing");
  for (const char* count : {"-1", "", "x", "16777217", "99999999999999999999"})
    EXPECT_EQ(whyNot("1 a/b/c "s + count + "\nxxxx"), "the number of words is none") << count;
  EXPECT_EQ(whyNot("nothing\n"), "found a line of less than three words");
  EXPECT_NE(whyNot("now a/b/c 0\n").find("expected a time stamp"), std::string::npos);
  EXPECT_NE(whyNot("1 a/b 0\n").find("'a/b'"), std::string::npos);
  EXPECT_EQ(whyNot("1 a/b/c 1 1\n\1\2\3\4"), "the number of words is none");
}

}  // namespace
}  // namespace ortung
