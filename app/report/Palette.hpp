#pragma once

#include "Picture.hpp"

/// Colours of pictures; the report's page has the same ones in report.css.
namespace ortung::app::palette {

// Marks have colours of M. Okabe and K. Ito, which can be distinguished with any colour vision.
inline constexpr Colour kTruth{213, 94, 0};      ///< vermillion
inline constexpr Colour kLandmark{0, 158, 115};  ///< bluish green
inline constexpr Colour kBest{0, 0, 0};
inline constexpr Colour kInk{29, 39, 51};
inline constexpr Colour kPaper{255, 255, 255};
inline constexpr Colour kSolid{158, 158, 158};    ///< neutral, unlike the colours of values
inline constexpr Colour kNoValue{214, 214, 214};  ///< cells without a value
inline constexpr Colour kLine{120, 120, 120};     ///< lines painted on the floor

/// Returns a colour from pale yellow over green to dark blue, ever darker; @p share is limited to
/// [0, 1].
Colour sequential(double share);

/// Returns the colour of the probability that an estimate is right: the more probable, the darker,
/// from yellow over red to dark blue; @p share is limited to [0, 1].
Colour quality(double share);

}  // namespace ortung::app::palette
