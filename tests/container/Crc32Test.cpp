#include <gtest/gtest.h>

#include <string_view>
#include <vector>

#include "Crc32.hpp"
#include "ortung/base/InstructionSet.hpp"
#include "ortung/base/Random.hpp"

namespace ortung::test {
namespace {

/// The remainder bit by bit, as ISO/IEC 8802-3 defines it.
std::uint32_t bitByBit(std::span<const std::byte> bytes) {
  std::uint32_t sum = 0xFFFFFFFF;
  for (const std::byte byte : bytes) {
    sum ^= static_cast<std::uint32_t>(byte);
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ ((sum & 1) != 0 ? 0xEDB88320 : 0);
  }
  return ~sum;
}

class Crc32 : public ::testing::TestWithParam<InstructionSet> {
 protected:
  void SetUp() override {
    if (!hasInstructionSet(GetParam())) GTEST_SKIP() << "this machine can't run it";
    useInstructionSet(GetParam());
  }
  void TearDown() override { useInstructionSet(std::nullopt); }
};

TEST_P(Crc32, HasTheCheckValueOfTheStandard) {
  constexpr std::string_view kDigits = "123456789";
  EXPECT_EQ(zip::crc32(std::as_bytes(std::span(kDigits))), 0xCBF43926U);
  EXPECT_EQ(zip::crc32({}), 0U);
}

TEST_P(Crc32, IsTheRemainderAtAnyPlaceAndLength) {
  Random random(3);
  std::vector<std::byte> bytes(1000);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random.uniform(0.0, 256.0));
  for (std::size_t length = 0; length <= 300; ++length) {
    const auto some = std::span(bytes).subspan(length % 67, length);
    EXPECT_EQ(zip::crc32(some), bitByBit(some)) << length;
  }
}

TEST_P(Crc32, OfPiecesIsThatOfTheWhole) {
  const std::vector<std::byte> bytes(500, std::byte{0xA5});
  const std::span all(bytes);
  for (std::size_t cut = 0; cut <= all.size(); cut += 7)
    EXPECT_EQ(zip::crc32(all.subspan(cut), zip::crc32(all.first(cut))), bitByBit(all)) << cut;
}

INSTANTIATE_TEST_SUITE_P(AllSets, Crc32,
                         ::testing::Values(InstructionSet::kPortable, InstructionSet::kAvx2,
                                           InstructionSet::kAvx512));

}  // namespace
}  // namespace ortung::test
