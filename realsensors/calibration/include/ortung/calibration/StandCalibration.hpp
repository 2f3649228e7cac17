#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/calibration/LineCalibration.hpp"
#include "ortung/camera/CameraView.hpp"
#include "ortung/vision/FieldLines.hpp"
#include "ortung/vision/Verdict.hpp"

namespace ortung {

/// A picture of a camera whose tilt changes, and what else is known of the moment.
struct Stand {
  LinePicture lines;
  /// What joints and an inertial sensor say of the camera's tilt [rad].
  double tilt = 0.0;
  /// Where the robot stood, by other means, in the field frame [m]: on either half, as both look
  /// the same.
  std::optional<LinePlace> place;
};

/// What is known before of a camera on a stand, or on a neck. Sigmas are standard deviations.
struct StandGuess {
  double height = 0.7;       ///< height of the camera above the floor [m]
  double heightShare = 0.1;  ///< sigma of the height's logarithm
  double offsetSigma = 0.1;  ///< sigma of the offset between camera and sensors of its tilt [rad]
  double tiltSigma = 0.005;  ///< sigma of a single stand's tilt beside that offset [rad]
  double focalShare = 0.1;   ///< sigma of the focal length's logarithm
  double focal = 0.0;        ///< focal length [px]; 0: unknown, several are tried
  bool isPlain = false;      ///< whether the lens keeps straight lines straight
  double ahead = 0.0;        ///< how far the camera is ahead of the robot's place [m]
};

/// How one stand fits.
struct StandFit {
  Pose2 camera;               ///< pose of the camera's sensor frame in the field frame
  LinePlace robot;            ///< place of the robot [m]
  double tilt = 0.0;          ///< tilt of the camera [rad]
  std::size_t points = 0;     ///< points within 5 m
  double median = 0.0;        ///< their median distance to the nearest line [m]
  std::optional<double> off;  ///< distance to the known place [m]
};

/// How large a field is, by places that are known.
struct FieldScale {
  double scale = 1.0;           ///< true lengths / those of the world
  double sigma = 0.0;           ///< standard deviation, by how far the places are off
  double rootMeanSquare = 0.0;  ///< distance of places from the known ones with this scale [m]
};

/// A camera whose tilt sensors tell up to an offset.
struct StandCalibration {
  CameraView view;           ///< the camera at a tilt of 0 by the sensors: its tilt is the offset
  double offsetSigma = 0.0;  ///< standard deviation of the offset [rad]
  double heightSigma = 0.0;  ///< standard deviation of the height, if the lines are to scale [m]
  std::vector<StandFit> stands = {};     ///< fits in the order of the stands, to scale
  std::optional<FieldScale> scale = {};  ///< with three known places or more
  Verdict verdict = {};                  ///< whether the stands determine the camera
};

/// Calibrates a camera by field lines in pictures from several stands, whose tilts are known up to
/// a common offset: focal length, distortion, principal point, offset, roll and height, which all
/// stands share. The places are then found with these, each with a tilt of its own.
///
/// Pictures alone say nothing of lengths: a field and a height that are larger by the same factor
/// look the same. With three known places or more, the factor between them and those that were
/// found is the field's scale; height, poses and distances are given to that scale.
/// @param size size of the pictures [px]
/// @return nothing if no picture has points
ORTUNG_API std::optional<StandCalibration> calibrateStand(ImageSize size,
                                                          std::span<const Stand> stands,
                                                          const LinePoseSearch& field,
                                                          const StandGuess& guess);

/// Returns how much larger known places are than those that were found, with any turn and shift of
/// their frame, and the half of the field that each was on. Nothing for fewer than three, or for
/// places that are all the same.
ORTUNG_API std::optional<FieldScale> scaleOf(std::span<const LinePlace> found,
                                             std::span<const LinePlace> known);

}  // namespace ortung
