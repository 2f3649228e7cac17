#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ortung/camera/CameraModel.hpp"
#include "ortung/sim_api/Drawing.hpp"

namespace ortung {

/// The directions of all pixels of a camera.
struct PixelRays {
  ImageSize size;
  std::vector<Point3> rays;  ///< of length 1; all 0: it sees nothing
  explicit PixelRays(const CameraModel& model);
  bool isSeen(std::size_t pixel) const {
    const Point3& r = rays[pixel];
    return r.x != 0.0 || r.y != 0.0 || r.z != 0.0;
  }
};

/// A face and the pixels that are taken from it.
struct FacePart {
  SheetFace face;                     ///< its column and row are not known yet
  std::vector<std::uint32_t> pixels;  ///< of the camera
};

/// The face that is the camera's whole picture, if it is a plain perspective one.
std::optional<SheetFace> plainFace(const PixelRays& rays);

/// Faces that show all pixels, each as finely as its pixels need, and as few pixels as that takes.
std::vector<FacePart> facesFor(const PixelRays& rays);

/// Puts the faces beside one another. @returns the size of the sheet
ImageSize pack(std::span<FacePart> parts);

}  // namespace ortung
