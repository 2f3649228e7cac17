#pragma once

#include <cstdio>
#include <string>

namespace ortung::app {

// Texts as they are to appear on a stream: as they are unless it is a terminal that can do more.
// NO_COLOR (no-color.org) and TERM=dumb switch it off.
std::string bold(const std::string& text, std::FILE* stream);
std::string red(const std::string& text, std::FILE* stream);
std::string yellow(const std::string& text, std::FILE* stream);

}  // namespace ortung::app
