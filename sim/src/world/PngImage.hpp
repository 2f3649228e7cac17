#pragma once

#include <filesystem>
#include <string>

#include "MapImage.hpp"

namespace ortung {

/// Decodes a PNG with any format of pixels. Sizes are checked before memory is allocated, and
/// checksums are verified. Gamma and colour profiles are ignored, since cells are not light.
/// @param file the file's name for error messages @throws MapError
MapImage decodePng(const std::filesystem::path& file, const std::string& bytes,
                   const PixelMeaning& meaning);

}  // namespace ortung
