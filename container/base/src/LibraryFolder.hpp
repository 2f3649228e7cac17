#pragma once

#include <filesystem>

namespace ortung {

/// The folder of libortung_container.so as it was loaded, with links followed; "" if the system
/// does not say. Whatever belongs to Ortung lies in places relative to it, whoever's program runs.
std::filesystem::path libraryFolder();

}  // namespace ortung
