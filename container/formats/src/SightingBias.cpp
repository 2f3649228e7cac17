#include "ortung/formats/SightingBias.hpp"

#include <algorithm>

#include "ortung/base/Pose2.hpp"

namespace ortung {
namespace {

constexpr double kLeastScale = 0.1;  ///< farther from the axis the polynomial is no scale
constexpr int kRounds = 8;           ///< terms are small, so each leaves a tenth of the error

}  // namespace

double SightingBias::scaleAt(double bearing) const {
  return std::max(kLeastScale, 1.0 + perMetre + (perMetreRad + perMetreRad2 * bearing) * bearing);
}

SightingBias::Sight SightingBias::measured(const Sight& truth) const {
  const double b = wrapAngle(truth.bearing);
  return {std::max(0.0, truth.range * scaleAt(b) + metres),
          wrapAngle(b + radians + (perRad + perRad2 * b) * b)};
}

SightingBias::Sight SightingBias::corrected(const Sight& seen) const {
  const double begin = wrapAngle(seen.bearing - radians);
  double b = begin;
  for (int round = 0; round < kRounds; ++round) b = wrapAngle(begin - (perRad + perRad2 * b) * b);
  return {std::max(0.0, (seen.range - metres) / scaleAt(b)), b};
}

}  // namespace ortung
