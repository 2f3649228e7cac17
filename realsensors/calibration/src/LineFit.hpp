#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "ortung/calibration/LineCalibration.hpp"

namespace ortung {

/// The parameters that are estimated. Lengths are their logarithms, which keeps them positive.
enum Setting { kFocal, kK1, kK2, kCentreU, kCentreV, kTilt, kRoll, kHeight, kSettings };
using Settings = Eigen::Matrix<double, kSettings, 1>;
using SettingsCovariance = Eigen::Matrix<double, kSettings, kSettings>;

/// The camera that settings describe.
CameraView viewOf(ImageSize size, const Settings& s);

/// A hypothesis: settings of the camera, and the pose at which each picture was taken.
struct LineSolution {
  Settings settings;
  Settings prior;  ///< the settings that were expected before
  std::vector<Pose2> poses;
  double cost = 0.0;  ///< mean cost of all points, with the prior's
};

/// Fits a camera and the poses of its pictures to the lines of a field.
class LineFit {
 public:
  LineFit(ImageSize size, std::span<const LinePicture> pictures, const LinePoseSearch& field,
          const LineCalibrationGuess& guess);

  /// Returns the settings with which a search begins. The horizon is a little above the row at
  /// which the floor ends.
  /// @param far how far away the floor ends [m]
  Settings start(double focalShare, double height, double far) const;
  /// Searches the whole field for the pose of each picture, with given settings.
  LineSolution search(const Settings& settings, const Settings& prior) const;
  /// Takes Levenberg and Marquardt's steps on settings and poses together.
  void refine(LineSolution& solution, int steps) const;
  /// Describes how each picture fits, without a verdict on its place.
  std::vector<LinePictureFit> fits(const LineSolution& solution) const;

  /// The camera as it was when a picture was taken.
  CameraView viewOf(const Settings& settings, std::size_t picture) const;

  /// The places that a picture's points show, in the sensor's frame, size N.
  struct Places {
    std::vector<LinePlace> points;  ///< [m]
    std::vector<double> sigmas;     ///< standard deviations of two pixels' error [m]
  };
  Places placesOf(const Settings& settings, std::size_t picture) const;

  /// How sure the settings are.
  struct Certainty {
    SettingsCovariance covariance;
    double points = 0.0;  ///< number of points, of which neighbours with like errors count as one
  };
  Certainty certainty(const LineSolution& solution) const;
  /// Standard deviations of the settings that were expected before.
  const Settings& priorSigmas() const { return sigmas_; }
  ImageSize size() const { return size_; }
  const LinePoseSearch& field() const { return field_; }
  std::size_t points() const;  ///< number of points that are used, of all pictures

 private:
  /// A point and the nearest line.
  struct Match {
    Pixel pixel;
    double x, y;      ///< the point in the sensor's frame [m]
    double nx, ny;    ///< unit normal from the line to the point, in the field frame
    double distance;  ///< [m]
    double sigma;     ///< standard deviation of the distance [m]
  };
  using Slope = Eigen::Matrix<double, kSettings + 3, 1>;  ///< slope of a distance

  struct Normal {
    Eigen::MatrixXd information;
    Eigen::VectorXd gradient;
  };

  template <typename What>
  void eachMatch(const LineSolution& solution, std::size_t i, const What& what) const;
  template <typename What>
  void eachSlope(const LineSolution& solution, const What& what) const;
  double costOf(const LineSolution& solution) const;
  Normal gather(const LineSolution& solution) const;
  double alikenessOf(const LineSolution& solution) const;
  static LineSolution moved(const LineSolution& solution, const Eigen::VectorXd& move);
  Eigen::Index unknowns() const { return poseAt(pixels_.size()); }
  /// Index of the first unknown of a picture's pose.
  static Eigen::Index poseAt(std::size_t picture) {
    return kSettings + 3 * static_cast<Eigen::Index>(picture);
  }

  ImageSize size_;
  const LinePoseSearch& field_;
  LineCalibrationGuess guess_;
  std::vector<std::vector<Pixel>> pixels_;  ///< pixels of each picture's points
  std::vector<double> tilts_;               ///< tilt of each picture beyond that of all [rad]
  double floorTop_ = 0.0;                   ///< highest row at which a picture's floor ends [px]
  Settings sigmas_;                         ///< standard deviations of the prior
};

}  // namespace ortung
