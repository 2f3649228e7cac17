#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/camera/CameraModel.hpp"
#include "ortung/sim_api/Drawing.hpp"

namespace ortung {

/// How a camera's picture is made of perspective ones that lie on one sheet: which these are, and
/// where on the sheet each pixel is. A perspective camera without distortion needs one, which is
/// its picture. For others each direction is drawn about as finely as the camera resolves it there.
/// Immutable, hence thread-safe.
class ORTUNG_API CameraSheet {
 public:
  /// @throws std::invalid_argument for a camera that sees nothing, or that is too large to draw
  explicit CameraSheet(const CameraModel& model);

  std::span<const SheetFace> faces() const { return faces_; }
  /// Makes black what resample() shows where the camera sees nothing.
  void blacken(std::span<std::uint32_t> sheet) const;
  ImageSize size() const { return size_; }            ///< of the sheet
  ImageSize picture() const { return picture_; }      ///< of the camera's picture
  bool isPicture() const { return places_.empty(); }  ///< the sheet is the picture

  /// Rows [first, first + count) of the picture from the sheet's colours, four texels a pixel.
  /// Where the camera sees nothing it shows the sheet's last texels: see blacken().
  /// @pre neither is empty; out.size() == count * width
  void resample(std::span<const std::uint32_t> sheet, int first, int count,
                std::span<std::uint32_t> out) const;
  /// The whole picture from what is on the sheet, the nearest texel a pixel; @p nothing where the
  /// camera sees nothing.
  void pick(std::span<const std::uint32_t> sheet, std::uint32_t nothing,
            std::span<std::uint32_t> out) const;
  void pick(std::span<const float> sheet, float nothing, std::span<float> out) const;

  /// Where a pixel is on the sheet.
  struct Place {
    std::uint32_t texel = 0;  ///< upper left of four
    std::uint16_t right = 0;  ///< share of the right ones, of 128
    std::uint16_t below = 0;  ///< share of the lower ones, of 128
  };

 private:
  template <class Value>
  void pickNearest(std::span<const Value> sheet, Value nothing, std::span<Value> out) const;

  ImageSize picture_;
  ImageSize size_;
  std::vector<SheetFace> faces_;
  std::vector<Place> places_;  ///< by pixel; empty: the sheet is the picture
  std::uint32_t nowhere_ = 0;  ///< the texel of pixels that show nothing: of the last rows
};

}  // namespace ortung
