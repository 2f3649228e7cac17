#include "MapImage.hpp"

#include <string_view>

#include "GridMap.hpp"
#include "PngImage.hpp"
#include "PnmImage.hpp"

namespace ortung {

MapImage decodeImage(const std::filesystem::path& file, const std::string& bytes,
                     const PixelMeaning& meaning) {
  constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";
  if (bytes.starts_with(kPngSignature)) return decodePng(file, bytes, meaning);
  for (const char* kind : {"P2", "P3", "P5", "P6"})
    if (bytes.starts_with(kind)) return decodePnm(file, bytes, meaning);
  throw MapError(file.string() +
                 ": is not a known kind of image, expected PNG, PGM (P2, P5) or PPM (P3, P6)");
}

}  // namespace ortung
