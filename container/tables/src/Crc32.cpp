#include "Crc32.hpp"

#include <array>
#include <cstring>

#include "ortung/base/InstructionSet.hpp"

#ifdef ORTUNG_X86
#include <immintrin.h>
#endif

// Sums are of the remainder alone, without the inversions at the beginning and the end of CRC-32.
namespace ortung::zip {
namespace {

constexpr std::uint32_t kPolynomial = 0xEDB88320;  // the lowest bit is the highest power

using Tables = std::array<std::array<std::uint32_t, 256>, 8>;

constexpr Tables makeTables() {
  Tables tables{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t sum = i;
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ ((sum & 1) ? kPolynomial : 0U);
    tables[0][i] = sum;
  }
  for (std::size_t t = 1; t < 8; ++t) {
    for (std::size_t i = 0; i < 256; ++i) {
      const std::uint32_t before = tables[t - 1][i];
      tables[t][i] = (before >> 8) ^ tables[0][before & 0xFF];
    }
  }
  return tables;
}

constexpr Tables kTables = makeTables();

/// Eight bytes at a time.
std::uint32_t addByTables(std::span<const std::byte> bytes, std::uint32_t sum) {
  std::size_t i = 0;
  for (; i + 8 <= bytes.size(); i += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, bytes.data() + i, 8);
    eight ^= sum;
    sum = kTables[7][eight & 0xFF] ^ kTables[6][(eight >> 8) & 0xFF] ^
          kTables[5][(eight >> 16) & 0xFF] ^ kTables[4][(eight >> 24) & 0xFF] ^
          kTables[3][(eight >> 32) & 0xFF] ^ kTables[2][(eight >> 40) & 0xFF] ^
          kTables[1][(eight >> 48) & 0xFF] ^ kTables[0][eight >> 56];
  }
  for (; i < bytes.size(); ++i)
    sum = (sum >> 8) ^ kTables[0][(sum ^ static_cast<std::uint32_t>(bytes[i])) & 0xFF];
  return sum;
}

#ifdef ORTUNG_X86

constexpr std::size_t kLanes = 4;
constexpr std::size_t kBlock = kLanes * sizeof(__m128i);

/// x^n modulo the polynomial, as factor of a carry-less product, which is one bit short.
constexpr std::int64_t powerOfX(int n) {
  std::uint32_t power = 1U << 31;
  for (; n > 0; --n) power = (power >> 1) ^ ((power & 1) ? kPolynomial : 0U);
  return static_cast<std::int64_t>(power) << 1;
}

/// The factors that move 128 bits by @p n further ones: of their first and their second half.
__m128i factors(int n) { return _mm_set_epi64x(powerOfX(n - 32), powerOfX(n + 32)); }

/// Moves 128 bits onto @p next. The product by the polynomial that was left out changes no sum.
__attribute__((target("pclmul"))) ORTUNG_INLINE __m128i fold(__m128i bits, __m128i factor,
                                                             __m128i next) {
  return _mm_xor_si128(_mm_xor_si128(_mm_clmulepi64_si128(bits, factor, 0x00), next),
                       _mm_clmulepi64_si128(bits, factor, 0x11));
}

/// Folds blocks onto the last of them (Gopal et al.: Fast CRC Computation for Generic Polynomials
/// Using PCLMULQDQ Instruction, Intel 2009). @pre at least one block, and whole ones alone
__attribute__((target("pclmul"))) std::uint32_t addByProducts(std::span<const std::byte> bytes,
                                                              std::uint32_t sum) {
  const auto* next = reinterpret_cast<const __m128i*>(bytes.data());
  __m128i lanes[kLanes];
  for (__m128i& lane : lanes) lane = _mm_loadu_si128(next++);
  lanes[0] = _mm_xor_si128(lanes[0], _mm_cvtsi32_si128(static_cast<int>(sum)));
  const __m128i byBlock = factors(8 * kBlock);
  for (std::size_t block = 1; block < bytes.size() / kBlock; ++block)
    for (__m128i& lane : lanes) lane = fold(lane, byBlock, _mm_loadu_si128(next++));
  const __m128i byLane = factors(8 * sizeof(__m128i));
  __m128i all = lanes[0];
  for (std::size_t i = 1; i < kLanes; ++i) all = fold(all, byLane, lanes[i]);
  std::array<std::byte, sizeof all> rest;
  std::memcpy(rest.data(), &all, sizeof all);
  return addByTables(rest, 0);
}

bool hasProducts() {
  static const bool kHas = __builtin_cpu_supports("pclmul") != 0;
  return kHas && instructionSet() != InstructionSet::kPortable;
}

#endif

}  // namespace

std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t crc) {
  std::uint32_t sum = ~crc;
#ifdef ORTUNG_X86
  if (const std::size_t whole = bytes.size() / kBlock * kBlock; whole > 0 && hasProducts()) {
    sum = addByProducts(bytes.first(whole), sum);
    bytes = bytes.subspan(whole);
  }
#endif
  return ~addByTables(bytes, sum);
}

}  // namespace ortung::zip
