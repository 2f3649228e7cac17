#pragma once

#include <cstdint>

#include "ortung/base/Export.hpp"

namespace ortung {

/// How finely a table stores ranges: coarser with distance, as most sensors measure. It belongs to
/// the table, not to the noise of a sensor, so that tables serve whatever noise a sensor has.
struct RangeResolution {
  double metres = 0.05;    ///< resolution at range 0 [m], positive
  double perMetre = 0.01;  ///< growth of the resolution with range [m/m], not negative

  /// Returns the resolution at a range [m].
  double at(double range) const { return metres + perMetre * range; }
};

/// Levels 0..254 for ranges, as wide at every range as the resolution there says. There are always
/// about 254 of them, but none narrower than a sixth of the resolution.
/// Level 255 means "nothing within range". Immutable once made.
class ORTUNG_API RangeScale {
 public:
  static constexpr std::uint8_t kNothing = 255;  ///< level of "nothing within range"

  RangeScale() = default;
  /// @param maxRange range from which on a reading counts as "nothing seen" [m]
  RangeScale(double maxRange, const RangeResolution& resolution);

  std::uint8_t level(double range) const;  ///< level of a range [m]; kNothing at or beyond maxRange
  double range(std::uint8_t level) const;  ///< middle of the level [m]; maxRange for kNothing
  /// Returns how many levels lie within one sigma of a reading with noise of @p sigma at @p range
  /// [m].
  double levelsPerSigma(double range, double sigma) const {
    return levelsPerUnit_ * (sigma / resolution_.at(range));
  }
  double maxRange() const { return maxRange_; }

 private:
  double place(double range) const;
  double maxRange_ = 1.0;
  RangeResolution resolution_;
  double levelsPerUnit_ = 1.0;  ///< levels per width of the resolution
};

}  // namespace ortung
