#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/camera/CameraView.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/vision/Colours.hpp"

namespace ortung {

/// A connected part of an image whose pixels are of one class of colours.
struct Blob {
  Pixel middle;  ///< of its pixels
  double uMin = 0.0, uMax = 0.0, vMin = 0.0, vMax = 0.0;
  double pixels = 0.0;  ///< how many
};

/// A ball on the floor, in the sensor's frame.
struct SeenBall {
  double range = 0.0;    ///< to its middle, along the floor [m]
  double bearing = 0.0;  ///< [rad]
};

/// Connected parts of one class, the largest first; those of less than @p leastPixels are left out.
/// Works on every second pixel of large images. (OpenCV's connected components.)
ORTUNG_API std::vector<Blob> findBlobs(const ImageView& image, const ColourTable& colours,
                                       ColourClass what, double leastPixels);

/// Blobs that are as large as a ball of this radius [m] would be where they are, and about round,
/// the nearest first.
ORTUNG_API std::vector<SeenBall> findBalls(const ImageView& image, const ColourTable& colours,
                                           const CameraView& view, double radius, double maxRange);

}  // namespace ortung
