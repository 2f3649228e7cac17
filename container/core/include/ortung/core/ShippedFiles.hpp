#pragma once

#include <filesystem>

#include "ortung/base/Export.hpp"

namespace ortung {

/// A file that a plugin or an option names: as it is, if it is absolute or there; else that of the
/// maps that ship with the program, in $ORTUNG_MAPS_PATH or share/ortung/maps beside the folder of
/// libortung_container.so. Where there is none, @p file itself, so that whoever opens it says so.
/// @param kind folder of the maps: "robots", "rules", ...
ORTUNG_API std::filesystem::path shippedFile(const std::filesystem::path& kind,
                                             const std::filesystem::path& file);

}  // namespace ortung
