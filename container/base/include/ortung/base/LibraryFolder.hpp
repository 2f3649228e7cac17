#pragma once

#include <filesystem>

#include "ortung/base/Export.hpp"

namespace ortung {

/// The folder of libortung_container.so as it was loaded, with links followed; "" if the system
/// does not say. Whatever belongs to Ortung lies in places relative to it, whoever's program runs.
/// Of a static library: where it would be, seen from the plugin, command or program that it is part
/// of.
ORTUNG_API std::filesystem::path libraryFolder();

}  // namespace ortung
