#pragma once

#include <filesystem>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"

namespace ortung {

/// Returns the [[grid]] table of a world for a map that a robot made: a surface was seen somewhere
/// in a cell, so its middle is the best guess, and poses from which it was seen were off, too.
/// @param map file, relative to the world's
ORTUNG_API std::string gridToml(const std::string& map);
/// Returns the keys of that table, which a [[floor]] of a building may have, too.
ORTUNG_API std::string gridKeys(const std::string& map);

/// Writes a world that is one occupancy grid: @p world (TOML), and a copy of the map with the same
/// stem beside it. For a map_server YAML the YAML and the image that it names are copied
/// (decompressed); for any other kind (CARMEN's .map, MRPT's .gridmap, both may be .gz) the file.
/// @param more TOML that is appended behind the grid's table
/// @throws std::runtime_error for a map that cannot be read or has no image
ORTUNG_API void writeGridWorld(const std::filesystem::path& world, const std::filesystem::path& map,
                               const std::string& more = "");

/// Returns the [[landmark]] tables of a world for the landmarks of a text file, whose lines are
/// "identity x y [z] ..." [m].
/// @param kind kind of the landmarks, e.g. "beacon"
/// @throws std::runtime_error for a line that has another form
ORTUNG_API std::string landmarksToml(const std::filesystem::path& file, const std::string& kind);

/// Returns the file that the option @p key names: in @p folder or, if it is not there, relative to
/// the working directory; .xz or .gz may be appended to its name. Empty if the option is not given.
/// @throws ConfigError if there is no such file
ORTUNG_API std::filesystem::path fileOption(const Parameters& options, const std::string& key,
                                            const std::filesystem::path& folder);

}  // namespace ortung
