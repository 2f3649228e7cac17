#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/camera/ImageData.hpp"

namespace ortung {

/// A picture with its own pixels, red, green, blue.
struct ORTUNG_API Picture {
  ImageSize size;
  std::vector<std::uint8_t> pixels;

  ImageView view() const { return {size, PixelFormat::kRgb, pixels.data()}; }
  /// Draws a filled square of 2 r + 1 pixels around a place; what is outside is left out.
  void dot(const Pixel& at, int r, std::uint8_t red, std::uint8_t green, std::uint8_t blue);
};

/// Reads a JPEG, PNG, ... (what OpenCV reads); at most 4096 pixels a side.
/// @throws std::runtime_error naming the file
ORTUNG_API Picture readPicture(const std::filesystem::path& file);
/// Bytes of a PNG file. @throws std::runtime_error
ORTUNG_API std::vector<std::uint8_t> toPng(const ImageView& image);

}  // namespace ortung
