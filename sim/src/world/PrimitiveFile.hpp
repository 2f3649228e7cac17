#pragma once

#include <string>

#include "ortung/base/Parameters.hpp"
#include "ortung/sim/Primitive.hpp"

namespace ortung {

/// What world files and robot files say alike of primitives.

inline constexpr Range kCoordinate{-1e4, 1e4};  ///< [m]
inline constexpr Range kSize{0.001, 2e4};       ///< [m]
inline constexpr Range kMass{0.001, 1e5};       ///< [kg]

/// Whether a text is of [A-Za-z0-9_-]{1,64}.
bool isWord(const std::string& text);

/// @throws ConfigError unless a text has at most 64 printable characters
void checkPrintable(const Parameters& table, const std::string& key, const std::string& text);

/// Reads `colour`: a name, "#rrggbb" or nothing. @throws ConfigError
std::string readColour(const Parameters& table);

/// Reads `z_m` into a primitive; what is there is the default. @throws ConfigError
void readHeights(const Parameters& table, Primitive& primitive);

/// Reads `center_m`, `size_m` and `angle_deg`, or `corners_m`, as the primitive's shape needs them.
/// @throws ConfigError
void readOutline(const Parameters& table, Primitive& primitive);

}  // namespace ortung
