#include "Console.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>

namespace ortung::app {
namespace {

bool isControl(std::string_view text, std::size_t i) {
  const auto byte = static_cast<unsigned char>(text[i]);
  if (byte < 0x20 || byte == 0x7F) return true;
  // The C1 controls in UTF-8: 0xC2 0x80 to 0xC2 0x9F.
  const bool afterC2 = i > 0 && static_cast<unsigned char>(text[i - 1]) == 0xC2;
  return afterC2 && byte >= 0x80 && byte < 0xA0;
}

spdlog::logger& logger() {
  static spdlog::logger instance("ortung", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  return instance;
}

}  // namespace

void setCommandName(const std::string& name) { logger().set_pattern(name + ": %v"); }

void note(const std::string& text) { logger().info("{}", printable(text)); }
void warn(const std::string& text) { logger().warn("warning: {}", printable(text)); }
void fail(const std::string& text) { logger().error("{}", printable(text)); }

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (isControl(text, i)) {
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[i]));
    } else {
      out += text[i];
    }
  }
  return out;
}

}  // namespace ortung::app
