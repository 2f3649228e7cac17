#pragma once

#include "ortung/base/Export.hpp"

namespace ortung {

/// The systematic error of an observer of landmarks. Of a landmark at range r [m] and bearing b
/// [rad] it measures
///   range:   r (1 + perMetre + perMetreRad b + perMetreRad2 b^2) + metres
///   bearing: b + radians + perRad b + perRad2 b^2
/// A camera that measures distances along its optical axis has perMetreRad2 of -1/2, since the
/// cosine of a small b is 1 - b^2/2; the other terms are those of its lens. Immutable.
struct ORTUNG_API SightingBias {
  double metres = 0.0;        ///< constant error of ranges [m]
  double perMetre = 0.0;      ///< error per metre of range [m/m]
  double perMetreRad = 0.0;   ///< [1/rad]
  double perMetreRad2 = 0.0;  ///< [1/rad^2]
  double radians = 0.0;       ///< constant error of bearings [rad]
  double perRad = 0.0;        ///< [rad/rad]
  double perRad2 = 0.0;       ///< [1/rad]

  bool operator==(const SightingBias&) const = default;

  struct Sight {
    double range = 0.0;    ///< range [m]
    double bearing = 0.0;  ///< bearing in the sensor's frame [rad]
  };
  /// Returns what is measured of a landmark that truly is at @p truth. Ranges are never below 0.
  Sight measured(const Sight& truth) const;
  /// Returns the true range and bearing of a measurement: the inverse of measured().
  Sight corrected(const Sight& measured) const;

 private:
  double scaleAt(double bearing) const;
};

}  // namespace ortung
