#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/camera/CameraView.hpp"
#include "ortung/vision/FieldLines.hpp"
#include "ortung/vision/LineFinder.hpp"

namespace ortung {

/// What one picture tells of its camera.
struct LinePicture {
  std::vector<LinePoint> points;  ///< where lines are
  double floorTop = 0.0;          ///< row at which the floor ends: a little below the horizon [px]
};

/// What is known of a camera before its pictures are looked at.
struct LineCalibrationGuess {
  double height = 0.7;         ///< above the floor [m]
  double heightShare = 0.15;   ///< sigma of its logarithm
  std::optional<double> tilt;  ///< e.g. of an inertial sensor [rad]; nothing: from the horizon
  double tiltSigma = 0.3;      ///< [rad]
  double focalShare = 0.3;     ///< sigma of the focal length's logarithm
  double rollSigma = 0.05;     ///< [rad]
  double centreSigma = 0.02;   ///< of the principal point, as a share of the image's longer side
  double pixelSigma = 1.0;     ///< of points [px]
  /// Radial distortion k1, k2 of the lens: {0, 0} if equal angles are equally wide, as wide lenses
  /// about have it; kPlainLens for one that keeps straight lines straight.
  std::array<double, 2> distortion = {0.0, 0.0};
  static constexpr std::array<double, 2> kPlainLens = {1.0 / 3.0, 2.0 / 15.0};
  /// Focal lengths to begin with, as shares of the image's longer side.
  std::vector<double> focals = {0.3, 0.36, 0.43, 0.52, 0.65, 0.8};
};

/// How well one picture fits the field.
struct LinePictureFit {
  Pose2 pose;                 ///< of the camera's sensor frame, in the field frame
  std::size_t points = 0;     ///< within 5 m of the camera
  double median = 0.0;        ///< distance of those to the nearest line [m]
  double matchedShare = 0.0;  ///< of all points: within 3 sigma of a line
};

struct LineCalibration {
  CameraView view;
  double cost = 0.0;  ///< mean of points, see LinePose
  std::vector<LinePictureFit> pictures;
};

/// The camera, from the lines of pictures alone: focal length, radial distortion and principal
/// point of a fisheye (Kannala-Brandt), height, tilt and roll, so that all pictures fit the field.
/// Focal lengths and heights are tried one by one with a search of the whole field for each
/// picture; the best are refined together with the pictures' poses.
/// @param pictures of one camera that did not move on its robot; one with few points is used, too
/// @param progress called with a share in [0, 1], and may throw to give up
/// @return nothing if no picture has points
ORTUNG_API std::optional<LineCalibration> calibrateByLines(
    ImageSize size, std::span<const LinePicture> pictures, const LinePoseSearch& field,
    const LineCalibrationGuess& guess, const std::function<void(double)>& progress = {});

}  // namespace ortung
