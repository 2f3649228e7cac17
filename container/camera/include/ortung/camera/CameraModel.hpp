#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"

namespace ortung {

/// Size of an image [px].
struct ImageSize {
  int width = 0;
  int height = 0;
  bool operator==(const ImageSize&) const = default;
};

/// A place in an image: u to the right, v down; the middle of the first pixel is (0, 0).
struct Pixel {
  double u = 0.0;
  double v = 0.0;
};

/// A point [m] or a direction; the place where it is used says in which frame.
struct Point3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

/// How a camera maps rays to pixels.
///
/// Camera frame: x to the right, y down, z along the optical axis, from the one point that all rays
/// go through. Nothing here knows where the camera is: that is a CameraPlace.
/// Immutable, hence thread-safe.
class ORTUNG_API CameraModel {
 public:
  virtual ~CameraModel();
  CameraModel(const CameraModel&) = delete;
  CameraModel& operator=(const CameraModel&) = delete;

  ImageSize size() const { return common_.size; }

  /// Returns the pixel that shows a point or a direction in the camera frame; it may lie beyond the
  /// image's edges. Nothing is returned outside of the field of view: behind the camera, beyond the
  /// angle up to which the model is one to one, within the masked part.
  std::optional<Pixel> project(const Point3& point) const;

  /// Returns the direction that a pixel shows, of length 1; the inverse of project(). Nothing where
  /// a pixel shows nothing of the world.
  std::optional<Point3> unproject(const Pixel& pixel) const;

  /// Returns whether a pixel lies in the image.
  bool contains(const Pixel& p) const {
    return p.u >= -0.5 && p.v >= -0.5 && p.u < size().width - 0.5 && p.v < size().height - 0.5;
  }

  /// Returns the lines of a TOML table from which readCamera() makes the same model.
  std::string toml() const;

 protected:
  /// Settings that all models have.
  struct Common {
    ImageSize size;
    Pixel centre;             ///< principal point [px]
    bool isMirrored = false;  ///< left and right are exchanged, as a mirror does
    double inner = 0.0;       ///< radius around the centre that shows nothing of the world [px]
    double outer = 0.0;       ///< radius beyond which nothing is shown [px]; 0: no such border
  };
  explicit CameraModel(const Common& common) : common_(common) {}
  static Common readCommon(const Parameters& camera);
  const Pixel& centre() const { return common_.centre; }

 private:
  bool shows(const Pixel& pixel) const;
  virtual std::optional<Pixel> toPixel(const Point3& point) const = 0;
  virtual std::optional<Point3> toRay(const Pixel& pixel) const = 0;
  virtual std::string ownToml() const = 0;

  Common common_;
};

/// Reads a robot file's table `camera` (docs/cameras.md): model = "perspective", "fisheye",
/// "unified", "ocam", "isometric" or "table". @throws ConfigError
ORTUNG_API std::shared_ptr<const CameraModel> readCamera(const Parameters& camera);

}  // namespace ortung
