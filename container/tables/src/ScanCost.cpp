#include "ScanCost.hpp"

#include "PortableScanCost.hpp"
#ifdef ORTUNG_X86
#include <immintrin.h>
#endif

namespace ortung {
namespace {

#ifdef ORTUNG_X86

// A shuffle looks up 16 entries at once; two and a blend make the table of 32.
template <bool kHasSteps>
ORTUNG_AVX2 void avx2(const ScanReading& reading, std::span<const std::uint8_t* const> rows,
                      std::uint32_t* costs) {
  const auto* table = reinterpret_cast<const __m128i*>(reading.costs.data());
  const __m256i low = _mm256_broadcastsi128_si256(_mm_loadu_si128(table));
  const __m256i high = _mm256_broadcastsi128_si256(_mm_loadu_si128(table + 1));
  const __m256i last = _mm256_set1_epi8(31);
  const __m256i fifteen = _mm256_set1_epi8(15);
  const __m256i half = _mm256_set1_epi16(static_cast<std::int16_t>((1 << reading.shift) / 2));
  const __m128i shift = _mm_cvtsi32_si128(reading.shift);
  const __m256i lowBytes = _mm256_set1_epi16(0xFF);
  const std::size_t n = usedLength(reading);  // up to 31 more are read, whose caps are 0
  for (std::size_t i = 0; i < rows.size(); ++i) {
    __m256i sum = _mm256_setzero_si256();
    for (std::size_t j = 0; j < n; j += 32) {
      const __m256i e = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(rows[i] + j));
      const __m256i z =
          _mm256_loadu_si256(reinterpret_cast<const __m256i*>(reading.levels.data() + j));
      const __m256i cap =
          _mm256_loadu_si256(reinterpret_cast<const __m256i*>(reading.caps.data() + j));
      __m256i distance = _mm256_or_si256(_mm256_subs_epu8(e, z), _mm256_subs_epu8(z, e));
      if constexpr (kHasSteps) {  // even and odd bytes apart, as products have 16 bits
        const __m256i step =
            _mm256_loadu_si256(reinterpret_cast<const __m256i*>(reading.steps.data() + j));
        const __m256i even = _mm256_add_epi16(
            _mm256_maddubs_epi16(distance, _mm256_and_si256(step, lowBytes)), half);
        const __m256i odd = _mm256_add_epi16(
            _mm256_maddubs_epi16(distance, _mm256_andnot_si256(lowBytes, step)), half);
        distance = _mm256_or_si256(
            _mm256_min_epi16(_mm256_srl_epi16(even, shift), lowBytes),
            _mm256_slli_epi16(_mm256_min_epi16(_mm256_srl_epi16(odd, shift), lowBytes), 8));
      }
      const __m256i index = _mm256_min_epu8(distance, last);
      const __m256i cost =
          _mm256_blendv_epi8(_mm256_shuffle_epi8(low, index), _mm256_shuffle_epi8(high, index),
                             _mm256_cmpgt_epi8(index, fifteen));
      sum = _mm256_add_epi64(sum,
                             _mm256_sad_epu8(_mm256_min_epu8(cost, cap), _mm256_setzero_si256()));
    }
    const __m128i both =
        _mm_add_epi64(_mm256_castsi256_si128(sum), _mm256_extracti128_si256(sum, 1));
    costs[i] = static_cast<std::uint32_t>(_mm_cvtsi128_si64(both) + _mm_extract_epi64(both, 1));
  }
}

// GCC 12 warns of its own headers' deliberately undefined registers.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
template <bool kHasSteps>
ORTUNG_AVX512 void avx512(const ScanReading& reading, std::span<const std::uint8_t* const> rows,
                          std::uint32_t* costs) {
  const auto* table = reinterpret_cast<const __m128i*>(reading.costs.data());
  const __m512i low = _mm512_broadcast_i32x4(_mm_loadu_si128(table));
  const __m512i high = _mm512_broadcast_i32x4(_mm_loadu_si128(table + 1));
  const __m512i last = _mm512_set1_epi8(31);
  const __m512i fifteen = _mm512_set1_epi8(15);
  const __m512i half = _mm512_set1_epi16(static_cast<std::int16_t>((1 << reading.shift) / 2));
  const __m128i shift = _mm_cvtsi32_si128(reading.shift);
  const __m512i lowBytes = _mm512_set1_epi16(0xFF);
  const std::size_t n = usedLength(reading);
  const auto add = [&](__m512i sum, __m512i e, std::size_t j) ORTUNG_AVX512 {
    const __m512i z = _mm512_loadu_si512(reading.levels.data() + j);
    const __m512i cap = _mm512_loadu_si512(reading.caps.data() + j);
    __m512i distance = _mm512_or_si512(_mm512_subs_epu8(e, z), _mm512_subs_epu8(z, e));
    if constexpr (kHasSteps) {
      const __m512i step = _mm512_loadu_si512(reading.steps.data() + j);
      const __m512i even =
          _mm512_add_epi16(_mm512_maddubs_epi16(distance, _mm512_and_si512(step, lowBytes)), half);
      const __m512i odd = _mm512_add_epi16(
          _mm512_maddubs_epi16(distance, _mm512_andnot_si512(lowBytes, step)), half);
      distance = _mm512_or_si512(
          _mm512_min_epi16(_mm512_srl_epi16(even, shift), lowBytes),
          _mm512_slli_epi16(_mm512_min_epi16(_mm512_srl_epi16(odd, shift), lowBytes), 8));
    }
    const __m512i index = _mm512_min_epu8(distance, last);
    const __m512i cost = _mm512_mask_shuffle_epi8(
        _mm512_shuffle_epi8(low, index), _mm512_cmpgt_epu8_mask(index, fifteen), high, index);
    return _mm512_add_epi64(sum,
                            _mm512_sad_epu8(_mm512_min_epu8(cost, cap), _mm512_setzero_si512()));
  };
  const std::size_t whole = n / 64 * 64;
  const __mmask64 rest = (1ULL << (n - whole)) - 1;  // later bytes are not fetched
  for (std::size_t i = 0; i < rows.size(); ++i) {
    __m512i sum = _mm512_setzero_si512();
    for (std::size_t j = 0; j < whole; j += 64) sum = add(sum, _mm512_loadu_si512(rows[i] + j), j);
    if (rest != 0) sum = add(sum, _mm512_maskz_loadu_epi8(rest, rows[i] + whole), whole);
    costs[i] = static_cast<std::uint32_t>(_mm512_reduce_add_epi64(sum));
  }
}
#pragma GCC diagnostic pop

/// Calls the one of two kernels that a reading needs.
template <ScanCostKernel kWhole, ScanCostKernel kStepped>
void eitherOf(const ScanReading& reading, std::span<const std::uint8_t* const> rows,
              std::uint32_t* costs) {
  (reading.steps.empty() ? kWhole : kStepped)(reading, rows, costs);
}

#endif

}  // namespace

ScanCostKernel scanCostKernel(InstructionSet set) {
  if (!hasInstructionSet(set)) return nullptr;
#ifdef ORTUNG_X86
  if (set == InstructionSet::kAvx2) return eitherOf<avx2<false>, avx2<true>>;
  if (set == InstructionSet::kAvx512) return eitherOf<avx512<false>, avx512<true>>;
#elif defined(ORTUNG_NEON)
  if (set == InstructionSet::kNeon) return scanCostNeon;
#endif
  return portableScanCost;
}

ScanCostKernel scanCostKernel() { return scanCostKernel(instructionSet()); }

}  // namespace ortung
