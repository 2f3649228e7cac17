#pragma once

#include "Picture.hpp"

/// Colours of pictures; the report's page has the same ones in report.css.
namespace ortung::app::palette {

// Marks are of the set of M. Okabe and K. Ito, which people with any colour vision tell apart.
inline constexpr Colour kTruth{213, 94, 0};      ///< vermillion
inline constexpr Colour kLandmark{0, 158, 115};  ///< bluish green
inline constexpr Colour kBest{0, 0, 0};
inline constexpr Colour kInk{29, 39, 51};
inline constexpr Colour kPaper{255, 255, 255};
inline constexpr Colour kSolid{158, 158, 158};    ///< neutral, as no value is
inline constexpr Colour kNoValue{214, 214, 214};  ///< nothing expected, nothing known
inline constexpr Colour kLine{120, 120, 120};     ///< painted on the floor

/// From pale yellow over green to dark blue, always darker; @p share in [0, 1] is cut off.
Colour sequential(double share);

/// Of the probability that an estimate is right: the surer, the darker, from yellow over red to
/// dark blue; @p share in [0, 1] is cut off.
Colour quality(double share);

}  // namespace ortung::app::palette
