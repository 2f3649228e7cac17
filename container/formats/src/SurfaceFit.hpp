#pragma once

#include <memory>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/Polishable.hpp"
#include "ortung/tables/SensorModel.hpp"
#include "ortung/tables/SurfaceField.hpp"

namespace ortung {

/// How well the ends of a scan's beams lie on surfaces, and how a change of pose would help.
/// Immutable once all ends are there.
class ORTUNG_API SurfaceFit {
 public:
  SurfaceFit(std::shared_ptr<const SurfaceField> surfaces, const Pose2& mount,
             const SensorModel& model)
      : surfaces_(std::move(surfaces)), mount_(mount), model_(model) {}

  bool isEmpty() const { return range_.empty() || !surfaces_ || surfaces_->isEmpty(); }
  /// In the order of bearings. @param range finite [m] @param bearing in the sensor's frame [rad]
  void add(double range, double bearing);
  /// Residuals are distances from lines, whose variance is that of the range as a line at that
  /// slant shows it: so the information is that of the ranges (Censi, "On achievable accuracy for
  /// range-finder localization", ICRA 2007). How far residuals scatter, and how far those of
  /// neighbouring beams are alike, is taken from the scan itself.
  Slope slopeAt(const Pose2& robot) const;

 private:
  std::shared_ptr<const SurfaceField> surfaces_;
  Pose2 mount_;
  SensorModel model_;
  // The ends in the robot frame: a row of each quantity.
  std::vector<double> x_;  ///< [m]
  std::vector<double> y_;
  std::vector<double> c_;  ///< direction of its beam
  std::vector<double> s_;
  std::vector<double> range_;     ///< distance from the sensor [m]
  std::vector<double> variance_;  ///< of the range [m^2]
};

}  // namespace ortung
