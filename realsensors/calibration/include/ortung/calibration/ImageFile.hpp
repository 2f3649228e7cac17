#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/camera/ImageData.hpp"

namespace ortung {

/// A picture that owns its pixels.
struct ORTUNG_API Picture {
  ImageSize size;                    ///< [px]
  std::vector<std::uint8_t> pixels;  ///< red, green, blue; row by row from the top

  /// A view of the pixels; it is valid as long as they are.
  ImageView view() const { return {size, PixelFormat::kRgb, pixels.data()}; }
  /// Draws a filled square with sides of 2 r + 1 pixels around @p at, clipped at the border.
  void dot(const Pixel& at, int r, std::uint8_t red, std::uint8_t green, std::uint8_t blue);
};

/// Reads an image file: JPEG, PNG, BMP, PGM or PPM. Its size is known by its header before anything
/// is decoded. While it is, nothing of this process appears on stderr. Not thread-safe.
/// @throws std::runtime_error that names the file, also for more than 4096 pixels a side, and for
///   what is no regular file, such as a pipe
ORTUNG_API Picture readPicture(const std::filesystem::path& file);
/// Encodes an image as a PNG file. @return the file's bytes @throws std::runtime_error
ORTUNG_API std::vector<std::uint8_t> toPng(const ImageView& image);

}  // namespace ortung
