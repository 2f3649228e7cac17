#pragma once

#include <optional>

#include "ortung/base/Export.hpp"
#include "ortung/camera/CameraView.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/vision/Colours.hpp"

namespace ortung {

/// Row at which the floor ends in a picture: between what is floor and what is not, as the fifth
/// highest share of a hundred columns tells [px]; the image's middle if there is no floor.
ORTUNG_API double floorTopOf(const ImageView& image, const ColourTable& colours);

/// Sigma of the place on the floor that a pixel shows, across the direction in which it is worst,
/// for an error of @p pixelSigma [px], and at least 0.02 m; nothing where it shows no floor.
struct FloorSight {
  double x = 0.0, y = 0.0;  ///< in the sensor's frame [m]
  double sigma = 0.0;       ///< [m]
};
ORTUNG_API std::optional<FloorSight> floorSightOf(const CameraView& view, const Pixel& pixel,
                                                  double pixelSigma);

}  // namespace ortung
