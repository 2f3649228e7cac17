#pragma once

#include <filesystem>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/mcl_served/FilterThread.hpp"

namespace ortung {

/// Learns tables of a world when a robot first needs them, in memory, once for all robots that
/// sense alike, as `ortung learn` does with cells of 0.1 m.
/// @param world its file
ORTUNG_API TableGiver learnedTables(const std::filesystem::path& world);

/// Tables of a file that `ortung learn` wrote. Robots that they were not learned for are refused.
/// @param worldFingerprint of the world that is served; "": any
/// @throws TableError; std::invalid_argument if they were learned in another world
ORTUNG_API TableGiver givenTables(const std::filesystem::path& file,
                                  const std::string& worldFingerprint);

}  // namespace ortung
