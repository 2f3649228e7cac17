#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "ortung/camera/ImageData.hpp"

namespace ortung::app {

/// Writes a picture as a PNG file, encoded for speed rather than size.
/// @throws std::runtime_error naming the file, as do the others
void writePng(const std::filesystem::path& file, const ImageView& image);
/// Writes a picture of indices of colours. @param palette red, green, blue of each colour
void writePng(const std::filesystem::path& file, ImageSize size,
              std::span<const std::uint8_t> numbers, std::span<const std::uint8_t> palette);
/// Writes a grey picture of 16 bits.
void writePng(const std::filesystem::path& file, ImageSize size,
              std::span<const std::uint16_t> grey);

}  // namespace ortung::app
