#pragma once

namespace ortung {

// What a grid map means that nobody has said more about: keys of [[grid]] for a map that is given
// as a world, or is made of scans.

/// Depth of surfaces in a cell, `surface_depth_cells`: a surface was found somewhere in a cell, so
/// its middle is the best guess.
inline constexpr double kMapSurfaceDepth = 0.5;
/// Error of its walls, `map_error_m` [m]: the poses at which it was made were off by that in public
/// logs of buildings. With it errors of poses are those that their covariances promise.
inline constexpr double kMapError = 0.02;

}  // namespace ortung
