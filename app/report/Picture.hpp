#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ortung::app {

struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

/// A small raster image; x to the right, y down. Drawings are clipped at its border.
class Picture {
 public:
  Picture(int width, int height, Colour background);

  int width() const { return width_; }
  int height() const { return height_; }
  void set(int x, int y, Colour colour);
  void fill(int x, int y, int width, int height, Colour colour);
  void line(double x0, double y0, double x1, double y1, int thickness, Colour colour);
  void ring(double x, double y, double radius, int thickness, Colour colour);
  /// Writes ASCII text with its upper left corner at (x, y). @param scale size of a font pixel
  void text(int x, int y, int scale, Colour colour, const std::string& text);
  /// Returns the width of a text [px].
  static int textWidth(int scale, const std::string& text);

  /// Returns the bytes of a PNG file. @throws std::runtime_error
  std::vector<std::byte> png() const;

 private:
  int width_;
  int height_;
  std::vector<std::uint8_t> rgb_;
};

}  // namespace ortung::app
