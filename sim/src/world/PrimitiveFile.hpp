#pragma once

#include <string>

#include "ortung/base/Parameters.hpp"
#include "ortung/sim/Primitive.hpp"

namespace ortung {

/// The keys of primitives that world files and robot files have in common.

inline constexpr Range kCoordinate{-1e4, 1e4};  ///< coordinates [m]
inline constexpr Range kSize{0.001, 2e4};       ///< sizes [m]
inline constexpr Range kMass{0.001, 1e5};       ///< masses [kg]

/// Returns whether a text matches [A-Za-z0-9_-]{1,64}.
bool isWord(const std::string& text);

/// Checks a text. @throws ConfigError unless it has at most 64 printable characters
void checkPrintable(const Parameters& table, const std::string& key, const std::string& text);

/// Reads `colour`: a name, "#rrggbb" or nothing. @throws ConfigError
std::string readColour(const Parameters& table);

/// Reads `z_m` into a primitive; its current heights are the default. @throws ConfigError
void readHeights(const Parameters& table, Primitive& primitive);

/// Reads `center_m`, `size_m` and `angle_deg`, or `corners_m`, as the primitive's shape needs them.
/// @throws ConfigError
void readOutline(const Parameters& table, Primitive& primitive);

}  // namespace ortung
