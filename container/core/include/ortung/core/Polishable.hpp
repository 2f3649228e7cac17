#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {

/// The log-likelihood of readings for a small change d = (x [m], y [m], theta [rad]) of a pose, in
/// the field frame: ln p(s|l + d) = ln p(s|l) + pull d - d^T information d / 2, after Gauss and
/// Newton: of the second derivatives those of the expectations are left out.
struct ORTUNG_API Slope {
  std::array<double, 9> information{};  ///< row-major, symmetric, positive semidefinite
  std::array<double, 3> pull{};         ///< gradient of ln p
  /// Standard deviation of what the readings are compared with, e.g. the map, which more readings
  /// do not average out: of positions [m], and of headings [rad].
  double blurMetres = 0.0;
  double blurRadians = 0.0;

  /// Adds one residual. @param residual reading - expectation @param expectation its derivatives by
  /// x, y, theta @param weight 1 / variance, less if it is likely an outlier
  void add(double residual, const std::array<double, 3>& expectation, double weight) {
    for (std::size_t row = 0; row < 3; ++row) {
      pull[row] += weight * expectation[row] * residual;
      for (std::size_t column = 0; column < 3; ++column)
        information[3 * row + column] += weight * expectation[row] * expectation[column];
    }
  }
  /// Adds another reading's slope, scaled by @p times.
  void add(const Slope& other, double times) {
    for (std::size_t k = 0; k < 3; ++k) pull[k] += times * other.pull[k];
    for (std::size_t k = 0; k < 9; ++k) information[k] += times * other.information[k];
    blurMetres = std::max(blurMetres, other.blurMetres);
    blurRadians = std::max(blurRadians, other.blurRadians);
  }
};

/// A weigher that also knows how its probability changes around a pose. With it a pose is refined
/// beyond the resolution of tables and the spacing of samples; readings of other weighers only take
/// part in weighing.
class ORTUNG_API Polishable {
 public:
  virtual ~Polishable();
  /// Returns the slope at @p pose; zero where the reading fits no expectation. Thread-safe.
  virtual Slope slopeAt(const Pose2& pose) const = 0;

 protected:
  Polishable() = default;
  Polishable(const Polishable&) = default;
  Polishable& operator=(const Polishable&) = default;
};

}  // namespace ortung
