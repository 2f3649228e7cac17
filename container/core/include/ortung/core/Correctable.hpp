#pragma once

#include <array>
#include <memory>
#include <vector>

#include "ortung/base/Angles.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/Weigher.hpp"

namespace ortung {

/// What a device gets wrong always in the same way: it reads a distance r as
/// r (1 + perMetre) + metres, and a bearing b as b + radians.
struct DeviceBias {
  double metres = 0.0;    ///< [m]
  double perMetre = 0.0;  ///< [m/m]
  double radians = 0.0;   ///< [rad]

  bool operator==(const DeviceBias&) const = default;
  double distance(double read) const { return (read - metres) / (1.0 + perMetre); }
  double bearing(double read) const { return wrapAngle(read - radians); }
};

/// One value of a reading beside what is expected of it at a pose.
struct ReadingResidual {
  bool isAngle = false;
  double value = 0.0;              ///< reading - expectation [m] or [rad]
  double expected = 0.0;           ///< [m] or [rad]
  std::array<double, 3> byPose{};  ///< derivatives of the expectation by x, y, theta of the robot
  double sigma = 0.0;              ///< [m] or [rad]
  double outliers = 0.05;          ///< floor of p, see SensorModel
};

/// A weigher of distances or bearings that a device may read wrong always in the same way, which
/// can be learned while it runs.
class ORTUNG_API Correctable {
 public:
  virtual ~Correctable();
  /// Adds the residuals at @p pose of what is expected there. Thread-safe.
  virtual void residualsAt(const Pose2& pose, std::vector<ReadingResidual>& residuals) const = 0;
  /// The same reading without that bias.
  virtual std::shared_ptr<const Weigher> corrected(const DeviceBias& bias) const = 0;

 protected:
  Correctable() = default;
  Correctable(const Correctable&) = default;
  Correctable& operator=(const Correctable&) = default;
};

}  // namespace ortung
