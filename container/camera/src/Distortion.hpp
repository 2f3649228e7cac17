#pragma once

#include <optional>
#include <vector>

#include "ortung/base/Parameters.hpp"
#include "ortung/camera/CameraModel.hpp"

namespace ortung {

/// A point of the plane at distance 1 in front of a camera.
struct PlanePoint {
  double x = 0.0;
  double y = 0.0;
};

/// Radial and tangential distortion of a plane (Brown, "Decentering distortion of lenses", 1966),
/// with coefficients in OpenCV's order: k1, k2, p1, p2, k3.
class Distortion {
 public:
  /// Reads the key `distortion`; coefficients that are missing are 0.
  /// @param farthest radius of the undistorted plane that is ever asked for
  /// @param most number of coefficients that the camera's model has, at most five
  /// @throws ConfigError
  Distortion(const Parameters& camera, double farthest, std::size_t most = 5);

  /// Nothing beyond the radius up to which the map is one to one.
  std::optional<PlanePoint> distort(const PlanePoint& p) const;
  std::optional<PlanePoint> undistort(const PlanePoint& p) const;
  const std::vector<double>& coefficients() const { return given_; }

 private:
  Distortion(const std::vector<double>& coefficients, double farthest);
  double radial(double r, double& slope) const;
  PlanePoint apply(const PlanePoint& p) const;
  std::optional<PlanePoint> polish(PlanePoint guess, const PlanePoint& wanted) const;

  std::vector<double> given_;
  double k1_ = 0.0, k2_ = 0.0, p1_ = 0.0, p2_ = 0.0, k3_ = 0.0;
  double mostRadius_ = 0.0;  ///< undistorted
  double mostDistorted_ = 0.0;
};

}  // namespace ortung
