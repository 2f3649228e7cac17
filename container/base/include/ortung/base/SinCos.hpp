#pragma once

namespace ortung {

struct SinCos {
  float sin;
  float cos;
};

/// Sine and cosine of one angle [rad] at once, in loops that vectorize, and with the same bits on
/// every machine: those of standard libraries differ between versions and processors.
/// Wrong by less than 2e-7 for |angle| < 1e4; an angle at or beyond 1e5 counts as 0; NaN stays NaN.
/// After S. L. Moshier's Cephes library (sinf.c): reduction to an eighth of a turn, polynomials.
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

}  // namespace ortung
