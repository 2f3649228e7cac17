#include "LiveImages.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "ortung/camera/ImageData.hpp"

namespace ortung::ros2 {
namespace {

/// How the bytes of a pixel lie in a message.
struct Encoding {
  std::string_view name;
  std::size_t bytes;
  std::array<std::size_t, 3> order;  ///< place of red, green and blue; grey is the first alone
  PixelFormat format;
};
constexpr std::array kEncodings{Encoding{"rgb8", 3, {0, 1, 2}, PixelFormat::kRgb},
                                Encoding{"bgr8", 3, {2, 1, 0}, PixelFormat::kRgb},
                                Encoding{"8UC3", 3, {2, 1, 0}, PixelFormat::kRgb},
                                Encoding{"rgba8", 4, {0, 1, 2}, PixelFormat::kRgb},
                                Encoding{"bgra8", 4, {2, 1, 0}, PixelFormat::kRgb},
                                Encoding{"mono8", 1, {0, 0, 0}, PixelFormat::kGrey},
                                Encoding{"8UC1", 1, {0, 0, 0}, PixelFormat::kGrey}};

const Encoding& encodingOf(const Image& image) {
  for (const Encoding& encoding : kEncodings)
    if (encoding.name == image.encoding) return encoding;
  std::string all;
  for (const Encoding& encoding : kEncodings)
    all += (all.empty() ? "" : ", ") + std::string(encoding.name);
  throw std::invalid_argument("a picture of encoding '" + image.encoding.substr(0, 32) +
                              "', expected one of " + all);
}

std::string text(std::size_t width, std::size_t height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

void checkSize(const Image& image, ImageSize size) {
  constexpr auto kMost = static_cast<std::uint32_t>(ImageData::kMostSide);
  const bool isAny = size.width == 0 && size.height == 0;
  const bool fits =
      isAny ? image.width >= 1 && image.width <= kMost && image.height >= 1 && image.height <= kMost
            : image.width == static_cast<std::uint32_t>(size.width) &&
                  image.height == static_cast<std::uint32_t>(size.height);
  if (!fits)
    throw std::invalid_argument(
        "a picture of " + text(image.width, image.height) + " pixels, expected " +
        (isAny
             ? "sides of 1 to " + std::to_string(kMost)
             : text(static_cast<std::size_t>(size.width), static_cast<std::size_t>(size.height))));
}

}  // namespace

std::vector<std::uint32_t> wordsOf(const Image& image, ImageSize size) {
  const Encoding& encoding = encodingOf(image);
  checkSize(image, size);
  const std::size_t row = std::size_t{image.width} * encoding.bytes;
  const std::size_t step = image.step;
  if (step < row || image.data.size() < row || (image.data.size() - row) / step < image.height - 1)
    throw std::invalid_argument("a picture of " + text(image.width, image.height) +
                                " pixels with rows of " + std::to_string(step) + " bytes in " +
                                std::to_string(image.data.size()) +
                                " bytes of data, expected all of its rows");
  std::vector<std::uint32_t> words;
  ImageData::start({static_cast<int>(image.width), static_cast<int>(image.height)}, encoding.format,
                   words);
  const std::span<std::uint8_t> pixels = ImageData::pixelsOf(words);
  const auto channels = static_cast<std::size_t>(encoding.format);
  std::size_t to = 0;
  for (std::size_t y = 0; y < image.height; ++y) {
    const std::uint8_t* from = image.data.data() + y * step;
    for (std::size_t x = 0; x < image.width; ++x, from += encoding.bytes)
      for (std::size_t c = 0; c < channels; ++c) pixels[to++] = from[encoding.order[c]];
  }
  return words;
}

}  // namespace ortung::ros2
