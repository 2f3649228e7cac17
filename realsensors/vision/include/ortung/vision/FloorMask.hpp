#pragma once

#include <cstdint>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/vision/Colours.hpp"

namespace ortung {

/// Where a picture shows bare floor, in squares of some pixels. Immutable once made.
class ORTUNG_API FloorMask {
 public:
  static constexpr int kCell = 4;  ///< side of a square [px]

  /// A mask of nothing: it knows no picture.
  FloorMask() = default;
  /// Squares with the floor's colour in most of their pixels; a grey image has none.
  FloorMask(const ImageView& image, const ColourTable& colours);

  /// Whether it is of a picture.
  bool isKnown() const { return columns_ > 0; }
  /// Whether the square around a pixel shows floor; false outside of the picture.
  bool isFloor(const Pixel& pixel) const;

 private:
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint8_t> cells_;  ///< row by row; 1: floor
};

}  // namespace ortung
