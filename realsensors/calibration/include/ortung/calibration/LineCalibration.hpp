#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/camera/CameraView.hpp"
#include "ortung/vision/FieldLines.hpp"
#include "ortung/vision/FloorMask.hpp"
#include "ortung/vision/LineFinder.hpp"
#include "ortung/vision/LinePoseVerdict.hpp"
#include "ortung/vision/LinesInSight.hpp"
#include "ortung/vision/Verdict.hpp"

namespace ortung {

/// What one picture says about its camera.
struct LinePicture {
  std::vector<LinePoint> points;  ///< points on painted lines, as LineFinder finds them
  double floorTop = 0.0;          ///< row at which the floor ends, below the horizon [px]
  FloorMask floor = {};           ///< bare floor that it shows; unknown: all that has no points
  double tilt = 0.0;              ///< tilt of the camera beyond that of all pictures [rad]
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
  /// Focal lengths of other cameras of this kind with pictures of the same size [px]; may be empty.
  std::vector<double> kind = {};
};

/// How well one picture fits the field.
struct LinePictureFit {
  Pose2 pose;                 ///< pose of the camera's sensor frame in the field frame
  std::size_t points = 0;     ///< number of points within 5 m of the camera
  double median = 0.0;        ///< their median distance to the nearest line [m]
  double matchedShare = 0.0;  ///< share of all points within 3 sigma of a line, in [0, 1]
  std::size_t strayNear = 0;  ///< number of points within 5 m that are on no line
  LinesInSight inSight;       ///< what it shows of the field's lines within 5 m
  LinePoseVerdict place;      ///< whether its points say where it was taken, with this camera
};

/// One estimated parameter of a camera.
struct LineSetting {
  std::string name;            ///< its name in the table `camera`: "focal_px", "k1", ...
  double value = 0.0;          ///< [px], [m], [degrees] or without a unit, as its name says
  double sigma = 0.0;          ///< standard deviation by the pictures and by what was known before
  double expected = 0.0;       ///< value that was expected before
  double expectedSigma = 0.0;  ///< its standard deviation
};

/// The result of a calibration by lines.
struct LineCalibration {
  CameraView view;                            ///< camera model and mount
  double cost = 0.0;                          ///< mean cost of all points, see LinePose
  std::vector<LinePictureFit> pictures = {};  ///< fits in the order of the pictures
  /// focal_px, k1, k2, centre_u_px, centre_v_px, tilt_deg, roll_deg, height_m, in this order.
  std::vector<LineSetting> settings = {};
  std::vector<double> covariance = {};  ///< covariance of the settings, row by row; 8 x 8
  double floorSigma = 0.0;              ///< sigma of ranges on the floor 1 to 3 m away / the range
  double points = 0.0;  ///< number of points, of which those with like errors are one
  /// How much worse the best other camera fits: its cost over all such points, less this one's.
  /// Infinity: none was found. 9 is what an error of three sigmas costs.
  double rivalCost = 0.0;
  double rivalFocal = 0.0;  ///< focal length of that camera [px]; 0: there is none
  /// The greatest change of the focal length when one picture is left out, in its sigmas; 0 with a
  /// single picture.
  double mostChange = 0.0;
  Verdict verdict = {};  ///< whether the pictures determine the camera
};

/// Returns the verdict on a calibration by the figures that it holds.
/// @param guess what was known before
ORTUNG_API Verdict judgeCalibration(const LineCalibration& calibration,
                                    const LineCalibrationGuess& guess);
/// Takes into account a calibration by other lines, such as those of another world, whose camera
/// may fit as well: updates the rival's cost. The verdict is to be made again.
ORTUNG_API void considerRival(LineCalibration& calibration, const LineCalibration& other);

/// Calibrates a camera by the field lines in its pictures alone: focal length, radial distortion
/// and principal point of a fisheye (Kannala-Brandt), height, tilt and roll.
/// Focal lengths and heights are tried one by one with a search of the whole field for each
/// picture; the best are refined together with the pictures' poses. There is a result in any case;
/// its verdict says whether the pictures determine it.
/// @param size size of the pictures [px]
/// @param pictures pictures of one camera that did not move on its robot; those with few points
///   are used, too
/// @param progress called with the share that is done, in [0, 1]; may throw to cancel
/// @return nothing if no picture has points
ORTUNG_API std::optional<LineCalibration> calibrateByLines(
    ImageSize size, std::span<const LinePicture> pictures, const LinePoseSearch& field,
    const LineCalibrationGuess& guess, const std::function<void(double)>& progress = {});

}  // namespace ortung
