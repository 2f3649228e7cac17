#pragma once

#include "MapImage.hpp"

namespace ortung {

/// Decodes a PGM or PPM image, plain or binary (netpbm's pgm(5), ppm(5)): P2, P3, P5, P6.
/// @pre the bytes begin with one of these @throws MapError
MapImage decodePnm(const std::filesystem::path& file, const std::string& bytes,
                   const PixelMeaning& meaning);

}  // namespace ortung
