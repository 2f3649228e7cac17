#pragma once

#include <filesystem>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Returns the folder of libortung_container.so as it was loaded, with links followed; "" if the
/// system does not say. Whatever belongs to Ortung lies in places relative to it, whichever program
/// runs. For a static library it is where that folder would be, seen from the plugin, command or
/// program that the library is part of.
ORTUNG_API std::filesystem::path libraryFolder();

}  // namespace ortung
