#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "ortung/camera/ImageData.hpp"

namespace ortung::app {

/// Pictures as PNG files, encoded fast rather than small.
/// @throws std::runtime_error naming the file, as do the others
void writePng(const std::filesystem::path& file, const ImageView& image);
/// Bytes that are numbers of colours. @param palette red, green, blue of each
void writePng(const std::filesystem::path& file, ImageSize size,
              std::span<const std::uint8_t> numbers, std::span<const std::uint8_t> palette);
/// Grey of 16 bits.
void writePng(const std::filesystem::path& file, ImageSize size,
              std::span<const std::uint16_t> grey);

}  // namespace ortung::app
