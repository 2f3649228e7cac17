#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/camera/CameraView.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/vision/BallFinder.hpp"
#include "ortung/vision/Colours.hpp"

namespace ortung {

/// A connected part of an image whose pixels are of one class of colours.
struct Blob {
  Pixel middle;                                           ///< centroid of its pixels
  double uMin = 0.0, uMax = 0.0, vMin = 0.0, vMax = 0.0;  ///< bounding box [px]
  double pixels = 0.0;                                    ///< its area [px]
};

/// Finds the connected parts of one class, the largest first, by OpenCV's connected components.
/// Of large images every second pixel is used.
/// @param leastPixels least area of a part [px]
/// @return nothing for a grey image
ORTUNG_API std::vector<Blob> findBlobs(const ImageView& image, const ColourTable& colours,
                                       ColourClass what, double leastPixels);

/// Finds balls by a BallFinder that is made for this picture. Making one takes longer than finding
/// balls with it: keep one for several pictures of a camera.
/// @param radius   the ball's radius [m]
/// @param maxRange greatest distance along the floor [m]
ORTUNG_API std::vector<SeenBall> findBalls(const ImageView& image, const ColourTable& colours,
                                           const CameraView& view, double radius, double maxRange);

}  // namespace ortung
