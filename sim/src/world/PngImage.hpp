#pragma once

#include <filesystem>
#include <string>

#include "MapImage.hpp"

namespace ortung {

/// Decodes a PNG of any kind of pixels; sizes are checked before memory is taken, checksums are.
/// What it says of colours (gamma, profiles) is passed over: cells are no light.
/// @param file what errors call it @throws MapError
MapImage decodePng(const std::filesystem::path& file, const std::string& bytes);

}  // namespace ortung
