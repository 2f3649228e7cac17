#pragma once

#include <array>
#include <memory>
#include <vector>

#include "ortung/base/Angles.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/Weigher.hpp"

namespace ortung {

/// The systematic error of a device: it reads a distance r as
/// r (1 + perMetre) + metres, and a bearing b as b + radians.
struct DeviceBias {
  double metres = 0.0;    ///< constant error of distances [m]
  double perMetre = 0.0;  ///< error per metre of distance [m/m]
  double radians = 0.0;   ///< constant error of bearings [rad]

  bool operator==(const DeviceBias&) const = default;
  /// Returns the true distance [m] for a distance that was read.
  double distance(double read) const { return (read - metres) / (1.0 + perMetre); }
  /// Returns the true bearing [rad] for a bearing that was read.
  double bearing(double read) const { return wrapAngle(read - radians); }
};

/// One value of a reading with its expectation at a pose.
struct ReadingResidual {
  bool isAngle = false;
  double value = 0.0;              ///< reading - expectation [m] or [rad]
  double expected = 0.0;           ///< expectation [m] or [rad]
  std::array<double, 3> byPose{};  ///< derivatives of the expectation by x, y, theta of the robot
  double sigma = 0.0;              ///< standard deviation of the value [m] or [rad]
  double outliers = 0.05;          ///< floor of p, see SensorModel
};

/// A weigher of distances or bearings whose device may have a systematic error, which can be
/// learned while it runs.
class ORTUNG_API Correctable {
 public:
  virtual ~Correctable();
  /// Appends the residuals of all values that have an expectation at @p pose. Thread-safe.
  virtual void residualsAt(const Pose2& pose, std::vector<ReadingResidual>& residuals) const = 0;
  /// Returns a weigher of the same reading without that bias.
  virtual std::shared_ptr<const Weigher> corrected(const DeviceBias& bias) const = 0;

 protected:
  Correctable() = default;
  Correctable(const Correctable&) = default;
  Correctable& operator=(const Correctable&) = default;
};

}  // namespace ortung
