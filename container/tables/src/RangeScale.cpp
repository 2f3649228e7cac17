#include "ortung/tables/RangeScale.hpp"

#include <algorithm>
#include <cmath>

namespace ortung {
namespace {

constexpr double kLastLevel = 254.0;
constexpr double kMostLevelsAUnit = 6.0;  // finer levels bring nothing

}  // namespace

RangeScale::RangeScale(double maxRange, const RangeResolution& resolution)
    : maxRange_(maxRange), resolution_(resolution) {
  levelsPerUnit_ = std::min(kLastLevel / place(maxRange), kMostLevelsAUnit);
}

/// Returns the range in units of the resolution: the integral of dr / resolution(r).
double RangeScale::place(double range) const {
  if (resolution_.perMetre == 0.0) return range / resolution_.metres;
  return std::log1p(resolution_.perMetre * range / resolution_.metres) / resolution_.perMetre;
}

std::uint8_t RangeScale::level(double range) const {
  if (!(range < maxRange_)) return kNothing;
  const double level = std::nearbyint(levelsPerUnit_ * place(std::max(range, 0.0)));
  return static_cast<std::uint8_t>(std::min(level, kLastLevel));
}

double RangeScale::range(std::uint8_t level) const {
  if (level == kNothing) return maxRange_;
  const double units = level / levelsPerUnit_;
  if (resolution_.perMetre == 0.0) return units * resolution_.metres;
  return std::expm1(units * resolution_.perMetre) * resolution_.metres / resolution_.perMetre;
}

}  // namespace ortung
