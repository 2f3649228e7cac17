#pragma once

#include <gtest/gtest.h>
#include <png.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "Picture.hpp"

namespace ortung::app {

/// The pixels of a PNG file.
struct DecodedPng {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  explicit DecodedPng(std::span<const std::byte> png) {
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_memory(&image, png.data(), png.size()), 0);
    image.format = PNG_FORMAT_RGB;
    width = static_cast<int>(image.width);
    height = static_cast<int>(image.height);
    rgb.resize(PNG_IMAGE_SIZE(image));
    EXPECT_NE(png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr), 0);
  }
  Colour at(int x, int y) const {
    const std::size_t i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(x));
    return {rgb.at(i), rgb.at(i + 1), rgb.at(i + 2)};
  }
  bool is(int x, int y, Colour colour) const {
    const Colour there = at(x, y);
    return there.red == colour.red && there.green == colour.green && there.blue == colour.blue;
  }
};

/// Where a heat map's field lies in its picture, found by its dark frame [pixels].
struct FoundField {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;

  explicit FoundField(const DecodedPng& png) {
    const Colour ink{29, 39, 51};
    const auto run = [&](int x, int y, int dx, int dy) {
      int length = 0;
      while (x < png.width && y < png.height && png.is(x, y, ink)) {
        x += dx;
        y += dy;
        ++length;
      }
      return length;
    };
    for (int y = 0; y < png.height; ++y) {
      for (int x = 0; x < png.width; ++x) {
        const int across = run(x, y, 1, 0);
        if (across < 100) continue;
        left = x + 1;
        top = y + 1;
        width = across - 2;
        height = run(x, y, 0, 1) - 2;
        return;
      }
    }
    ADD_FAILURE() << "no frame of a field in the picture";
  }
};

/// Place of a colour on the way from pale to dark, in [0, 1], or -1 if it is none of the scale's.
/// Told from the written colours of ColorBrewer's "YlGnBu" by their red plus green, which only
/// falls.
inline double darknessOf(Colour colour) {
  constexpr double kStops[9][3] = {{255, 255, 217}, {237, 248, 177}, {199, 233, 180},
                                   {127, 205, 187}, {65, 182, 196},  {29, 145, 192},
                                   {34, 94, 168},   {37, 52, 148},   {8, 29, 88}};
  for (int i = 0; i < 8; ++i) {
    const double sum = colour.red + colour.green;
    const double from = kStops[i][0] + kStops[i][1];
    const double to = kStops[i + 1][0] + kStops[i + 1][1];
    if (sum > from + 1.0 || sum < to - 1.0) continue;
    const double share = (from - sum) / (from - to);
    const double blue = kStops[i][2] + share * (kStops[i + 1][2] - kStops[i][2]);
    if (std::abs(blue - colour.blue) <= 3.0) return (i + share) / 8.0;
  }
  return -1.0;
}

}  // namespace ortung::app
