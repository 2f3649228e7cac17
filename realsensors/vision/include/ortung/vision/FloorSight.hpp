#pragma once

#include <optional>

#include "ortung/base/Export.hpp"
#include "ortung/camera/CameraView.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/vision/Colours.hpp"

namespace ortung {

/// Returns the row at which the floor ends in a picture [px]: the first quintile of the rows at
/// which it ends in a hundred columns, or the image's middle if there is no floor.
ORTUNG_API double floorTopOf(const ImageView& image, const ColourTable& colours);

/// A place on the floor that a pixel shows, and its standard deviation in the direction in which
/// that is greatest.
struct FloorSight {
  double x = 0.0, y = 0.0;  ///< the place in the sensor's frame [m]
  double sigma = 0.0;       ///< standard deviation of the place, at least 0.02 [m]
};
/// Computes the place on the floor that a pixel shows; nothing above the horizon.
/// @param pixelSigma standard deviation of the pixel's place in the image [px]
ORTUNG_API std::optional<FloorSight> floorSightOf(const CameraView& view, const Pixel& pixel,
                                                  double pixelSigma);

}  // namespace ortung
