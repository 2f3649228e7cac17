#pragma once

#include <cstdint>
#include <span>

#include "ortung/pictures/CameraSheet.hpp"

namespace ortung {

/// Mixes four texels for each pixel with integers. Pixels that show nothing become black.
/// @param width width of the sheet [texels]
void resampleRow(const std::uint32_t* sheet, std::size_t width,
                 std::span<const CameraSheet::Place> places, std::uint32_t* out);

/// Writes the lower three bytes of each pixel in a row. @pre out has 3 * pixels.size() bytes
void packRgb(std::span<const std::uint32_t> pixels, std::uint8_t* out);

}  // namespace ortung
