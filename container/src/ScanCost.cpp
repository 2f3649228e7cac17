#include "ScanCost.hpp"

#include <algorithm>
#include <cstdlib>

#ifdef ORTUNG_X86
#include <immintrin.h>
#endif

namespace ortung {
namespace {

void portable(const ScanReading& reading, std::span<const std::uint8_t* const> rows, std::uint32_t* costs) {
  const std::size_t n = reading.levels.size();
  const std::uint8_t* levels = reading.levels.data();
  const std::uint8_t* caps = reading.caps.data();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::uint32_t sum = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const int difference = std::abs(int{rows[i][j]} - int{levels[j]});
      const std::uint8_t cost = reading.costs[static_cast<std::size_t>(std::min(difference, 31))];
      sum += std::min(cost, caps[j]);
    }
    costs[i] = sum;
  }
}

#ifdef ORTUNG_X86

// A shuffle looks up 16 entries at once; two and a blend make the table of 32.
ORTUNG_AVX2 void avx2(const ScanReading& reading,
                                          std::span<const std::uint8_t* const> rows, std::uint32_t* costs) {
  const auto* table = reinterpret_cast<const __m128i*>(reading.costs.data());
  const __m256i low = _mm256_broadcastsi128_si256(_mm_loadu_si128(table));
  const __m256i high = _mm256_broadcastsi128_si256(_mm_loadu_si128(table + 1));
  const __m256i last = _mm256_set1_epi8(31);
  const __m256i fifteen = _mm256_set1_epi8(15);
  const std::size_t n = reading.levels.size();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    __m256i sum = _mm256_setzero_si256();
    for (std::size_t j = 0; j < n; j += 32) {
      const __m256i e = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(rows[i] + j));
      const __m256i z = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(reading.levels.data() + j));
      const __m256i cap = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(reading.caps.data() + j));
      const __m256i distance = _mm256_or_si256(_mm256_subs_epu8(e, z), _mm256_subs_epu8(z, e));
      const __m256i index = _mm256_min_epu8(distance, last);
      const __m256i cost =
          _mm256_blendv_epi8(_mm256_shuffle_epi8(low, index), _mm256_shuffle_epi8(high, index),
                             _mm256_cmpgt_epi8(index, fifteen));
      sum = _mm256_add_epi64(sum, _mm256_sad_epu8(_mm256_min_epu8(cost, cap), _mm256_setzero_si256()));
    }
    const __m128i half = _mm_add_epi64(_mm256_castsi256_si128(sum), _mm256_extracti128_si256(sum, 1));
    costs[i] = static_cast<std::uint32_t>(_mm_cvtsi128_si64(half) + _mm_extract_epi64(half, 1));
  }
}

// GCC 12 warns of its own headers' deliberately undefined registers.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
ORTUNG_AVX512 void avx512(const ScanReading& reading,
                                                        std::span<const std::uint8_t* const> rows,
                                                        std::uint32_t* costs) {
  const auto* table = reinterpret_cast<const __m128i*>(reading.costs.data());
  const __m512i low = _mm512_broadcast_i32x4(_mm_loadu_si128(table));
  const __m512i high = _mm512_broadcast_i32x4(_mm_loadu_si128(table + 1));
  const __m512i last = _mm512_set1_epi8(31);
  const __m512i fifteen = _mm512_set1_epi8(15);
  const std::size_t n = reading.levels.size();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    __m512i sum = _mm512_setzero_si512();
    for (std::size_t j = 0; j < n; j += 64) {
      const __m512i e = _mm512_loadu_si512(rows[i] + j);
      const __m512i z = _mm512_loadu_si512(reading.levels.data() + j);
      const __m512i cap = _mm512_loadu_si512(reading.caps.data() + j);
      const __m512i distance = _mm512_or_si512(_mm512_subs_epu8(e, z), _mm512_subs_epu8(z, e));
      const __m512i index = _mm512_min_epu8(distance, last);
      const __m512i cost = _mm512_mask_shuffle_epi8(_mm512_shuffle_epi8(low, index),
                                                    _mm512_cmpgt_epu8_mask(index, fifteen), high, index);
      sum = _mm512_add_epi64(sum, _mm512_sad_epu8(_mm512_min_epu8(cost, cap), _mm512_setzero_si512()));
    }
    costs[i] = static_cast<std::uint32_t>(_mm512_reduce_add_epi64(sum));
  }
}
#pragma GCC diagnostic pop

#endif

}  // namespace

ScanCostKernel scanCostKernel(InstructionSet set) {
  if (!hasInstructionSet(set)) return nullptr;
#ifdef ORTUNG_X86
  if (set == InstructionSet::kAvx2) return avx2;
  if (set == InstructionSet::kAvx512) return avx512;
#endif
  return portable;
}

ScanCostKernel scanCostKernel() { return scanCostKernel(instructionSet()); }

}  // namespace ortung
