#include "Colours.hpp"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace ortung::app {
namespace {

/// Whether a stream shows colours.
bool isColourful(std::FILE* stream) {
  const char* none = std::getenv("NO_COLOR");
  if (none != nullptr && *none != '\0') return false;
  const char* terminal = std::getenv("TERM");
  if (terminal == nullptr || std::string_view(terminal) == "dumb") return false;
  return ::isatty(::fileno(stream)) == 1;
}

std::string inCode(const char* code, const std::string& text, std::FILE* stream) {
  return isColourful(stream) ? std::string("\x1b[") + code + "m" + text + "\x1b[0m" : text;
}

}  // namespace

std::string bold(const std::string& text, std::FILE* stream) { return inCode("1", text, stream); }
std::string red(const std::string& text, std::FILE* stream) { return inCode("31", text, stream); }
std::string yellow(const std::string& text, std::FILE* stream) {
  return inCode("33", text, stream);
}

}  // namespace ortung::app
