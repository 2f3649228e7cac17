#include "MapImage.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string_view>

#include "GridMap.hpp"
#include "PngImage.hpp"

namespace ortung {
namespace {

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";
constexpr long kMostWhite = 65535;

struct PnmHeader {
  std::size_t bytes = 0;  ///< length of the header
  long width = 0;
  long height = 0;
  long white = 0;  ///< value of white, the greatest one
};

/// The header of a binary PGM or PPM (netpbm's pgm(5), ppm(5)), or nothing.
std::optional<PnmHeader> readPnmHeader(const std::string& bytes) {
  std::size_t at = 2;
  std::array<long, 3> fields{};
  for (long& value : fields) {
    while (at < bytes.size() &&
           (std::isspace(static_cast<unsigned char>(bytes[at])) || bytes[at] == '#')) {
      if (bytes[at] == '#')
        while (at < bytes.size() && bytes[at] != '\n' && bytes[at] != '\r') ++at;
      else
        ++at;
    }
    const std::size_t start = at;
    for (; at < bytes.size() && std::isdigit(static_cast<unsigned char>(bytes[at])); ++at)
      if (value < 100000000) value = value * 10 + (bytes[at] - '0');
    if (at == start) return std::nullopt;
  }
  return PnmHeader{at + 1, fields[0], fields[1], fields[2]};
}

/// @param channels 1 (grey) or 3 (red, green, blue)
MapImage decodePnm(const std::filesystem::path& file, const std::string& bytes,
                   std::size_t channels) {
  const auto header = readPnmHeader(bytes);
  if (!header) throw MapError(file.string() + ": has no complete PNM header");
  checkGrid(file, static_cast<double>(header->width), static_cast<double>(header->height), 1e-3,
            0.0, 0.0);
  if (header->white < 1 || header->white > kMostWhite)
    throw MapError(file.string() + ": white is " + std::to_string(header->white) +
                   ", expected 1 to 65535");
  const std::size_t depth = header->white > 255 ? 2 : 1;
  MapImage image{static_cast<int>(header->width), static_cast<int>(header->height), {}, {}};
  const std::size_t n =
      static_cast<std::size_t>(header->width) * static_cast<std::size_t>(header->height);
  const std::size_t expected = n * channels * depth;
  const std::size_t found = bytes.size() - std::min(bytes.size(), header->bytes);
  if (found < expected)
    throw MapError(file.string() + ": ends after " + std::to_string(found) +
                   " bytes of pixels, expected " + std::to_string(expected));

  const auto* pixel = reinterpret_cast<const unsigned char*>(bytes.data()) + header->bytes;
  const auto next = [&]() -> long {
    long value = *pixel++;
    if (depth == 2) value = value * 256 + *pixel++;
    return std::min(value, header->white);
  };
  image.grey.resize(n);
  for (std::uint8_t& grey : image.grey) {
    long value = 0;
    if (channels == 1) {
      value = next();
    } else {  // ITU-R BT.601, in integers, so that equal parts give exactly that grey
      const long red = next();
      const long green = next();
      value = (299 * red + 587 * green + 114 * next()) / 1000;
    }
    grey = static_cast<std::uint8_t>(value * 255 / header->white);
  }
  return image;
}

}  // namespace

MapImage decodeImage(const std::filesystem::path& file, const std::string& bytes) {
  if (bytes.starts_with(kPngSignature)) return decodePng(file, bytes);
  if (bytes.starts_with("P5")) return decodePnm(file, bytes, 1);
  if (bytes.starts_with("P6")) return decodePnm(file, bytes, 3);
  throw MapError(file.string() +
                 ": is not a known kind of image, expected PNG, or PGM or PPM in binary (P5, P6)");
}

}  // namespace ortung
