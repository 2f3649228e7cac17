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
  std::vector<std::uint8_t> grey;    ///< width * height, 0 black
  std::vector<std::uint8_t> opaque;  ///< empty (all is), or width * height: 0 where transparent
};

/// Decodes a PGM, PPM (binary) or PNG image of at most 2^26 pixels; sizes are checked against those
/// of the file before memory is taken.
/// @param file what errors call it @throws MapError
MapImage decodeImage(const std::filesystem::path& file, const std::string& bytes);

}  // namespace ortung
