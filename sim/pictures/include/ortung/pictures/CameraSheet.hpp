#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/camera/CameraModel.hpp"
#include "ortung/sim_api/Drawing.hpp"

namespace ortung {

/// The composition of a camera's picture from perspective ones (faces) on one sheet: which these
/// are, and where on the sheet each pixel is. A perspective camera without distortion needs one
/// face, which is its picture. For others each direction is drawn at about the camera's resolution
/// there. Immutable, hence thread-safe.
class ORTUNG_API CameraSheet {
 public:
  /// @throws std::invalid_argument for a camera that sees nothing, or that is too large to draw
  explicit CameraSheet(const CameraModel& model);

  /// Returns the perspective pictures on the sheet.
  std::span<const SheetFace> faces() const { return faces_; }
  /// Blackens the texels that resample() shows where the camera sees nothing.
  void blacken(std::span<std::uint32_t> sheet) const;
  ImageSize size() const { return size_; }            ///< size of the sheet [pixels]
  ImageSize picture() const { return picture_; }      ///< size of the camera's picture [pixels]
  bool isPicture() const { return places_.empty(); }  ///< whether the sheet is the picture

  /// Writes rows [first, first + count) of the picture, interpolated between four texels of the
  /// sheet's colours per pixel. Where the camera sees nothing it shows the sheet's last texels: see
  /// blacken().
  /// @pre neither is empty; out.size() == count * width
  void resample(std::span<const std::uint32_t> sheet, int first, int count,
                std::span<std::uint32_t> out) const;
  /// The place of a pixel on the sheet.
  struct Place {
    std::uint32_t texel = 0;  ///< index of the upper left of its four texels
    std::uint16_t right = 0;  ///< share of the right ones, of 128
    std::uint16_t below = 0;  ///< share of the lower ones, of 128
  };

 private:
  ImageSize picture_;
  ImageSize size_;
  std::vector<SheetFace> faces_;
  std::vector<Place> places_;  ///< place of each pixel; empty: the sheet is the picture
  std::uint32_t nowhere_ = 0;  ///< texel of the pixels that show nothing, in the last rows
};

}  // namespace ortung
