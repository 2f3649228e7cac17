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

/// What one picture says about its camera.
struct LinePicture {
  std::vector<LinePoint> points;  ///< points on painted lines, as LineFinder finds them
  double floorTop = 0.0;          ///< row at which the floor ends, below the horizon [px]
};

/// The prior of a camera: what is known before its pictures are used. Sigmas are standard
/// deviations.
struct LineCalibrationGuess {
  double height = 0.7;         ///< height of the camera above the floor [m]
  double heightShare = 0.15;   ///< sigma of the height's logarithm
  std::optional<double> tilt;  ///< tilt [rad], e.g. by an inertial sensor; nothing: horizon's
  double tiltSigma = 0.3;      ///< sigma of the tilt [rad]
  double focalShare = 0.3;     ///< sigma of the focal length's logarithm
  double rollSigma = 0.05;     ///< sigma of the roll [rad], whose mean is 0
  double centreSigma = 0.02;   ///< sigma of the principal point / the image's longer side
  double pixelSigma = 1.0;     ///< sigma of a point's place in the image [px]
  /// Radial distortion k1, k2 of the lens: {0, 0} for the equidistant projection, to which wide
  /// lenses are close; kPlainLens for a lens that keeps straight lines straight.
  std::array<double, 2> distortion = {0.0, 0.0};
  static constexpr std::array<double, 2> kPlainLens = {1.0 / 3.0, 2.0 / 15.0};
  /// Focal lengths with which the search begins, as shares of the image's longer side.
  std::vector<double> focals = {0.3, 0.36, 0.43, 0.52, 0.65, 0.8};
};

/// How well one picture fits the field.
struct LinePictureFit {
  Pose2 pose;                 ///< pose of the camera's sensor frame in the field frame
  std::size_t points = 0;     ///< number of points within 5 m of the camera
  double median = 0.0;        ///< their median distance to the nearest line [m]
  double matchedShare = 0.0;  ///< share of all points within 3 sigma of a line, in [0, 1]
};

/// The result of a calibration by lines.
struct LineCalibration {
  CameraView view;                       ///< camera model and mount
  double cost = 0.0;                     ///< mean cost of all points, see LinePose
  std::vector<LinePictureFit> pictures;  ///< fits in the order of the pictures
};

/// Calibrates a camera by the field lines in its pictures alone: focal length, radial distortion
/// and principal point of a fisheye (Kannala-Brandt), height, tilt and roll.
/// Focal lengths and heights are tried one by one with a search of the whole field for each
/// picture; the best are refined together with the pictures' poses.
/// @param size size of the pictures [px]
/// @param pictures pictures of one camera that did not move on its robot; those with few points
///   are used, too
/// @param progress called with the share that is done, in [0, 1]; may throw to cancel
/// @return nothing if no picture has points
ORTUNG_API std::optional<LineCalibration> calibrateByLines(
    ImageSize size, std::span<const LinePicture> pictures, const LinePoseSearch& field,
    const LineCalibrationGuess& guess, const std::function<void(double)>& progress = {});

}  // namespace ortung
