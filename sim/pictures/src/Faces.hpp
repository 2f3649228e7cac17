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
  std::vector<Point3> rays;  ///< unit vectors in the camera frame; (0, 0, 0) where it sees nothing
  explicit PixelRays(const CameraModel& model);
  bool isSeen(std::size_t pixel) const {
    const Point3& r = rays[pixel];
    return r.x != 0.0 || r.y != 0.0 || r.z != 0.0;
  }
};

/// A face and the pixels that are taken from it.
struct FacePart {
  SheetFace face;                     ///< the face; its column and row are not known yet
  std::vector<std::uint32_t> pixels;  ///< indices of the camera's pixels
};

/// Returns the face that is the camera's whole picture if the camera is perspective and without
/// distortion; otherwise nothing.
std::optional<SheetFace> plainFace(const PixelRays& rays);

/// Returns faces that show all pixels, each at the resolution that its pixels need, with as few
/// texels as possible.
std::vector<FacePart> facesFor(const PixelRays& rays);

/// Places the faces on the sheet. @returns the size of the sheet
ImageSize pack(std::span<FacePart> parts);

}  // namespace ortung
