#pragma once

#include <string>

namespace ortung::app {

/// Returns the JSON schema (draft 7) of a kind of file, "robot", "world" or "scene", for editors:
/// it has all keys that the installed plugins read, with bounds and defaults.
/// @throws std::invalid_argument for another kind, std::runtime_error if the shipped files are
/// missing
std::string schemaOf(const std::string& kind);

}  // namespace ortung::app
