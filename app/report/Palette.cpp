#include "Palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ortung::app::palette {

namespace {

template <std::size_t count>
Colour mixed(const std::array<std::array<double, 3>, count>& stops, double share) {
  const double place = std::clamp(share, 0.0, 1.0) * (count - 1);
  const auto below = std::min(static_cast<std::size_t>(place), count - 2);
  const double rest = place - static_cast<double>(below);
  const auto channel = [&](std::size_t i) {
    return static_cast<std::uint8_t>(
        std::lround(stops[below][i] * (1.0 - rest) + stops[below + 1][i] * rest));
  };
  return {channel(0), channel(1), channel(2)};
}

}  // namespace

Colour sequential(double share) {
  // "YlGnBu" of C. Brewer's colour schemes, distinguishable with any colour vision and in grey.
  constexpr std::array<std::array<double, 3>, 9> kStops{{{255, 255, 217},
                                                         {237, 248, 177},
                                                         {199, 233, 180},
                                                         {127, 205, 187},
                                                         {65, 182, 196},
                                                         {29, 145, 192},
                                                         {34, 94, 168},
                                                         {37, 52, 148},
                                                         {8, 29, 88}}};
  return mixed(kStops, share);
}

Colour quality(double share) {
  // "plasma" of S. van der Walt and N. Smith (CC0), reversed, which gets darker evenly and is
  // distinguishable with any colour vision.
  constexpr std::array<std::array<double, 3>, 8> kStops{{{240, 249, 33},
                                                         {253, 180, 47},
                                                         {237, 121, 83},
                                                         {204, 71, 120},
                                                         {156, 23, 158},
                                                         {106, 0, 168},
                                                         {60, 4, 153},
                                                         {13, 8, 135}}};
  return mixed(kStops, share);
}

}  // namespace ortung::app::palette
