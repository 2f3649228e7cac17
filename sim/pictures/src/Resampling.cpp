#include "Resampling.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "ortung/base/InstructionSet.hpp"

namespace ortung {
namespace {

constexpr std::size_t kGroup = 16;  ///< number of pixels that are mixed together
constexpr std::size_t kBytes = 4 * kGroup;

/// The four texels of each pixel, in pairs, and its shares repeated for each byte.
struct Corners {
  std::array<std::uint64_t, kGroup> upper, lower;
  std::array<std::uint32_t, kGroup> right, below;
};

/// Mixes the texels of a group. Integers only, so that all instruction sets agree; shares are in
/// units of 1/128, so that the sum of two products fits 16 bits.
ORTUNG_INLINE void mixGroup(const Corners& corners, std::uint32_t* out) {
  std::array<std::uint8_t, kBytes> a, b, c, d, right, below, mixed;
  std::array<std::uint32_t, kGroup> left4, right4;
  const auto part = [&](const std::array<std::uint64_t, kGroup>& pairs, std::uint8_t* left,
                        std::uint8_t* rest) {
    for (std::size_t i = 0; i < kGroup; ++i) {
      left4[i] = static_cast<std::uint32_t>(pairs[i]);
      right4[i] = static_cast<std::uint32_t>(pairs[i] >> 32);
    }
    std::memcpy(left, left4.data(), kBytes);
    std::memcpy(rest, right4.data(), kBytes);
  };
  part(corners.upper, a.data(), b.data());
  part(corners.lower, c.data(), d.data());
  std::memcpy(right.data(), corners.right.data(), kBytes);
  std::memcpy(below.data(), corners.below.data(), kBytes);
  for (std::size_t i = 0; i < kBytes; ++i) {
    const auto left = static_cast<std::uint16_t>(128 - right[i]);
    const auto upper = static_cast<std::uint16_t>(a[i] * left + b[i] * right[i]);
    const auto lower = static_cast<std::uint16_t>(c[i] * left + d[i] * right[i]);
    const std::uint32_t sum = static_cast<std::uint32_t>(upper) * (128U - below[i]) +
                              static_cast<std::uint32_t>(lower) * below[i];
    mixed[i] = static_cast<std::uint8_t>((sum + 8192U) >> 14);
  }
  std::memcpy(out, mixed.data(), kBytes);
}

ORTUNG_INLINE void collect(const std::uint32_t* sheet, std::size_t width,
                           const CameraSheet::Place* places, Corners& corners) {
  for (std::size_t i = 0; i < kGroup; ++i) {
    const CameraSheet::Place& place = places[i];
    const std::uint32_t* upper = sheet + place.texel;
    const std::uint32_t* lower = upper + width;
    std::memcpy(&corners.upper[i], upper, sizeof corners.upper[i]);
    std::memcpy(&corners.lower[i], lower, sizeof corners.lower[i]);
    corners.right[i] = place.right * 0x01010101U;
    corners.below[i] = place.below * 0x01010101U;
  }
}

ORTUNG_INLINE void mixRow(const std::uint32_t* sheet, std::size_t width,
                          const CameraSheet::Place* places, std::size_t groups,
                          std::uint32_t* out) {
  Corners corners;
  for (std::size_t g = 0; g < groups; ++g) {
    collect(sheet, width, places + g * kGroup, corners);
    mixGroup(corners, out + g * kGroup);
  }
}

using MixRow = void (*)(const std::uint32_t*, std::size_t, const CameraSheet::Place*, std::size_t,
                        std::uint32_t*);

void mixPortable(const std::uint32_t* sheet, std::size_t width, const CameraSheet::Place* places,
                 std::size_t groups, std::uint32_t* out) {
  mixRow(sheet, width, places, groups, out);
}
#ifdef ORTUNG_X86
ORTUNG_AVX2 void mixAvx2(const std::uint32_t* sheet, std::size_t width,
                         const CameraSheet::Place* places, std::size_t groups, std::uint32_t* out) {
  mixRow(sheet, width, places, groups, out);
}
ORTUNG_AVX512 void mixAvx512(const std::uint32_t* sheet, std::size_t width,
                             const CameraSheet::Place* places, std::size_t groups,
                             std::uint32_t* out) {
  mixRow(sheet, width, places, groups, out);
}
#else
constexpr MixRow mixAvx2 = mixPortable, mixAvx512 = mixPortable;
#endif

/// Packs four pixels at a time. @returns the number of pixels packed
std::size_t packPortable(std::span<const std::uint32_t> pixels, std::uint8_t* out) {
  const std::size_t whole = pixels.size() / 4;
  for (std::size_t i = 0; i < whole; ++i) {
    const std::uint32_t* p = pixels.data() + 4 * i;
    const std::uint32_t three[3] = {(p[0] & 0xFFFFFFU) | p[1] << 24,
                                    (p[1] >> 8 & 0xFFFFU) | p[2] << 16,
                                    (p[2] >> 16 & 0xFFU) | p[3] << 8};
    std::memcpy(out + 12 * i, three, sizeof three);
  }
  return 4 * whole;
}

#if defined(ORTUNG_X86) && defined(__GNUC__) && !defined(__clang__)
/// Packs four pixels with one instruction; what it writes behind the twelve bytes is overwritten
/// later.
ORTUNG_AVX2 std::size_t packAvx2(std::span<const std::uint32_t> pixels, std::uint8_t* out) {
  using Bytes = std::uint8_t __attribute__((vector_size(16)));
  constexpr Bytes kOrder{0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, 3, 7, 11, 15};
  std::size_t i = 0;
  for (; i + 8 <= pixels.size(); i += 4) {
    Bytes four;
    std::memcpy(&four, pixels.data() + i, sizeof four);
    four = __builtin_shuffle(four, kOrder);
    std::memcpy(out + 3 * i, &four, sizeof four);
  }
  return i;
}
#else
std::size_t packAvx2(std::span<const std::uint32_t> pixels, std::uint8_t* out) {
  return packPortable(pixels, out);
}
#endif

std::size_t packBest(std::span<const std::uint32_t> pixels, std::uint8_t* out) {
  return instructionSet() == InstructionSet::kPortable ? packPortable(pixels, out)
                                                       : packAvx2(pixels, out);
}

MixRow pick() {
  switch (instructionSet()) {
    case InstructionSet::kAvx512:
      return mixAvx512;
    case InstructionSet::kAvx2:
      return mixAvx2;
    case InstructionSet::kPortable:
    case InstructionSet::kNeon:
      break;
  }
  return mixPortable;
}

}  // namespace

void resampleRow(const std::uint32_t* sheet, std::size_t width,
                 std::span<const CameraSheet::Place> places, std::uint32_t* out) {
  const MixRow mix = pick();
  const std::size_t groups = places.size() / kGroup;
  mix(sheet, width, places.data(), groups, out);
  const std::size_t rest = places.size() - groups * kGroup;
  if (rest == 0) return;
  std::array<CameraSheet::Place, kGroup> last{};
  std::array<std::uint32_t, kGroup> mixed;
  std::copy_n(places.end() - static_cast<std::ptrdiff_t>(rest), rest, last.begin());
  mix(sheet, width, last.data(), 1, mixed.data());
  std::copy_n(mixed.begin(), rest, out + groups * kGroup);
}

void packRgb(std::span<const std::uint32_t> pixels, std::uint8_t* out) {
  const std::size_t done = packBest(pixels, out);
  for (std::size_t i = done; i < pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      out[3 * i + static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(pixels[i] >> 8 * c);
}

}  // namespace ortung
