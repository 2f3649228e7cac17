#include "ortung/vision/FloorMask.hpp"

#include <cmath>

namespace ortung {

FloorMask::FloorMask(const ImageView& image, const ColourTable& colours) {
  constexpr int kLeastFloor = kCell * kCell * 3 / 4;  // pixels of a square
  columns_ = image.size.width / kCell;
  rows_ = image.size.height / kCell;
  cells_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
  if (image.format != PixelFormat::kRgb) return;
  const auto pitch = static_cast<std::size_t>(image.size.width) * 3;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      int floor = 0;
      for (int v = row * kCell; v < (row + 1) * kCell; ++v)
        for (int u = column * kCell; u < (column + 1) * kCell; ++u)
          floor += colours.isFloor(image.pixels + static_cast<std::size_t>(v) * pitch +
                                   static_cast<std::size_t>(u) * 3)
                       ? 1
                       : 0;
      cells_[static_cast<std::size_t>(row * columns_ + column)] = floor >= kLeastFloor ? 1 : 0;
    }
}

bool FloorMask::isFloor(const Pixel& pixel) const {
  // Pixels far outside, or not a number, would not fit into an int.
  if (!(pixel.u > -0.5 && pixel.v > -0.5 && pixel.u < columns_ * kCell - 0.5 &&
        pixel.v < rows_ * kCell - 0.5))
    return false;
  const int column = static_cast<int>(pixel.u + 0.5) / kCell;
  const int row = static_cast<int>(pixel.v + 0.5) / kCell;
  return cells_[static_cast<std::size_t>(row * columns_ + column)] != 0;
}

}  // namespace ortung
