#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace ortung {

/// A pixel, as finely as any depth has it.
struct MapPixel {
  static constexpr std::uint32_t kFull = 65535;
  std::uint32_t colours = 0;    ///< sum of red, green and blue, each from 0 (dark) to kFull
  std::uint32_t alpha = kFull;  ///< 0: transparent, kFull: opaque
};

/// What a pixel means to the caller.
using PixelMeaning = std::function<std::uint8_t(const MapPixel&)>;

/// What an image means, row 0 at the top.
struct MapImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> meanings;  ///< width * height values
};

/// Decodes a PNG, PGM or PPM image (plain or binary) of at most 2^26 pixels of 1 to 16 bits a
/// channel. Sizes are checked against those of the file before memory is taken, and each pixel is
/// turned at once to what it means, so that it needs a byte whatever its depth.
/// @param file the file's name for error messages @throws MapError
MapImage decodeImage(const std::filesystem::path& file, const std::string& bytes,
                     const PixelMeaning& meaning);

}  // namespace ortung
