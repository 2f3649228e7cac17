#pragma once

#include <numbers>

namespace ortung {

inline constexpr double kTurn = 2.0 * std::numbers::pi;        ///< a whole turn [rad]
inline constexpr auto kTurnFloat = static_cast<float>(kTurn);  ///< a whole turn [rad]
inline constexpr double kDegree = std::numbers::pi / 180.0;    ///< one degree [rad]

/// Converts degrees to radians. radians(x) and x * kDegree may differ in the last bit, on which
/// results depend.
constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }
/// Converts radians to degrees.
constexpr double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

}  // namespace ortung
