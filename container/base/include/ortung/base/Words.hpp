#pragma once

#include <cstdint>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Conversions between words and lengths [m], angles [rad] and rates [rad/s]. Encoding rounds to
/// the nearest and clamps to what the word can hold. @throws std::invalid_argument for numbers that
/// are not finite
namespace words {
inline constexpr std::uint32_t kOffset = 1u << 31;   ///< zero of a signed word
ORTUNG_API std::uint32_t fromMetres(double metres);  ///< word of unsigned millimetres
ORTUNG_API double toMetres(std::uint32_t word);
ORTUNG_API std::uint32_t fromSignedMetres(double metres);  ///< word kOffset + millimetres
ORTUNG_API double toSignedMetres(std::uint32_t word);
ORTUNG_API std::uint32_t fromAngle(double radians);  ///< 1/100 degree + 18000, in [0, kAngles)
ORTUNG_API double toAngle(std::uint32_t word);       ///< angle [rad], in [-pi, pi)
ORTUNG_API std::uint32_t fromRate(double radiansPerSecond);  ///< word kOffset + 1/100 degree/s
ORTUNG_API double toRate(std::uint32_t word);
inline constexpr std::uint32_t kAngles = 36000;  ///< words of angles are below this
}  // namespace words

}  // namespace ortung
