#include "MapImage.hpp"

#include <cctype>
#include <cstdlib>
#include <memory>
#include <optional>

#include "GridMap.hpp"

namespace ortung {
namespace {

/// The greatest single allocation that the decoder gets: a few kilobytes of PNG can demand
/// gigabytes.
thread_local std::size_t mostBytes = 0;

void* boundedMalloc(std::size_t size) { return size <= mostBytes ? std::malloc(size) : nullptr; }
void* boundedRealloc(void* old, std::size_t size) {
  return size <= mostBytes ? std::realloc(old, size) : nullptr;
}

}  // namespace
}  // namespace ortung

#define STBI_MALLOC(size) ortung::boundedMalloc(size)
#define STBI_REALLOC(old, size) ortung::boundedRealloc(old, size)
#define STBI_FREE(old) std::free(old)
#define STBI_ONLY_PNG
#define STBI_ONLY_PNM
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_FAILURE_USERMSG
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace ortung {
namespace {

struct PnmHeader {
  std::size_t bytes = 0;  ///< length of the header
  long most = 0;          ///< the value of white
};

/// The header of a binary PGM or PPM, or nothing.
std::optional<PnmHeader> readPnmHeader(const std::string& bytes) {
  std::size_t at = 2;
  long value = 0;
  for (int field = 0; field < 3; ++field) {
    while (at < bytes.size() &&
           (std::isspace(static_cast<unsigned char>(bytes[at])) || bytes[at] == '#')) {
      if (bytes[at] == '#')
        while (at < bytes.size() && bytes[at] != '\n' && bytes[at] != '\r') ++at;
      else
        ++at;
    }
    value = 0;
    const std::size_t start = at;
    for (; at < bytes.size() && std::isdigit(static_cast<unsigned char>(bytes[at])); ++at)
      if (value < 100000000) value = value * 10 + (bytes[at] - '0');
    if (at == start) return std::nullopt;
  }
  return PnmHeader{at + 1, value};
}

// The decoder neither scales grey values nor notices when a PNM file ends early.
void checkPnm(const std::filesystem::path& file, const std::string& bytes, int width, int height,
              int channels) {
  const auto header = readPnmHeader(bytes);
  if (!header) throw MapError(file.string() + ": has no complete PNM header");
  if (header->most != 255 && header->most != 65535)
    throw MapError(file.string() + ": white is " + std::to_string(header->most) +
                   ", expected 255 or 65535");
  const std::size_t expected = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                               static_cast<std::size_t>(channels) * (header->most == 255 ? 1 : 2);
  if (bytes.size() < header->bytes + expected)
    throw MapError(file.string() + ": ends after " +
                   std::to_string(bytes.size() - std::min(bytes.size(), header->bytes)) +
                   " bytes of pixels, expected " + std::to_string(expected));
}

MapImage split(const stbi_uc* pixels, int width, int height, bool hasAlpha) {
  MapImage image{width, height, {}, {}};
  const std::size_t n = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (!hasAlpha) {
    image.grey.assign(pixels, pixels + n);
    return image;
  }
  image.grey.resize(n);
  image.opaque.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    image.grey[i] = pixels[2 * i];
    image.opaque[i] = pixels[2 * i + 1] >= 128 ? 1 : 0;
  }
  return image;
}

}  // namespace

MapImage decodeImage(const std::filesystem::path& file, const std::string& bytes) {
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int length = static_cast<int>(std::min<std::size_t>(bytes.size(), 0x7fffffff));
  int width = 0;
  int height = 0;
  int channels = 0;
  mostBytes = std::size_t{1} << 20;
  if (!stbi_info_from_memory(data, length, &width, &height, &channels))
    throw MapError(file.string() +
                   ": is no image that can be read, expected PNG, or PGM or PPM in "
                   "binary (P5, P6): " +
                   stbi_failure_reason());
  checkGrid(file, width, height, 1e-3, 0.0, 0.0);
  if (bytes.starts_with('P')) checkPnm(file, bytes, width, height, channels);

  const bool hasAlpha = channels == 2 || channels == 4;
  const std::size_t n = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  mostBytes = n * 8 + (std::size_t{1} << 20) + bytes.size();  // 4 channels of 16 bits
  const std::unique_ptr<stbi_uc, decltype(&std::free)> pixels(
      stbi_load_from_memory(data, length, &width, &height, &channels, hasAlpha ? 2 : 1),
      &std::free);
  if (!pixels)
    throw MapError(file.string() + ": the image cannot be decoded: " + stbi_failure_reason());
  return split(pixels.get(), width, height, hasAlpha);
}

}  // namespace ortung
