#include "Picture.hpp"

#include <png.h>
#include <stb/stb_easy_font.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace ortung::app {
namespace {

/// A corner of one of stb_easy_font's rectangles.
struct FontVertex {
  float x;
  float y;
  float z;
  std::uint8_t colour[4];
};
constexpr std::size_t kVerticesOfCharacter = 80;  // its manual says about 270 bytes

}  // namespace

Picture::Picture(int width, int height, Colour background)
    : width_(width),
      height_(height),
      rgb_(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  fill(0, 0, width, height, background);
}

void Picture::set(int x, int y, Colour colour) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                              static_cast<std::size_t>(x));
  rgb_[at] = colour.red;
  rgb_[at + 1] = colour.green;
  rgb_[at + 2] = colour.blue;
}

void Picture::fill(int x, int y, int width, int height, Colour colour) {
  const int right = std::min(x + width, width_);
  const int bottom = std::min(y + height, height_);
  for (int row = std::max(y, 0); row < bottom; ++row) {
    for (int column = std::max(x, 0); column < right; ++column) set(column, row, colour);
  }
}

void Picture::line(double x0, double y0, double x1, double y1, int thickness, Colour colour) {
  // Only the part within the picture is drawn, so distant ends cost nothing (Liang and Barsky).
  double from = 0.0;
  double to = 1.0;
  const auto cut = [&](double start, double way, double low, double high) {
    if (way == 0.0) return start >= low && start <= high;
    const double a = (low - start) / way;
    const double b = (high - start) / way;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
    return from <= to;
  };
  if (!std::isfinite(x1 - x0) || !std::isfinite(y1 - y0)) return;
  if (!cut(x0, x1 - x0, -thickness, width_ + thickness)) return;
  if (!cut(y0, y1 - y0, -thickness, height_ + thickness)) return;
  const double stepX = (to - from) * (x1 - x0);
  const double stepY = (to - from) * (y1 - y0);
  const double steps = std::max({std::abs(stepX), std::abs(stepY), 1.0});
  const int half = thickness / 2;
  for (int step = 0; step <= static_cast<int>(steps); ++step) {
    const double share = step / steps;
    fill(static_cast<int>(std::lround(x0 + from * (x1 - x0) + share * stepX)) - half,
         static_cast<int>(std::lround(y0 + from * (y1 - y0) + share * stepY)) - half, thickness,
         thickness, colour);
  }
}

void Picture::ring(double x, double y, double radius, int thickness, Colour colour) {
  const double inner = radius - thickness;
  for (int dy = static_cast<int>(-radius) - 1; dy <= static_cast<int>(radius) + 1; ++dy) {
    for (int dx = static_cast<int>(-radius) - 1; dx <= static_cast<int>(radius) + 1; ++dx) {
      const double squared = dx * dx + dy * dy;
      if (squared > radius * radius || squared < inner * inner) continue;
      set(static_cast<int>(std::lround(x)) + dx, static_cast<int>(std::lround(y)) + dy, colour);
    }
  }
}

void Picture::text(int x, int y, int scale, Colour colour, const std::string& text) {
  std::string ascii = text;
  std::replace_if(ascii.begin(), ascii.end(), [](char c) { return c < 32 || c > 126; }, '?');
  std::vector<FontVertex> corners(kVerticesOfCharacter * (ascii.size() + 1));
  const int rectangles = stb_easy_font_print(0.0F, 0.0F, ascii.data(), nullptr, corners.data(),
                                             static_cast<int>(corners.size() * sizeof(FontVertex)));
  for (int i = 0; i < rectangles; ++i) {
    const FontVertex& upperLeft = corners[4 * static_cast<std::size_t>(i)];
    const FontVertex& lowerRight = corners[4 * static_cast<std::size_t>(i) + 2];
    fill(x + static_cast<int>(upperLeft.x) * scale, y + static_cast<int>(upperLeft.y) * scale,
         static_cast<int>(lowerRight.x - upperLeft.x) * scale,
         static_cast<int>(lowerRight.y - upperLeft.y) * scale, colour);
  }
}

int Picture::textWidth(int scale, const std::string& text) {
  std::string copy = text;
  return scale * stb_easy_font_width(copy.data());
}

std::vector<std::byte> Picture::png() const {
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_);
  image.height = static_cast<png_uint_32>(height_);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<std::byte> bytes(size);
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb_.data(), 0, nullptr) == 0) {
    throw std::runtime_error(std::string("picture can't be encoded: ") + image.message);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace ortung::app
