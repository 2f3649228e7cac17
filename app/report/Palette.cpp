#include "Palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ortung::app::palette {

Colour sequential(double share) {
  // "YlGnBu" of C. Brewer's colour schemes, which stay apart for all colour vision and in grey.
  constexpr std::array<std::array<double, 3>, 9> kStops{{{255, 255, 217},
                                                         {237, 248, 177},
                                                         {199, 233, 180},
                                                         {127, 205, 187},
                                                         {65, 182, 196},
                                                         {29, 145, 192},
                                                         {34, 94, 168},
                                                         {37, 52, 148},
                                                         {8, 29, 88}}};
  const double place = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kStops.size() - 2);
  const double rest = place - static_cast<double>(below);
  const auto mixed = [&](std::size_t channel) {
    return static_cast<std::uint8_t>(
        std::lround(kStops[below][channel] * (1.0 - rest) + kStops[below + 1][channel] * rest));
  };
  return {mixed(0), mixed(1), mixed(2)};
}

}  // namespace ortung::app::palette
