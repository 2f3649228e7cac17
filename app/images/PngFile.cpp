#include "PngFile.hpp"

#include <png.h>

#include <stdexcept>
#include <string>

namespace ortung::app {
namespace {

void write(const std::filesystem::path& file, ImageSize size, png_uint_32 format,
           const void* pixels, const void* palette = nullptr, png_uint_32 colours = 0) {
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(size.width);
  image.height = static_cast<png_uint_32>(size.height);
  image.format = format;
  image.flags = PNG_IMAGE_FLAG_FAST;
  image.colormap_entries = colours;
  if (png_image_write_to_file(&image, file.c_str(), 0, pixels, 0, palette) == 0)
    throw std::runtime_error(file.string() + ": can't be written: " + image.message);
}

}  // namespace

void writePng(const std::filesystem::path& file, const ImageView& image) {
  write(file, image.size, image.format == PixelFormat::kGrey ? PNG_FORMAT_GRAY : PNG_FORMAT_RGB,
        image.pixels);
}

void writePng(const std::filesystem::path& file, ImageSize size,
              std::span<const std::uint8_t> numbers, std::span<const std::uint8_t> palette) {
  write(file, size, PNG_FORMAT_RGB_COLORMAP, numbers.data(), palette.data(),
        static_cast<png_uint_32>(palette.size() / 3));
}

void writePng(const std::filesystem::path& file, ImageSize size,
              std::span<const std::uint16_t> grey) {
  write(file, size, PNG_FORMAT_LINEAR_Y, grey.data());
}

}  // namespace ortung::app
