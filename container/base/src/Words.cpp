#include "ortung/base/Words.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "ortung/base/Angles.hpp"

namespace ortung::words {
namespace {

constexpr double kCentidegrees = 18000.0 / std::numbers::pi;

/// Refuses values that are no number: their words would be read as -2147 km.
void refuseInfinite(double value) {
  if (!std::isfinite(value))
    throw std::invalid_argument("a measured value is " + std::to_string(value) +
                                ", expected a finite number");
}

std::uint32_t clampToWord(double value) {
  refuseInfinite(value);
  return static_cast<std::uint32_t>(
      std::clamp(std::nearbyint(value), 0.0, double{std::numeric_limits<std::uint32_t>::max()}));
}

}  // namespace

std::uint32_t fromMetres(double metres) { return clampToWord(metres * 1000.0); }
double toMetres(std::uint32_t word) { return word / 1000.0; }

std::uint32_t fromSignedMetres(double metres) { return clampToWord(metres * 1000.0 + kOffset); }
double toSignedMetres(std::uint32_t word) { return (static_cast<double>(word) - kOffset) / 1000.0; }

std::uint32_t fromAngle(double radians) {
  refuseInfinite(radians);
  const double centidegrees = std::nearbyint(std::remainder(radians, kTurn) * kCentidegrees);
  return static_cast<std::uint32_t>(centidegrees + 18000.0) % kAngles;
}
double toAngle(std::uint32_t word) { return (static_cast<double>(word) - 18000.0) / kCentidegrees; }

std::uint32_t fromRate(double radiansPerSecond) {
  return clampToWord(radiansPerSecond * kCentidegrees + kOffset);
}
double toRate(std::uint32_t word) { return (static_cast<double>(word) - kOffset) / kCentidegrees; }

}  // namespace ortung::words
