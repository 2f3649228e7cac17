#pragma once

#include <bit>
#include <cstdint>

#include "ortung/base/InstructionSet.hpp"

/// Functions of single precision for loops that vectorize. They give the same bits on every
/// machine; those of standard libraries differ between versions and processors. Coefficients are
/// those of S. L. Moshier's Cephes library. (-ffp-contract=off, as in InstructionSet.hpp.)
namespace ortung {

/// Sine and cosine of the same angle.
struct SinCos {
  float sin;
  float cos;
};

/// Returns sine and cosine of one angle [rad] at once. They are wrong by less than 2e-7 for |angle|
/// < 1e4; an angle at or beyond 1e5 counts as 0; NaN stays NaN. Cephes' sinf.c: reduction to an
/// eighth of a turn, polynomials.
inline SinCos sinCos(float angle) {
  constexpr float kMost = 1e5F;  // the quarter turns fit 16 bits, so their products are exact
  const bool usual =
      static_cast<bool>(static_cast<int>(angle > -kMost) & static_cast<int>(angle < kMost));
  const float bounded = usual ? angle : 0.0F;
  const float quarters = bounded * 0.636619772367581F;
  const int quarter = static_cast<int>(quarters + (quarters < 0.0F ? -0.5F : 0.5F));
  const auto k = static_cast<float>(quarter);
  const float y = ((bounded - k * 1.5703125F) - k * 4.837512969970703125e-4F) -
                  k * 7.54978995489188e-8F + angle * 0.0F;
  const float z = y * y;
  const float s = ((-1.9515295891e-4F * z + 8.3321608736e-3F) * z - 1.6666654611e-1F) * z * y + y;
  const float c =
      ((2.443315711809948e-5F * z - 1.388731625493765e-3F) * z + 4.166664568298827e-2F) * z * z -
      0.5F * z + 1.0F;
  const bool odd = (quarter & 1) != 0;
  const float sine = odd ? c : s;
  const float cosine = odd ? s : c;
  return {(quarter & 2) != 0 ? -sine : sine, ((quarter + 1) & 2) != 0 ? -cosine : cosine};
}

/// Returns ln x for normal positive x, wrong by less than 2e-7 relative to max(1, |ln x|). Cephes'
/// logf.c.
ORTUNG_INLINE float naturalLog(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x);
  const auto half = std::bit_cast<float>((bits & 0x007FFFFF) | 0x3F000000);  // in [0.5, 1)
  const bool small = half < 0.707106781186547524F;
  const auto e = static_cast<float>((bits >> 23) - 126 - (small ? 1 : 0));
  const float m = (small ? half + half : half) - 1.0F;
  const float z = m * m;
  float y = 7.0376836292e-2F;
  y = y * m - 1.1514610310e-1F;
  y = y * m + 1.1676998740e-1F;
  y = y * m - 1.2420140846e-1F;
  y = y * m + 1.4249322787e-1F;
  y = y * m - 1.6668057665e-1F;
  y = y * m + 2.0000714765e-1F;
  y = y * m - 2.4999993993e-1F;
  y = y * m + 3.3333331174e-1F;
  y = y * m * z - 2.12194440e-4F * e - 0.5F * z;
  return m + y + 0.693359375F * e;
}

/// Returns e^x for x <= 0, wrong by less than 2e-7 relative; 0 below -87 (less than the smallest
/// float), above 0 and for NaN. Cephes' expf.c.
ORTUNG_INLINE float powerOfE(float x) {
  constexpr float kLeast = -87.0F;
  // All bits where x is usual, not for NaN. Choices by bits: compilers make branches of others.
  const std::int32_t usual = -(static_cast<int>(x >= kLeast) & static_cast<int>(x <= 0.0F));
  const auto bounded = std::bit_cast<float>(std::bit_cast<std::int32_t>(x) & usual);
  const auto power = static_cast<std::int32_t>(bounded * 1.44269504088896341F - 0.5F);
  const auto k = static_cast<float>(power);
  const float y = (bounded - k * 0.693359375F) + k * 2.12194440e-4F;
  float p = 1.9875691500e-4F;
  p = p * y + 1.3981999507e-3F;
  p = p * y + 8.3334519073e-3F;
  p = p * y + 4.1665795894e-2F;
  p = p * y + 1.6666665459e-1F;
  p = p * y + 5.0000001201e-1F;
  p = p * y * y + y + 1.0F;
  const float scaled = p * std::bit_cast<float>((power + 127) << 23);
  return std::bit_cast<float>(std::bit_cast<std::int32_t>(scaled) & usual);
}

}  // namespace ortung
