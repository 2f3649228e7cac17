#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "ortung/base/Random.hpp"
#include "ortung/devices/BaseLines.hpp"

namespace ortung {
namespace {

using namespace base_lines;

constexpr double kDegree = std::numbers::pi / 180.0;

/// CRC-16/CCITT-FALSE bit by bit, as its definition has it.
unsigned checksum(std::string_view text) {
  unsigned crc = 0xFFFF;
  for (const char c : text) {
    crc ^= static_cast<unsigned>(static_cast<unsigned char>(c)) << 8;
    for (int bit = 0; bit < 8; ++bit) {
      crc <<= 1;
      if ((crc & 0x10000U) != 0) crc ^= 0x11021U;
    }
  }
  return crc;
}

std::string framed(const std::string& body) {
  std::array<char, 8> sum{};
  std::snprintf(sum.data(), sum.size(), "*%04X", checksum(body));
  return "$" + body + sum.data();
}

TEST(BaseLines, AreAsTheDocumentSays) {
  ASSERT_EQ(checksum("123456789"), 0x29B1U);  // the CRC's published check value
  const Odometry wheels{1234, {1.5, -0.25, 90 * kDegree}, 0.3, -10 * kDegree, 0.0, {7, 8}};
  EXPECT_EQ(encode(wheels), framed("O,1234,1500,-250,9000,300,-1000,0,7,8") + "\r\n");
  EXPECT_EQ(encode(Sonars{50, 4, {1200, 0}}), framed("S,50,4,1200,0") + "\r\n");
  EXPECT_EQ(encode(Identity{1, 16}), framed("I,1,16") + "\r\n");
  EXPECT_EQ(encode(Velocity{-0.5, 45 * kDegree}), framed("V,-500,4500") + "\r\n");
  EXPECT_EQ(encode(Question{}), framed("?I") + "\r\n");
}

TEST(BaseLines, AreReadAsTheyWereWritten) {
  const auto wheels = decode(framed("O,4294967295,-1500,250,-17999,300,-1000,-40,1,4294967295"));
  ASSERT_TRUE(wheels);
  const auto& o = std::get<Odometry>(*wheels);
  EXPECT_EQ(o.time, 4294967295U);
  EXPECT_DOUBLE_EQ(o.pose.x, -1.5);
  EXPECT_NEAR(o.pose.theta, -179.99 * kDegree, 1e-12);
  EXPECT_DOUBLE_EQ(o.lateralVelocity, -0.04);
  EXPECT_EQ(o.motionData, (std::vector<std::uint32_t>{1, 4294967295U}));
  const auto ring = decode(framed("S,9,60,1,2,3,4"));
  ASSERT_TRUE(ring);
  EXPECT_EQ(std::get<Sonars>(*ring).echoes.size(), 4U);
}

TEST(BaseLines, OfOtherThingsAreNone) {
  for (const char* const body :
       {"O,1,2,3", "O,-1,0,0,0,0,0,0", "O,1,0,0,0,0,0,0,-5", "O,1,3000000000,0,0,0,0,0",
        "S,9,61,1,2,3,4", "S,9,0", "I,1,65", "I,1", "V,1", "V,1,2,3", "X,1", "", "O,1,2,3,4,5,6,7,",
        "O,1,,3,4,5,6,7", "O,1,2,3,4,5,6,0x7", "S,1,0,99999999999999999999"})
    EXPECT_FALSE(decode(framed(body))) << body;
  std::string right = framed("I,1,16");
  EXPECT_FALSE(decode(right.substr(1)));
  EXPECT_FALSE(decode(right + " "));
  EXPECT_TRUE(decode("\x7F$\x01" + right));
  right[1] = 'J';
  EXPECT_FALSE(decode(right));
}

TEST(BaseLines, WithAFlippedBitAreNone) {
  const std::string right = framed("O,1234,1500,-250,9000,300,-1000,0");
  for (std::size_t i = 0; i < right.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string wrong = right;
      wrong[i] = static_cast<char>(wrong[i] ^ (1 << bit));
      // A digit of the checksum may be written as a small letter, which is the same number.
      if (i + 4 >= right.size() && bit == 5) continue;
      EXPECT_FALSE(decode(wrong)) << i << " " << bit;
    }
  }
}

TEST(LineCutter, CutsLinesWhereverTheBytesAreCut) {
  const std::string bytes = "one\r\ntwo\n\nfour\r\n";
  for (std::size_t size = 1; size <= bytes.size(); ++size) {
    LineCutter cutter(10);
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < bytes.size(); i += size) {
      cutter.add(bytes.substr(i, size));
      while (const auto line = cutter.next()) lines.push_back(*line);
    }
    EXPECT_EQ(lines, (std::vector<std::string>{"one", "two", "", "four"}));
  }
}

TEST(LineCutter, ThrowsAwayWhatIsTooLongAndGoesOn) {
  LineCutter cutter(10);
  for (int i = 0; i < 1000; ++i) {
    cutter.add("0123456789");
    EXPECT_FALSE(cutter.next());
  }
  cutter.add("end\nright\n");
  EXPECT_EQ(cutter.next(), "right");
  EXPECT_EQ(cutter.refused(), 1U);
  cutter.add("01234567890\n");
  EXPECT_FALSE(cutter.next());
  EXPECT_EQ(cutter.refused(), 2U);
}

TEST(LineCutter, FindsTelegramsInGarbage) {
  Random random(5);
  LineCutter cutter(kLongest);
  std::size_t found = 0;
  constexpr std::size_t kSent = 1000;
  for (std::size_t i = 0; i < kSent; ++i) {
    std::string noise;
    for (int n = 0; n < 20; ++n)
      noise += static_cast<char>(static_cast<int>(random.uniform(0.0, 256.0)));
    cutter.add(noise + encode(Sonars{static_cast<std::uint32_t>(i), 0, {1000}}));
    while (const auto line = cutter.next()) {
      const auto telegram = decode(*line);
      if (!telegram) continue;
      EXPECT_EQ(std::get<Sonars>(*telegram).time, i);
      ++found;
    }
  }
  EXPECT_EQ(found, kSent);
}

}  // namespace
}  // namespace ortung
