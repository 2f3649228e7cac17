#include "DifferenceKernel.hpp"

#include "LevelDifference.hpp"
#ifdef ORTUNG_X86
#include <immintrin.h>
#endif

namespace ortung {
namespace {

void portable(const LevelsAround& around, const std::int16_t* reading, std::size_t n,
              std::uint8_t* differences) {
  LevelDifferences::run(around, reading, n, differences);
}

#ifdef ORTUNG_X86

static_assert(LevelsAround::kWhole == 128 && kPartsALevel == 4);
constexpr std::size_t kBeams = 32;  ///< of one vector of bytes
static_assert(LevelDifferences::kBlock % kBeams == 0);

ORTUNG_AVX2 ORTUNG_INLINE __m256i load(const std::uint8_t* levels) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(levels));
}

/// Eight beams, and eight of those 16 beams later: the order of bytes that were unpacked.
ORTUNG_AVX2 ORTUNG_INLINE __m256i loadApart(const std::int16_t* reading) {
  const auto* eight = reinterpret_cast<const __m128i*>(reading);
  return _mm256_inserti128_si256(_mm256_castsi128_si256(_mm_loadu_si128(eight)),
                                 _mm_loadu_si128(eight + 2), 1);
}

/// Differences from the means. @param negative the negative sums of levels times weights
ORTUNG_AVX2 ORTUNG_INLINE __m256i ofOne(__m256i reading, __m256i negative) {
  constexpr int kShift = 5;  // from sums to parts of a level
  const __m256i half = _mm256_set1_epi16(1 << (kShift - 1));
  const __m256i mean = _mm256_srli_epi16(_mm256_sub_epi16(half, negative), kShift);
  return _mm256_abs_epi16(_mm256_sub_epi16(reading, mean));
}

/// Differences from the nearer one of two surfaces. @param extremes the least and the greatest
/// level of each beam
ORTUNG_AVX2 ORTUNG_INLINE __m256i ofTwo(__m256i reading, __m256i extremes) {
  const __m256i low = _mm256_maddubs_epi16(extremes, _mm256_set1_epi16(0x00FC));   // times -4, 0
  const __m256i high = _mm256_maddubs_epi16(extremes, _mm256_set1_epi16(0x0400));  // times 0, 4
  const __m256i within =
      _mm256_min_epi16(_mm256_add_epi16(reading, low), _mm256_sub_epi16(high, reading));
  // How far that is from the stretch [0, 2 half].
  const __m256i half = _mm256_set1_epi16(kAlongOneSurface * kPartsALevel / 2);
  return _mm256_subs_epu16(_mm256_abs_epi16(_mm256_sub_epi16(within, half)), half);
}

/// What is around a pose in the directions of kBeams beams.
struct Mixes {
  __m256i sums;       ///< of the beams 0 to 7 and 16 to 23, negative
  __m256i laterSums;  ///< of the others
  __m256i low;        ///< least level by beam
  __m256i high;
};

/// Differences of kBeams beams.
ORTUNG_AVX2 ORTUNG_INLINE __m256i differencesOf(const Mixes& mix, const std::int16_t* reading) {
  const __m256i early = loadApart(reading);
  const __m256i later = loadApart(reading + 8);
  const __m256i one = _mm256_packus_epi16(ofOne(early, mix.sums), ofOne(later, mix.laterSums));
  const __m256i two = _mm256_packus_epi16(ofTwo(early, _mm256_unpacklo_epi8(mix.low, mix.high)),
                                          ofTwo(later, _mm256_unpackhi_epi8(mix.low, mix.high)));
  const __m256i width = _mm256_sub_epi8(mix.high, mix.low);
  const __m256i isOne =
      _mm256_cmpeq_epi8(_mm256_min_epu8(width, _mm256_set1_epi8(kMostOnOneSurface)), width);
  return _mm256_min_epu8(one, _mm256_or_si256(two, isOne));
}

/// One instruction mixes two directions of a cell, as bytes: levels times weights. A weight of 128
/// has no positive byte with a sign, so weights are negative.
ORTUNG_AVX2 void avx2(const LevelsAround& around, const std::int16_t* reading, std::size_t n,
                      std::uint8_t* differences) {
  const __m128i all = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(around.weights.data()));
  const __m256i negative = _mm256_broadcastsi128_si256(_mm_sub_epi8(_mm_setzero_si128(), all));
  __m256i weights[LevelsAround::kCells];
  for (std::size_t c = 0; c < LevelsAround::kCells; ++c)
    weights[c] = _mm256_shuffle_epi8(
        negative, _mm256_set1_epi16(static_cast<std::int16_t>(0x0100 + 0x0202 * c)));
  for (std::size_t j = 0; j < n; j += kBeams) {
    Mixes mix{_mm256_setzero_si256(), _mm256_setzero_si256(), _mm256_set1_epi8(-1),
              _mm256_setzero_si256()};
    for (std::size_t c = 0; c < LevelsAround::kCells; ++c) {
      const __m256i before = load(around.rows[c] + j);
      const __m256i next = load(around.rows[c] + j + 1);
      mix.sums = _mm256_add_epi16(
          mix.sums, _mm256_maddubs_epi16(_mm256_unpacklo_epi8(before, next), weights[c]));
      mix.laterSums = _mm256_add_epi16(
          mix.laterSums, _mm256_maddubs_epi16(_mm256_unpackhi_epi8(before, next), weights[c]));
      mix.low = _mm256_min_epu8(mix.low, _mm256_min_epu8(before, next));
      mix.high = _mm256_max_epu8(mix.high, _mm256_max_epu8(before, next));
    }
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(differences + j),
                        differencesOf(mix, reading + j));
  }
}

#endif

}  // namespace

DifferenceKernel differenceKernel(InstructionSet set) {
  if (!hasInstructionSet(set)) return nullptr;
#ifdef ORTUNG_X86
  // Scans fill few of the widest vectors.
  if (set != InstructionSet::kPortable) return avx2;
#endif
  return portable;
}

DifferenceKernel differenceKernel() { return differenceKernel(instructionSet()); }

}  // namespace ortung
