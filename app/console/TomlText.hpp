#pragma once

#include <string>

namespace ortung::app {

/// Returns a text as a string of TOML, in quotes. Control characters become blanks.
std::string quotedToml(const std::string& text);

}  // namespace ortung::app
