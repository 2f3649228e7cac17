#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/camera/CameraModel.hpp"

namespace ortung {

/// The camera's pose on its sensor's mount. The sensor's frame lies on the floor: x where the
/// sensor looks, y to the left, z up.
struct CameraPlace {
  double z = 0.0;     ///< the camera's height above the floor [m]
  double tilt = 0.0;  ///< angle of the optical axis below the horizon [rad]; pi / 2: straight down
  double roll = 0.0;  ///< about the optical axis, clockwise as the camera looks [rad]
};

/// A camera in its place, which maps the world around the sensor to pixels and back.
/// Immutable, hence thread-safe.
class ORTUNG_API CameraView {
 public:
  CameraView(std::shared_ptr<const CameraModel> model, const CameraPlace& place);

  const CameraModel& model() const { return *model_; }
  const std::shared_ptr<const CameraModel>& sharedModel() const { return model_; }
  const CameraPlace& place() const { return place_; }

  /// Returns the pixel of a point in the sensor's frame [m], or nothing as in
  /// CameraModel::project().
  std::optional<Pixel> pixelOf(const Point3& point) const;
  /// Returns where the ray of a pixel meets the plane at height @p z [m], in the sensor's frame
  /// [m]; nothing if it does not.
  std::optional<Point3> floorAt(const Pixel& pixel, double z = 0.0) const;
  /// Returns the direction that a pixel shows in the sensor's frame, of length 1.
  std::optional<Point3> rayAt(const Pixel& pixel) const;
  /// Returns the camera's axes x, y, z in the sensor's frame, three numbers each:
  /// a point in the camera frame is the matrix of these rows times (point - (0, 0, place().z)).
  const std::array<double, 9>& axes() const { return axes_; }

 private:
  std::shared_ptr<const CameraModel> model_;
  CameraPlace place_;
  std::array<double, 9> axes_;
};

/// Reads the table `camera` of a [[sensor]]: the model, tilt_deg and roll_deg.
/// @param z the sensor's height above the floor [m] @throws ConfigError
ORTUNG_API CameraView readCameraView(const Parameters& camera, double z);

/// Returns the lines of that table, from which readCameraView() makes the same view.
ORTUNG_API std::string toToml(const CameraView& view);

}  // namespace ortung
