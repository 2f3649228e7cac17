#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ortung {

/// A grey image, row 0 at the top.
struct MapImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> grey;  ///< width * height values, 0: black
  /// Width * height values, 0: transparent; empty: all is opaque.
  std::vector<std::uint8_t> opaque;
};

/// Decodes a PGM, PPM (binary) or PNG image of at most 2^26 pixels; sizes are checked against those
/// of the file before memory is taken.
/// @param file the file's name for error messages @throws MapError
MapImage decodeImage(const std::filesystem::path& file, const std::string& bytes);

}  // namespace ortung
