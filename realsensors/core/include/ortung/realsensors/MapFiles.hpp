#pragma once

#include <filesystem>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"

namespace ortung {

/// Writes a world that is one occupancy grid: @p world (TOML), and copies of the map under the same
/// stem beside it. Of a map_server YAML that is the YAML and the image that it names, decompressed;
/// of any other kind (CARMEN's .map, MRPT's .gridmap, both may be .gz) the file.
/// @param more TOML that follows the grid's table
/// @throws std::runtime_error for a map that cannot be read or has no image
ORTUNG_API void writeGridWorld(const std::filesystem::path& world, const std::filesystem::path& map,
                               const std::string& more = "");

/// [[landmark]] tables of a world for the landmarks of a text file with lines "identity x y [z]
/// ..." [m]. @param kind e.g. "beacon"
/// @throws std::runtime_error
ORTUNG_API std::string landmarksToml(const std::filesystem::path& file, const std::string& kind);

/// The file that the option @p key names, in @p folder or, if it is not there, as it stands; it may
/// have .xz or .gz behind its name. Empty if there is no such option.
/// @throws ConfigError if there is no such file
ORTUNG_API std::filesystem::path fileOption(const Parameters& options, const std::string& key,
                                            const std::filesystem::path& folder);

}  // namespace ortung
